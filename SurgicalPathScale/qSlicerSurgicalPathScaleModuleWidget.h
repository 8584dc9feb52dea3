// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "qSlicerSurgicalPathScaleModuleExport.h"

#include <qSlicerAbstractModuleWidget.h>

class qSlicerSurgicalPathScaleModuleWidgetPrivate;
class vtkMRMLNode;

/// The panel of the module. It shows the scene's parameter node and writes the user's input to it. The preview is shown
/// only while the panel is open.
class Q_SLICER_QTMODULES_SURGICALPATHSCALE_EXPORT qSlicerSurgicalPathScaleModuleWidget
  : public qSlicerAbstractModuleWidget
{
  Q_OBJECT

public:
  using Superclass = qSlicerAbstractModuleWidget;

  explicit qSlicerSurgicalPathScaleModuleWidget(QWidget* parent = nullptr);
  ~qSlicerSurgicalPathScaleModuleWidget() override;

  void enter() override;
  void exit() override;
  /// Shows a parameter node; segmentations, label maps and markups become inputs.
  bool setEditedNode(vtkMRMLNode* node, QString role = QString(), QString context = QString()) override;

public slots:
  void setMRMLScene(vtkMRMLScene* scene) override;

protected slots:
  /// Shows the values of the parameter node, and the problem that prevents a run, if any.
  void updateFromNode();
  void onInputChanged();
  void onSceneReplaced();
  void updatePreview();
  void updateEstimate();
  void showProfile(bool isWanted);
  void apply();
  void onRunEnded();

protected:
  void setup() override;

private:
  QScopedPointer<qSlicerSurgicalPathScaleModuleWidgetPrivate> d_ptr;
  Q_DECLARE_PRIVATE(qSlicerSurgicalPathScaleModuleWidget)
  Q_DISABLE_COPY(qSlicerSurgicalPathScaleModuleWidget)
};
