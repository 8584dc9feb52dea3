// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Conversion of the user's tissue map, a label map volume or a segmentation, to the forms that the modules need. The
/// user's node is never changed.

#include "TissueMap.h"
#include "vtkSurgicalMesherSupportLogicExport.h"

#include <vtkSmartPointer.h>
#include <vtkType.h>

#include <string>

class vtkMRMLColorTableNode;
class vtkMRMLLabelMapVolumeNode;
class vtkMRMLNode;

namespace surgicalmesher
{

enum class TissueMapProblem
{
  None,
  NothingChosen,
  NotATissueMap,       ///< neither a label map nor a segmentation
  NoSegment,           ///< a segmentation without segments
  NoVoxels,            ///< a label map without image data
  OnlyBackground,      ///< no voxel of any tissue
  NoReferenceGeometry, ///< a segmentation whose voxel grid is unknown
  ShearingTransform,   ///< under a linear transform that shears its voxels
  NegativeLabels,      ///< voxels below 0, above 65535 or not integer
  NotExported          ///< Slicer could not convert the segmentation
};

/// Returns why `input` cannot be meshed. Cheap enough for every change in a panel (the range of the voxels is computed
/// once and cached with the image).
VTK_SURGICALMESHER_SUPPORT_LOGIC_EXPORT TissueMapProblem checkTissueMap(vtkMRMLNode* input);

/// Returns when the meshed content of `input` last changed: voxels, segments, transform. 0 for null.
VTK_SURGICALMESHER_SUPPORT_LOGIC_EXPORT vtkMTimeType tissueMapTime(vtkMRMLNode* input);

/// A label map for a run, with the names and colours of the tissues. Both nodes are in the scene of `input`, hidden and
/// not saved.
struct TissueMapNodes
{
  vtkSmartPointer<vtkMRMLLabelMapVolumeNode> labelMap;
  vtkSmartPointer<vtkMRMLColorTableNode> colors; ///< null if the input has no names
  TissueMapProblem problem = TissueMapProblem::None;
};

/// Creates the nodes; the caller passes them to a run (vtkSurgicalMesherRun::AddTemporaryNode) or removes them from the
/// scene. A segmentation is exported in its reference geometry with all its segments, as labels 1, 2, 3 ... in their
/// order; where segments overlap, the later one wins. A label map shares its voxels with the input. World positions are
/// those that the user sees: a linear parent transform moves the grid of the copy, a nonlinear one resamples it. In
/// case of a problem, there are no nodes.
VTK_SURGICALMESHER_SUPPORT_LOGIC_EXPORT TissueMapNodes makeTissueMapNodes(vtkMRMLNode* input);

/// Returns the names and colours by label that makeTissueMapNodes would give, without exporting anything: for a
/// segmentation those of all segments, for a label map those of its colour table. Null displacement is read from the
/// tag of a segment, or from the attribute set by keepNullDisplacement().
VTK_SURGICALMESHER_SUPPORT_LOGIC_EXPORT TissueTable tissueTable(vtkMRMLNode* input);

/// Stores in an attribute of `labelMap`, saved with the scene, which of its labels are null displacement, since colour
/// tables cannot hold this.
VTK_SURGICALMESHER_SUPPORT_LOGIC_EXPORT void keepNullDisplacement(vtkMRMLLabelMapVolumeNode* labelMap,
                                                                  const TissueTable& table);

/// Returns the null-displacement labels in the format of SimplexMesherCLI, e.g. "3,7".
VTK_SURGICALMESHER_SUPPORT_LOGIC_EXPORT std::string nullDisplacementLabels(const TissueTable& table);

/// Returns the map itself for processing within Slicer, in LPS, with the same order of axes as a map that readTissueMap
/// reads from a file. Throws InputError with a message if checkTissueMap finds a problem or the voxels are no labels.
VTK_SURGICALMESHER_SUPPORT_LOGIC_EXPORT TissueMap readTissueMap(vtkMRMLNode* input);

} // namespace surgicalmesher
