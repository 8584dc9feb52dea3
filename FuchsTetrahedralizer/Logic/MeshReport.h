// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The quality of a mesh as nodes of the scene: a table, and histograms as plots. The mesh node refers to them by the
/// roles of vtkMRMLFuchsTetrahedralizerNode; nodes that it already refers to are filled anew.

#include <string>

class vtkMRMLModelNode;

namespace surgicalmesher
{

/// From the report that FuchsTetrahedralizerCLI wrote. Throws InputError if the text isn't one.
void showReport(vtkMRMLModelNode* mesh, const std::string& reportJSON);

/// The same for tetrahedra from elsewhere, assessed here and now; the lengths asked for are those of the points' array
/// TargetEdgeLength, if there is one. Throws InputError for anything that meshOfModel refuses.
void assessMesh(vtkMRMLModelNode* mesh);

} // namespace surgicalmesher
