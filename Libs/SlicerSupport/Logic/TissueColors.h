#pragma once
/// Names and colours of tissues as the host's colour tables.

#include "TissueMap.h"
#include "vtkSurgicalMesherSupportLogicExport.h"

class vtkMRMLColorTableNode;
class vtkMRMLModelNode;

namespace surgicalmesher
{

/// Makes `colors` hold the tissues by label, from 0 (background) to the highest; labels between them that the table lacks
/// are undefined. Tissues without a name are called by their label.
VTK_SURGICALMESHER_SUPPORT_LOGIC_EXPORT void fillColorTable(const TissueTable& tissues, vtkMRMLColorTableNode* colors);

/// Shows a model by its integer cell array `array` (of several components: the first), in the tissues' colours: those in
/// its field data. The colour table is the model's own; later calls fill the same again.
VTK_SURGICALMESHER_SUPPORT_LOGIC_EXPORT vtkMRMLColorTableNode* showTissueColors(vtkMRMLModelNode* model,
                                                                                const char* array);

} // namespace surgicalmesher
