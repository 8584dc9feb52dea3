// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Names and colours of tissues as the host's colour tables.

#include "TissueMap.h"
#include "vtkSurgicalMesherSupportLogicExport.h"

class vtkMRMLColorTableNode;
class vtkMRMLLabelMapVolumeNode;
class vtkMRMLModelNode;

namespace surgicalmesher
{

/// Tissues of a map without colours have all the same one: gives them colours by label that tell neighbours apart. A
/// table with other colours, or of one tissue, stays as it is.
VTK_SURGICALMESHER_SUPPORT_LOGIC_EXPORT TissueTable withDistinctColors(TissueTable tissues);

/// Makes `colors` hold the tissues by label, from 0 (background) to the highest; labels between them that the table
/// lacks are undefined. Tissues without a name are called by their label.
VTK_SURGICALMESHER_SUPPORT_LOGIC_EXPORT void fillColorTable(const TissueTable& tissues, vtkMRMLColorTableNode* colors);

/// Shows a model by its integer cell array `array` (of several components: the first), in the tissues' colours: those
/// in its field data, made distinct. The colour table is the model's own; later calls fill the same again.
VTK_SURGICALMESHER_SUPPORT_LOGIC_EXPORT vtkMRMLColorTableNode* showTissueColors(vtkMRMLModelNode* model,
                                                                                const char* array);

/// Shows a label map in the tissues' names and colours. The colour table is the label map's own; later calls fill the
/// same again.
VTK_SURGICALMESHER_SUPPORT_LOGIC_EXPORT void showTissueColors(vtkMRMLLabelMapVolumeNode* labelMap,
                                                              const TissueTable& tissues);

} // namespace surgicalmesher
