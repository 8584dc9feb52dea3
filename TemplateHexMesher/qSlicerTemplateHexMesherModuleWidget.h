// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "qSlicerTemplateHexMesherModuleExport.h"

#include <qSlicerAbstractModuleWidget.h>

class qSlicerTemplateHexMesherModuleWidgetPrivate;
class vtkMRMLNode;

/// The module panel. It shows the scene's parameter node and writes user input to it.
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
  /// Shows a parameter node; a model becomes the template, and markups its landmarks.
  bool setEditedNode(vtkMRMLNode* node, QString role = QString(), QString context = QString()) override;

public slots:
  void setMRMLScene(vtkMRMLScene* scene) override;

protected slots:
  /// Shows the values of the parameter node, and the reason why it cannot be run.
  void updateFromNode();
  void onInputChanged();
  void onSceneReplaced();
  /// Updates preview and views; called once for several changes.
  void updateDisplay();
  /// Starts or ends the placing of pairs: alternately a point on the template and one on the patient.
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
