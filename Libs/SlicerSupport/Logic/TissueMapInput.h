// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What the user chose as tissue map, a label map volume or a segmentation, in the forms that the modules need. Nothing
/// here changes the user's node.

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
  ShearingTransform,   ///< under a linear transform that turns its voxels into rhomboids
  NegativeLabels,      ///< voxels below 0, above 65535 or not whole
  NotExported          ///< the host could not convert the segmentation
};

/// What keeps `input` from being meshed; cheap enough for every change in a panel (the range of the voxels is looked
/// for once and kept with the image).
VTK_SURGICALMESHER_SUPPORT_LOGIC_EXPORT TissueMapProblem checkTissueMap(vtkMRMLNode* input);

/// When `input` last changed in what it is meshed from: voxels, segments, transform. 0 for null.
VTK_SURGICALMESHER_SUPPORT_LOGIC_EXPORT vtkMTimeType tissueMapTime(vtkMRMLNode* input);

/// A label map for a run, with the tissues' names and colours. Both nodes are in the scene of `input`, hidden, not
/// saved.
struct TissueMapNodes
{
  vtkSmartPointer<vtkMRMLLabelMapVolumeNode> labelMap;
  vtkSmartPointer<vtkMRMLColorTableNode> colors; ///< null if the input has no names
  TissueMapProblem problem = TissueMapProblem::None;
};

/// Makes them; the caller hands them to a run (vtkSurgicalMesherRun::AddTemporaryNode) or removes them from the scene.
/// A segmentation is exported in its reference geometry with all its segments: labels 1, 2, 3 ... in the segments'
/// order, the later segment winning where two overlap. A label map shares its voxels with the input. World positions
/// are those that the user sees: a linear parent transform moves the copy's grid, another one resamples it. With a
/// problem there are no nodes.
VTK_SURGICALMESHER_SUPPORT_LOGIC_EXPORT TissueMapNodes makeTissueMapNodes(vtkMRMLNode* input);

/// Names and colours by label as makeTissueMapNodes would give them, without exporting anything: for a segmentation all
/// segments, for a label map the entries of its colour table. What is null displacement, a segment's tag says, or what
/// keepNullDisplacement() has noted.
VTK_SURGICALMESHER_SUPPORT_LOGIC_EXPORT TissueTable tissueTable(vtkMRMLNode* input);

/// Notes on `labelMap`, to be saved with the scene, which of its labels are null displacement: colour tables carry
/// nothing but names.
VTK_SURGICALMESHER_SUPPORT_LOGIC_EXPORT void keepNullDisplacement(vtkMRMLLabelMapVolumeNode* labelMap,
                                                                  const TissueTable& table);

/// The labels that are null displacement, as SimplexMesherCLI takes them: "3,7".
VTK_SURGICALMESHER_SUPPORT_LOGIC_EXPORT std::string nullDisplacementLabels(const TissueTable& table);

/// The map itself for work inside the host's process, in LPS, with its axes in the order in which readTissueMap brings
/// those of a file. Throws InputError with a sentence if checkTissueMap or the voxels have a problem.
VTK_SURGICALMESHER_SUPPORT_LOGIC_EXPORT TissueMap readTissueMap(vtkMRMLNode* input);

} // namespace surgicalmesher
