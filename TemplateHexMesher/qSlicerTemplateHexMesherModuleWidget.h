// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "qSlicerTemplateHexMesherModuleExport.h"

#include <qSlicerAbstractModuleWidget.h>

class qSlicerTemplateHexMesherModuleWidgetPrivate;
class vtkMRMLNode;

/// The panel. It shows the scene's parameter node, and writes to it what the user enters.
class Q_SLICER_QTMODULES_TEMPLATEHEXMESHER_EXPORT qSlicerTemplateHexMesherModuleWidget
  : public qSlicerAbstractModuleWidget
{
  Q_OBJECT

public:
  using Superclass = qSlicerAbstractModuleWidget;

  explicit qSlicerTemplateHexMesherModuleWidget(QWidget* parent = nullptr);
  ~qSlicerTemplateHexMesherModuleWidget() override;

  void enter() override;
  void exit() override;
  /// A parameter node is shown; models become the template, points its landmarks.
  bool setEditedNode(vtkMRMLNode* node, QString role = QString(), QString context = QString()) override;

public slots:
  void setMRMLScene(vtkMRMLScene* scene) override;

protected slots:
  /// Shows what the parameter node says, and what keeps it from being run.
  void updateFromNode();
  void onInputChanged();
  void onSceneReplaced();
  /// Preview and views, once for many changes.
  void updateDisplay();
  /// Pairs are placed one point on the template, one on the patient.
  void placePairs(bool isOn);
  void followPlacing();
  void removeLandmark();
  void apply();
  void onRunEnded();
  void showTable();

protected:
  void setup() override;

private:
  QScopedPointer<qSlicerTemplateHexMesherModuleWidgetPrivate> d_ptr;
  Q_DECLARE_PRIVATE(qSlicerTemplateHexMesherModuleWidget)
  Q_DISABLE_COPY(qSlicerTemplateHexMesherModuleWidget)
};
