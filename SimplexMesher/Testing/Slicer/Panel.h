// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The panel of Simplex Mesher in a test.

#include "HostApplication.h"
#include "HostScene.h"
#include "qSlicerSimplexMesherTissueTable.h"
#include "qSurgicalMesherRunWidget.h"
#include "vtkMRMLSimplexMesherNode.h"
#include "vtkSlicerSimplexMesherLogic.h"
#include "vtkSurgicalMesherRun.h"

#include <qMRMLNodeComboBox.h>
#include <qSlicerAbstractModuleWidget.h>

#include <QAbstractItemModel>
#include <QPushButton>
#include <QTableView>

namespace surgicalmesher::test
{

struct Panel
{
  HostApplication& host;
  qSlicerAbstractModuleWidget* widget = host.enterPanel("SimplexMesher");
  vtkSlicerSimplexMesherLogic* logic = vtkSlicerSimplexMesherLogic::SafeDownCast(host.logic("SimplexMesher"));
  vtkSurgicalMesherRun* run = logic->GetRun();

  vtkMRMLSimplexMesherNode* node() const { return logic->ParameterNode(); }

  template <class Widget>
  Widget* child(const char* name) const
  {
    return findChild<Widget>(widget, name);
  }
  qSlicerSimplexMesherTissueTable* table() const { return child<qSlicerSimplexMesherTissueTable>("TissueTable"); }
  std::string problem() const { return child<qSurgicalMesherRunWidget>("RunWidget")->problem().toStdString(); }
  void choose(const char* selector, vtkMRMLNode* chosen) const
  {
    child<qMRMLNodeComboBox>(selector)->setCurrentNode(chosen);
  }
  void press(const char* button) const { child<QPushButton>(button)->click(); }

  QVariant cell(int row, int column, int role = Qt::DisplayRole) const
  {
    return table()->view()->model()->index(row, column).data(role);
  }
  void edit(int row, int column, const QVariant& value, int role = Qt::EditRole) const
  {
    QAbstractItemModel* model = table()->view()->model();
    model->setData(model->index(row, column), value, role);
  }

  bool waitForEnd() const
  {
    return host.waitUntil([this] { return !run->IsBusy(); });
  }
  /// Apply, to its end. False if no run began.
  bool apply() const
  {
    press("ApplyButton");
    return run->IsBusy() && waitForEnd();
  }
};

} // namespace surgicalmesher::test
