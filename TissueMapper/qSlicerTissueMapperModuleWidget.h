// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "qSlicerTissueMapperModuleExport.h"

#include <qSlicerAbstractModuleWidget.h>

class qSlicerTissueMapperModuleWidgetPrivate;
class vtkMRMLNode;

/// The module panel. It shows the scene's parameter node and writes user input to it.
class Q_SLICER_QTMODULES_TISSUEMAPPER_EXPORT qSlicerTissueMapperModuleWidget : public qSlicerAbstractModuleWidget
{
  Q_OBJECT

public:
  using Superclass = qSlicerAbstractModuleWidget;

  explicit qSlicerTissueMapperModuleWidget(QWidget* parent = nullptr);
  ~qSlicerTissueMapperModuleWidget() override;

  void enter() override;
  void exit() override;
  /// Shows a parameter node; a scalar volume becomes the image, a label map the tissues, and markups the training
  /// points.
  bool setEditedNode(vtkMRMLNode* node, QString role = QString(), QString context = QString()) override;

public slots:
  void setMRMLScene(vtkMRMLScene* scene) override;

protected slots:
  /// Shows the values of the parameter node, and the reason why it cannot be run.
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
