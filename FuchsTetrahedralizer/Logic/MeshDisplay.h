// SPDX-License-Identifier: Apache-2.0
#pragma once
/// How tetrahedra of a model node are looked at: their colours, and a slice's plane that cuts them open between cells.

class vtkMRMLModelNode;
class vtkMRMLScene;
class vtkMRMLSliceNode;

namespace surgicalmesher
{

/// Colours by one of vtkMRMLFuchsTetrahedralizerNode::ColorByType, with a colour table that is the mesh's own. Angles
/// and ratios become cell arrays of the mesh ("MinimumDihedralAngle", degrees; "RadiusRatio") when they are first asked
/// for. False if the mesh lacks what the colours tell.
bool colorMesh(vtkMRMLModelNode* mesh, int colorBy);

/// Keeps whole cells on one side of the plane of a slice view (vtkMRMLFuchsTetrahedralizerNode::ClipPlaneType): below,
/// left or behind, or on the other side if flipped.
void clipMesh(vtkMRMLModelNode* mesh, int plane, bool flipped);

/// The slice view of a plane; null for none, and where the scene has no such view.
vtkMRMLSliceNode* sliceOfPlane(vtkMRMLScene* scene, int plane);

} // namespace surgicalmesher
