// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Conversion of model nodes for the module and its command-line module: to world coordinates, with parent transforms
/// applied. No node is changed.

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

/// Returns the labels on either side of the triangles of a labelled surface, without 0, with their names and colours if
/// known.
TissueTable tissuesOfSurface(vtkMRMLModelNode* model);

/// Returns one labelled surface as it is, or closed surfaces appended in their order, whose shells get the names and
/// colours of the models. In RAS, mm, without SPACE in the field data, about which Slicer complains on writing.
vtkSmartPointer<vtkPolyData> surfaceInWorld(const std::vector<vtkMRMLModelNode*>& models);

/// Converts triangles from LPS to polydata in RAS.
vtkSmartPointer<vtkPolyData> polyDataOf(const SurfaceComplex& surface);

/// Returns the ambient tetrahedra, under the transform of `surface`, so that they follow it. In RAS, mm, without SPACE
/// as above.
vtkSmartPointer<vtkUnstructuredGrid> ambientInWorld(vtkMRMLModelNode* ambient, vtkMRMLModelNode* surface);

/// Whether every point of the surface is a point of the ambient tetrahedra; false if one of them was edited since.
bool belongTogether(vtkMRMLModelNode* surface, vtkMRMLModelNode* ambient);

/// Returns the tetrahedra of a model in LPS. Throws InputError, with the model's name, for meshes that readMesh
/// refuses.
MeshFile meshOfModel(vtkMRMLModelNode* model);

} // namespace surgicalmesher
