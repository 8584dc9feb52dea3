// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Conversion between models of the scene and the files of the command-line module.

#include "ElementMeshIO.h"

#include <string>

class vtkMRMLModelNode;

namespace surgicalmesher
{

/// Whether the model has cells.
bool hasCells(vtkMRMLModelNode* model);

/// ".vtp" for a surface, ".vtu" for any other mesh.
std::string extensionFor(vtkMRMLModelNode* model);

/// Returns the mesh of the model in world coordinates, LPS, mm, with its arrays. Throws InputError with the model's
/// name for cells that a template cannot have.
ElementMeshFile meshInWorld(vtkMRMLModelNode* model);

/// Writes the same to a file with the extension extensionFor(model).
void writeModel(vtkMRMLModelNode* model, const std::string& file);

/// Name of the cell array by which showQuality() colours: the least scaled Jacobian over an element's corners.
constexpr const char* kQualityArray = "ScaledJacobian";

/// Replaces the model's mesh by that of the file and removes its transform; volume elements get the array
/// kQualityArray.
void readIntoModel(const std::string& file, vtkMRMLModelNode* model);

/// Colours the model by quality from 0 (purple) to 1 (yellow), or in its own colour. A model without the array is
/// unchanged.
void showQuality(vtkMRMLModelNode* model, bool isShown);

} // namespace surgicalmesher
