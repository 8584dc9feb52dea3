// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "qSlicerSimplexMesherModuleExport.h"

#include <qSlicerAbstractModuleWidget.h>

class qSlicerSimplexMesherModuleWidgetPrivate;
class vtkMRMLNode;

/// The panel. It shows the scene's parameter node, and writes to it what the user enters.
class Q_SLICER_QTMODULES_SIMPLEXMESHER_EXPORT qSlicerSimplexMesherModuleWidget : public qSlicerAbstractModuleWidget
{
  Q_OBJECT

public:
  using Superclass = qSlicerAbstractModuleWidget;

  explicit qSlicerSimplexMesherModuleWidget(QWidget* parent = nullptr);
  ~qSlicerSimplexMesherModuleWidget() override;

  void enter() override;
  /// A parameter node is shown; a segmentation, label map or scale volume becomes an input.
  bool setEditedNode(vtkMRMLNode* node, QString role = QString(), QString context = QString()) override;

public slots:
  void setMRMLScene(vtkMRMLScene* scene) override;

protected slots:
  /// Shows what the parameter node says, and what keeps it from being run.
  void updateFromNode();
  void onSceneReplaced();
  void onSceneChanged();
  /// The map or its voxels changed: its tissues are listed again, once it is quiet.
  void onTissueMapChanged();
  /// Scale or runs changed: what is in the way is said again.
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
