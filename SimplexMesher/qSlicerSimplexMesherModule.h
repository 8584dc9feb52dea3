// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "qSlicerSimplexMesherModuleExport.h"

#include <qSlicerLoadableModule.h>

/// The loadable module: its texts, logic and panel.
class Q_SLICER_QTMODULES_SIMPLEXMESHER_EXPORT qSlicerSimplexMesherModule : public qSlicerLoadableModule
{
  Q_OBJECT
  Q_PLUGIN_METADATA(IID "org.slicer.modules.loadable.qSlicerLoadableModule/1.0");
  Q_INTERFACES(qSlicerLoadableModule);

public:
  using Superclass = qSlicerLoadableModule;

  explicit qSlicerSimplexMesherModule(QObject* parent = nullptr);
  ~qSlicerSimplexMesherModule() override;

  qSlicerGetTitleMacro(tr("Simplex Mesher"));

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
  Q_DISABLE_COPY(qSlicerSimplexMesherModule)
};
