// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "qSlicerTissueMapperModuleExport.h"

#include <ctkVTKObject.h>
#include <qSlicerWidget.h>

class qSlicerTissueMapperCompartmentsWidgetPrivate;
class vtkMRMLTissueMapperNode;
class vtkSlicerTissueMapperLogic;

/// Section of the panel that shows a preview of the compartments in coarse voxels.
class Q_SLICER_QTMODULES_TISSUEMAPPER_EXPORT qSlicerTissueMapperCompartmentsWidget : public qSlicerWidget
{
  Q_OBJECT
  QVTK_OBJECT

public:
  using Superclass = qSlicerWidget;

  explicit qSlicerTissueMapperCompartmentsWidget(QWidget* parent = nullptr);
  ~qSlicerTissueMapperCompartmentsWidget() override;

  void setLogic(vtkSlicerTissueMapperLogic* logic);
  void setParameterNode(vtkMRMLTissueMapperNode* node);
  /// Sets whether the panel is open; compartments are updated automatically only while it is.
  void setActive(bool isActive);

protected slots:
  void updateFromNode();
  void onInputChanged();
  void followInputs();
  void find();
  void showTissues();
  void onRunEnded();

private:
  QScopedPointer<qSlicerTissueMapperCompartmentsWidgetPrivate> d_ptr;
  Q_DECLARE_PRIVATE(qSlicerTissueMapperCompartmentsWidget)
  Q_DISABLE_COPY(qSlicerTissueMapperCompartmentsWidget)
};
