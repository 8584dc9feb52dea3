// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "qSlicerSimplexMesherModuleExport.h"

#include <qSlicerAbstractModuleWidget.h>

class qSlicerSimplexMesherModuleWidgetPrivate;
class vtkMRMLNode;

/// The panel of the module. It shows the scene's parameter node and writes the user's input to it.
class Q_SLICER_QTMODULES_SIMPLEXMESHER_EXPORT qSlicerSimplexMesherModuleWidget : public qSlicerAbstractModuleWidget
{
  Q_OBJECT

public:
  using Superclass = qSlicerAbstractModuleWidget;

  explicit qSlicerSimplexMesherModuleWidget(QWidget* parent = nullptr);
  ~qSlicerSimplexMesherModuleWidget() override;

  void enter() override;
  /// Shows a parameter node; a segmentation or label map becomes the input.
  bool setEditedNode(vtkMRMLNode* node, QString role = QString(), QString context = QString()) override;

public slots:
  void setMRMLScene(vtkMRMLScene* scene) override;

protected slots:
  /// Shows the values of the parameter node, and the problem that prevents a run, if any.
  void updateFromNode();
  void onSceneReplaced();
  void onSceneChanged();
  /// The map or its voxels changed: lists its tissues again after a pause.
  void onTissueMapChanged();
  /// The scale or a run changed: updates the displayed problem.
  void onObstacleChanged();
  void listTissues();
  void apply();
  void onRunEnded();
  void showReport();
  void showPlot();

protected:
  void setup() override;

private:
  QScopedPointer<qSlicerSimplexMesherModuleWidgetPrivate> d_ptr;
  Q_DECLARE_PRIVATE(qSlicerSimplexMesherModuleWidget)
  Q_DISABLE_COPY(qSlicerSimplexMesherModuleWidget)
};
