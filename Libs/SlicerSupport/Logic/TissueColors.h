// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Names and colours of tissues in Slicer's colour tables.

#include "TissueMap.h"
#include "vtkSurgicalMesherSupportLogicExport.h"

class vtkMRMLColorTableNode;
class vtkMRMLLabelMapVolumeNode;
class vtkMRMLModelNode;

namespace surgicalmesher
{

/// Gives the tissues distinct colours by label if all have the same one, as in maps without colours. A table with
/// different colours, or of a single tissue, is returned unchanged.
VTK_SURGICALMESHER_SUPPORT_LOGIC_EXPORT TissueTable withDistinctColors(TissueTable tissues);

/// Fills `colors` with the tissues by label, from 0 (background) to the highest; labels missing in between are
/// undefined. Tissues without a name are named by their label.
VTK_SURGICALMESHER_SUPPORT_LOGIC_EXPORT void fillColorTable(const TissueTable& tissues, vtkMRMLColorTableNode* colors);

/// Shows a model by its integer cell array `array` (the first component if there are several) in the colours of the
/// tissues in its field data, made distinct. The colour table belongs to the model and is reused by later calls.
VTK_SURGICALMESHER_SUPPORT_LOGIC_EXPORT vtkMRMLColorTableNode* showTissueColors(vtkMRMLModelNode* model,
                                                                                const char* array);

/// Shows a label map with the names and colours of the tissues. The colour table belongs to the label map and is reused
/// by later calls.
VTK_SURGICALMESHER_SUPPORT_LOGIC_EXPORT void showTissueColors(vtkMRMLLabelMapVolumeNode* labelMap,
                                                              const TissueTable& tissues);

} // namespace surgicalmesher
