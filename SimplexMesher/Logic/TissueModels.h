// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The closed surface of each tissue as a separate model, in a folder of the subject hierarchy.

class vtkMRMLModelNode;

namespace surgicalmesher
{

/// Creates a model for every tissue of `surface` (cell array BoundaryLabels), with the name and colour of the tissue,
/// in a folder named after the surface. Earlier models of the same surface are reused, or removed if their tissue is
/// gone.
void makeTissueModels(vtkMRMLModelNode* surface);

/// Removes the models and their folder.
void removeTissueModels(vtkMRMLModelNode* surface);

} // namespace surgicalmesher
