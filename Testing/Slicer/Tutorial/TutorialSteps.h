// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What a user does in a tutorial, by the panels' own widgets. Each throws std::runtime_error where the panel does not
/// do what the tutorial says.

#include <QString>

#include <string>

class QComboBox;
class qSlicerAbstractModuleWidget;
class vtkMRMLNode;
class vtkMRMLScene;

namespace surgicalmesher::test
{

void require(bool condition, const std::string& expectation);

/// Starts a run as the button of a foot does.
void apply(qSlicerAbstractModuleWidget* panel, const char* footName = "RunWidget");
/// Waits for its end, which has to be a good one.
void waitForRun(qSlicerAbstractModuleWidget* panel, const char* footName = "RunWidget");

vtkMRMLNode* chosen(qSlicerAbstractModuleWidget* panel, const char* selector);
void choose(qSlicerAbstractModuleWidget* panel, const char* selector, vtkMRMLNode* node);

void collapse(qSlicerAbstractModuleWidget* panel, const char* section, bool collapsed = true);
void expand(qSlicerAbstractModuleWidget* panel, const char* section);

/// As a user picks an entry, which is more than setting it.
void select(QComboBox* box, int index);

/// Of all models, leaves this one visible.
void showOnly(vtkMRMLScene* scene, vtkMRMLNode* shown);

/// By Fuchs Tetrahedralizer's button, through its dialogue, answered as a user would.
void exportTo(const QString& file, qSlicerAbstractModuleWidget* panel);

} // namespace surgicalmesher::test
