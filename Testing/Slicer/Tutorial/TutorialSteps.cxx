// SPDX-License-Identifier: Apache-2.0
#include "TutorialSteps.h"

#include "HostApplication.h"
#include "Waiting.h"

#include <qMRMLNodeComboBox.h>
#include <qSlicerAbstractModuleWidget.h>
#include <qSurgicalMesherRunWidget.h>
#include <vtkSurgicalMesherRun.h>

#include <ctkCollapsibleButton.h>

#include <vtkMRMLModelDisplayNode.h>
#include <vtkMRMLModelNode.h>
#include <vtkMRMLScene.h>

#include <QApplication>
#include <QComboBox>
#include <QDialog>
#include <QLineEdit>
#include <QPushButton>
#include <QTimer>

#include <stdexcept>
#include <vector>

namespace surgicalmesher::test
{

void require(bool condition, const std::string& expectation)
{
  if (!condition) throw std::runtime_error("expected " + expectation);
}

void apply(qSlicerAbstractModuleWidget* panel, const char* footName)
{
  auto* foot = findChild<qSurgicalMesherRunWidget>(panel, footName);
  require(foot->problem().isEmpty(), "no problem, found: " + foot->problem().toStdString());
  foot->apply();
  require(foot->run() && foot->run()->GetStatus() == vtkSurgicalMesherRun::Running, "a run");
}

void waitForRun(qSlicerAbstractModuleWidget* panel, const char* footName)
{
  constexpr double longest = 900; // s
  vtkSurgicalMesherRun* run = findChild<qSurgicalMesherRunWidget>(panel, footName)->run();
  waitUntil([run] { return run->GetStatus() != vtkSurgicalMesherRun::Running; }, longest);
  require(run->GetStatus() == vtkSurgicalMesherRun::Completed, "a completed run, found: " + run->GetErrorText());
  waitFor(1);
}

vtkMRMLNode* chosen(qSlicerAbstractModuleWidget* panel, const char* selector)
{
  vtkMRMLNode* node = findChild<qMRMLNodeComboBox>(panel, selector)->currentNode();
  require(node != nullptr, std::string("a node in ") + selector);
  return node;
}

void choose(qSlicerAbstractModuleWidget* panel, const char* selector, vtkMRMLNode* node)
{
  auto* box = findChild<qMRMLNodeComboBox>(panel, selector);
  box->setCurrentNode(node);
  require(box->currentNode() == node, std::string("the node to be offered by ") + selector);
}

void collapse(qSlicerAbstractModuleWidget* panel, const char* section, bool collapsed)
{
  findChild<ctkCollapsibleButton>(panel, section)->setCollapsed(collapsed);
  waitFor(0.2);
}

void expand(qSlicerAbstractModuleWidget* panel, const char* section) { collapse(panel, section, false); }

void select(QComboBox* box, int index)
{
  box->setCurrentIndex(index);
  emit box->activated(index);
  waitFor(0.5);
}

void showOnly(vtkMRMLScene* scene, vtkMRMLNode* shown)
{
  std::vector<vtkMRMLNode*> models;
  scene->GetNodesByClass("vtkMRMLModelNode", models);
  for (vtkMRMLNode* node : models)
  {
    auto* display = vtkMRMLModelNode::SafeDownCast(node)->GetModelDisplayNode();
    if (display && node != shown && !node->GetHideFromEditors()) display->SetVisibility(false);
  }
}

void exportTo(const QString& file, qSlicerAbstractModuleWidget* panel)
{
  const auto answer = [file]
  {
    auto* dialog = qobject_cast<QDialog*>(QApplication::activeModalWidget());
    if (!dialog) return;
    findChild<QLineEdit>(dialog, "fileNameEdit")->setText(file);
    dialog->accept();
  };
  QTimer::singleShot(1500, qApp, answer);
  findChild<QPushButton>(panel, "ExportButton")->click();
  waitFor(1);
}

} // namespace surgicalmesher::test
