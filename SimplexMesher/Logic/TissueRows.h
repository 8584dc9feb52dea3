// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The tissues of a label map or segmentation, as listed in the panel.

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
  std::string id; ///< segment ID, or the label as text
  Label label = 0;
  std::string name;
  std::array<double, 3> color{ 0.8, 0.8, 0.8 }; ///< RGB in [0, 1]
  std::int64_t voxels = -1;                     ///< -1: unknown, as for a segment not stored as voxels
  double volume = -1;                           ///< mm^3; -1: unknown
};

/// Returns all segments in their order, or the labels that occur in the map, ascending. Visits every voxel. Overlapping
/// segments are counted as a whole, although meshing gives their common voxels to the later one.
VTK_SLICER_SIMPLEXMESHER_MODULE_LOGIC_EXPORT std::vector<TissueRow> listTissues(vtkMRMLNode* tissueMap);

/// Returns the numbers of voxels by label from 1 to 65535; other values and non-integers are ignored.
std::map<Label, std::int64_t> countVoxels(vtkImageData* image);

} // namespace surgicalmesher
