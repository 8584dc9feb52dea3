// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "qSlicerTissueMapperModuleExport.h"

#include <qSlicerAbstractModuleWidget.h>

class qSlicerTissueMapperModuleWidgetPrivate;
class vtkMRMLNode;

/// The panel. It shows the scene's parameter node, and writes to it what the user enters.
class Q_SLICER_QTMODULES_TISSUEMAPPER_EXPORT qSlicerTissueMapperModuleWidget : public qSlicerAbstractModuleWidget
{
  Q_OBJECT

public:
  using Superclass = qSlicerAbstractModuleWidget;

  explicit qSlicerTissueMapperModuleWidget(QWidget* parent = nullptr);
  ~qSlicerTissueMapperModuleWidget() override;

  void enter() override;
  void exit() override;
  /// A parameter node is shown; volumes become the image, points those of training.
  bool setEditedNode(vtkMRMLNode* node, QString role = QString(), QString context = QString()) override;

public slots:
  void setMRMLScene(vtkMRMLScene* scene) override;

protected slots:
  /// Shows what the parameter node says, and what keeps it from being run.
  void updateFromNode();
  void onInputChanged();
  void onSceneReplaced();
  void chooseClass(int row);
  void apply();
  void onRunEnded();
  void openScale();
  void openMesher();

protected:
  void setup() override;

private:
  QScopedPointer<qSlicerTissueMapperModuleWidgetPrivate> d_ptr;
  Q_DECLARE_PRIVATE(qSlicerTissueMapperModuleWidget)
  Q_DISABLE_COPY(qSlicerTissueMapperModuleWidget)
};
