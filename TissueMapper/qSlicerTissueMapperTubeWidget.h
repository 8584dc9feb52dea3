// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "qSlicerTissueMapperModuleExport.h"

#include <ctkVTKObject.h>
#include <qSlicerWidget.h>

class qSlicerTissueMapperTubeWidgetPrivate;
class vtkMRMLTissueMapperNode;
class vtkSlicerTissueMapperLogic;

/// Section of the panel that traces vessels and nerves: points, path, and the tube as a tissue.
class Q_SLICER_QTMODULES_TISSUEMAPPER_EXPORT qSlicerTissueMapperTubeWidget : public qSlicerWidget
{
  Q_OBJECT
  QVTK_OBJECT

public:
  using Superclass = qSlicerWidget;

  explicit qSlicerTissueMapperTubeWidget(QWidget* parent = nullptr);
  ~qSlicerTissueMapperTubeWidget() override;

  void setLogic(vtkSlicerTissueMapperLogic* logic);
  void setParameterNode(vtkMRMLTissueMapperNode* node);
  /// Sets whether the panel is open; paths are updated automatically only while it is.
  void setActive(bool isActive);

protected slots:
  void updateFromNode();
  void onInputChanged();
  void followPoints();
  void trace();
  void addTube();
  void onRunEnded();

private:
  QScopedPointer<qSlicerTissueMapperTubeWidgetPrivate> d_ptr;
  Q_DECLARE_PRIVATE(qSlicerTissueMapperTubeWidget)
  Q_DISABLE_COPY(qSlicerTissueMapperTubeWidget)
};
