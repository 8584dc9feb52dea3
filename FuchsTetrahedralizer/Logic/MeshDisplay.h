// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Display of the tetrahedra of a model node: colours, and clipping by whole cells at the plane of a slice.

class vtkMRMLModelNode;
class vtkMRMLScene;
class vtkMRMLSliceNode;

namespace surgicalmesher
{

/// Colours the mesh by one of vtkMRMLFuchsTetrahedralizerNode::ColorByType, with a colour table that belongs to the
/// mesh. Angles and ratios are added to the mesh as cell arrays on first use ("MinimumDihedralAngle", degrees;
/// "RadiusRatio"). Returns false if the mesh lacks the data to colour by.
bool colorMesh(vtkMRMLModelNode* mesh, int colorBy);

/// Shows only whole cells on one side of the plane of a slice view (vtkMRMLFuchsTetrahedralizerNode::ClipPlaneType):
/// below, left or behind; on the other side if flipped.
void clipMesh(vtkMRMLModelNode* mesh, int plane, bool flipped);

/// Returns the slice view of a plane; null for no plane or if the scene has no such view.
vtkMRMLSliceNode* sliceOfPlane(vtkMRMLScene* scene, int plane);

} // namespace surgicalmesher
