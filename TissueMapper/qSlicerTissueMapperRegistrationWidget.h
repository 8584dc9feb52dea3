// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "qSlicerTissueMapperModuleExport.h"

#include <ctkVTKObject.h>
#include <qSlicerWidget.h>

class qSlicerTissueMapperRegistrationWidgetPrivate;
class vtkMRMLTissueMapperNode;
class vtkSlicerTissueMapperLogic;

/// Section of the panel that registers one image to another.
class Q_SLICER_QTMODULES_TISSUEMAPPER_EXPORT qSlicerTissueMapperRegistrationWidget : public qSlicerWidget
{
  Q_OBJECT
  QVTK_OBJECT

public:
  using Superclass = qSlicerWidget;

  explicit qSlicerTissueMapperRegistrationWidget(QWidget* parent = nullptr);
  ~qSlicerTissueMapperRegistrationWidget() override;

  void setLogic(vtkSlicerTissueMapperLogic* logic);
  void setParameterNode(vtkMRMLTissueMapperNode* node);
  /// Sets whether the panel is open.
  void setActive(bool isActive);

protected slots:
  void updateFromNode();
  void onInputChanged();
  void registerImages();
  void onRunEnded();

private:
  QScopedPointer<qSlicerTissueMapperRegistrationWidgetPrivate> d_ptr;
  Q_DECLARE_PRIVATE(qSlicerTissueMapperRegistrationWidget)
  Q_DISABLE_COPY(qSlicerTissueMapperRegistrationWidget)
};
