// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The loadable module Fuchs Tetrahedralizer: creates, displays, assesses and exports tetrahedra from a surface.

#include "qSlicerFuchsTetrahedralizerModuleExport.h"

#include <qSlicerLoadableModule.h>

class Q_SLICER_QTMODULES_FUCHSTETRAHEDRALIZER_EXPORT qSlicerFuchsTetrahedralizerModule : public qSlicerLoadableModule
{
  Q_OBJECT
  Q_PLUGIN_METADATA(IID "org.slicer.modules.loadable.qSlicerLoadableModule/1.0");
  Q_INTERFACES(qSlicerLoadableModule);

public:
  typedef qSlicerLoadableModule Superclass;
  explicit qSlicerFuchsTetrahedralizerModule(QObject* parent = nullptr);
  ~qSlicerFuchsTetrahedralizerModule() override;

  qSlicerGetTitleMacro(tr("Fuchs Tetrahedralizer"));

  QString helpText() const override;
  QString acknowledgementText() const override;
  QStringList contributors() const override;
  QIcon icon() const override;
  QStringList categories() const override;
  QStringList dependencies() const override;
  QStringList associatedNodeTypes() const override;

protected:
  qSlicerAbstractModuleRepresentation* createWidgetRepresentation() override;
  vtkMRMLAbstractLogic* createLogic() override;

private:
  Q_DISABLE_COPY(qSlicerFuchsTetrahedralizerModule)
};
