// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Model nodes of the scene as the module and its command-line part take them: in world coordinates, with parent
/// transforms applied. Nothing here changes a node.

#include "MeshIO.h"

#include <vtkSmartPointer.h>

#include <vector>

class vtkMRMLModelNode;
class vtkPolyData;
class vtkUnstructuredGrid;

namespace surgicalmesher
{

/// Whether the model has the cell array BoundaryLabels.
bool isLabelledSurface(vtkMRMLModelNode* model);

/// The labels on either side of a labelled surface's triangles, without 0, and what is known of them.
TissueTable tissuesOfSurface(vtkMRMLModelNode* model);

/// One labelled surface as it is, or closed surfaces appended in their order, whose shells get the models' names and
/// colours. In RAS, mm, without SPACE in its field data: the host complains when it finds that there while it writes.
vtkSmartPointer<vtkPolyData> surfaceInWorld(const std::vector<vtkMRMLModelNode*>& models);

/// Triangles in LPS as polydata in RAS.
vtkSmartPointer<vtkPolyData> polyDataOf(const SurfaceComplex& surface);

/// Ambient tetrahedra, which go where their surface goes: they are under the transform of `surface`. As above.
vtkSmartPointer<vtkUnstructuredGrid> ambientInWorld(vtkMRMLModelNode* ambient, vtkMRMLModelNode* surface);

/// Whether every point of the surface is one of the ambient tetrahedra's. If one was edited since, it isn't.
bool belongTogether(vtkMRMLModelNode* surface, vtkMRMLModelNode* ambient);

/// The tetrahedra of a model in LPS. Throws InputError, with the model's name, for anything that readMesh refuses.
MeshFile meshOfModel(vtkMRMLModelNode* model);

} // namespace surgicalmesher
