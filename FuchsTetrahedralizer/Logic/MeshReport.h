// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The quality of a mesh as nodes of the scene: a table, and histograms as plots. The mesh node references them by the
/// roles of vtkMRMLFuchsTetrahedralizerNode; nodes that it already references are refilled.

#include <string>

class vtkMRMLModelNode;

namespace surgicalmesher
{

/// Shows the report written by FuchsTetrahedralizerCLI. Throws InputError if the text is not such a report.
void showReport(vtkMRMLModelNode* mesh, const std::string& reportJSON);

/// The same for tetrahedra from other sources, which are assessed here; target lengths are those of the point array
/// TargetEdgeLength, if present. Throws InputError for a model that meshOfModel refuses.
void assessMesh(vtkMRMLModelNode* mesh);

} // namespace surgicalmesher
