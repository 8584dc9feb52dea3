// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The tissues of a label map or segmentation as the panel lists them.

#include "TissueMap.h"
#include "vtkSlicerSimplexMesherModuleLogicExport.h"

#include <cstdint>
#include <map>
#include <string>
#include <vector>

class vtkImageData;
class vtkMRMLNode;

namespace surgicalmesher
{

struct TissueRow
{
  std::string id; ///< segment ID, or the label's digits
  Label label = 0;
  std::string name;
  std::array<double, 3> color{ 0.8, 0.8, 0.8 }; ///< RGB in [0, 1]
  std::int64_t voxels = -1;                     ///< -1: not known, as of a segment that isn't stored as voxels
  double volume = -1;                           ///< mm^3; -1: not known
};

/// All segments in their order, or the labels that the map has voxels of, ascending. Looks at every voxel. Segments
/// that overlap are counted whole, although the mesh gives their common voxels to the later one.
VTK_SLICER_SIMPLEXMESHER_MODULE_LOGIC_EXPORT std::vector<TissueRow> listTissues(vtkMRMLNode* tissueMap);

/// Voxels by label from 1 to 65535; values beyond, and what is no integer, don't count.
std::map<Label, std::int64_t> countVoxels(vtkImageData* image);

} // namespace surgicalmesher
