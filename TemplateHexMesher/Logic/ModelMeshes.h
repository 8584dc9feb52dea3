// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Models of the scene as the command-line module takes them, and what it makes as models.

#include "ElementMeshIO.h"

#include <string>

class vtkMRMLModelNode;

namespace surgicalmesher
{

/// Whether the model has cells.
bool hasCells(vtkMRMLModelNode* model);

/// ".vtp" for a surface, ".vtu" for any other mesh.
std::string extensionFor(vtkMRMLModelNode* model);

/// The model where the user sees it, LPS, mm, with its arrays. Throws InputError, with the model's name, for cells that
/// a template cannot have.
ElementMeshFile meshInWorld(vtkMRMLModelNode* model);

/// The same in a file of extensionFor(model).
void writeModel(vtkMRMLModelNode* model, const std::string& file);

/// Name of the cell array by which showQuality() colours: the least scaled Jacobian over an element's corners.
constexpr const char* kQualityArray = "ScaledJacobian";

/// Gives the model what the file holds, under no transform; volume elements get the array kQualityArray.
void readIntoModel(const std::string& file, vtkMRMLModelNode* model);

/// Colours from 0 (purple) to 1 (yellow), or the model's own colour. A model without the array stays as it is.
void showQuality(vtkMRMLModelNode* model, bool isShown);

} // namespace surgicalmesher
