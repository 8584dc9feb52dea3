// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "qSlicerSurgicalPathScaleModuleExport.h"

#include <qSlicerLoadableModule.h>

/// The loadable module: its texts, logic and panel.
class Q_SLICER_QTMODULES_SURGICALPATHSCALE_EXPORT qSlicerSurgicalPathScaleModule : public qSlicerLoadableModule
{
  Q_OBJECT
  Q_PLUGIN_METADATA(IID "org.slicer.modules.loadable.qSlicerLoadableModule/1.0");
  Q_INTERFACES(qSlicerLoadableModule);

public:
  using Superclass = qSlicerLoadableModule;

  explicit qSlicerSurgicalPathScaleModule(QObject* parent = nullptr);
  ~qSlicerSurgicalPathScaleModule() override;

  qSlicerGetTitleMacro(tr("Surgical Path Scale"));

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
  Q_DISABLE_COPY(qSlicerSurgicalPathScaleModule)
};
