// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The closed surface of each tissue as a model of its own, in a folder of the subject hierarchy.

class vtkMRMLModelNode;

namespace surgicalmesher
{

/// Makes a model of every tissue of `surface` (cell array BoundaryLabels), with the tissue's name and colour, in a
/// folder named after the surface. Models made for the same surface before are filled again, or removed with their
/// tissue.
void makeTissueModels(vtkMRMLModelNode* surface);

/// Removes them and their folder.
void removeTissueModels(vtkMRMLModelNode* surface);

} // namespace surgicalmesher
