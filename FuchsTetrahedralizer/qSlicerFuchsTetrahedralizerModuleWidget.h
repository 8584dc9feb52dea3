// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The panel of Fuchs Tetrahedralizer. It shows the scene's parameter node and writes the user's input to it.

#include "qSlicerFuchsTetrahedralizerModuleExport.h"

#include <qSlicerAbstractModuleWidget.h>

#include <ctkVTKObject.h>

#include <QScopedPointer>

class qSlicerFuchsTetrahedralizerModuleWidgetPrivate;
class vtkMRMLNode;
class vtkMRMLScene;

class Q_SLICER_QTMODULES_FUCHSTETRAHEDRALIZER_EXPORT qSlicerFuchsTetrahedralizerModuleWidget
  : public qSlicerAbstractModuleWidget
{
  Q_OBJECT
  QVTK_OBJECT

public:
  typedef qSlicerAbstractModuleWidget Superclass;
  explicit qSlicerFuchsTetrahedralizerModuleWidget(QWidget* parent = nullptr);
  ~qSlicerFuchsTetrahedralizerModuleWidget() override;

  bool setEditedNode(vtkMRMLNode* node, QString role = QString(), QString context = QString()) override;

  /// Exports the mesh without a file dialog, and shows the outcome in the panel. Returns false on failure.
  Q_INVOKABLE bool exportMesh(const QString& file);

public slots:
  void setMRMLScene(vtkMRMLScene* scene) override;

protected:
  void setup() override;
  void enter() override;

protected slots:
  void onSceneClosed();
  void onSceneImported();
  void updateFromNode();
  void updateClipSlider();
  void apply();
  void onRunEnded();
  void onExport();
  void onAssess();
  void showHistogram();
  void showTable();

private:
  Q_DECLARE_PRIVATE(qSlicerFuchsTetrahedralizerModuleWidget)
  Q_DISABLE_COPY(qSlicerFuchsTetrahedralizerModuleWidget)
  QScopedPointer<qSlicerFuchsTetrahedralizerModuleWidgetPrivate> d_ptr;
};
