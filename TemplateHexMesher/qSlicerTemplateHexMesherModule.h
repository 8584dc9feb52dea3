// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "qSlicerTemplateHexMesherModuleExport.h"

#include <qSlicerLoadableModule.h>

/// Registers the module with Slicer: its texts, its logic and its panel.
class Q_SLICER_QTMODULES_TEMPLATEHEXMESHER_EXPORT qSlicerTemplateHexMesherModule : public qSlicerLoadableModule
{
  Q_OBJECT
  Q_PLUGIN_METADATA(IID "org.slicer.modules.loadable.qSlicerLoadableModule/1.0");
  Q_INTERFACES(qSlicerLoadableModule);

public:
  using Superclass = qSlicerLoadableModule;

  explicit qSlicerTemplateHexMesherModule(QObject* parent = nullptr);
  ~qSlicerTemplateHexMesherModule() override;

  qSlicerGetTitleMacro(tr("Template Hex Mesher"));

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
  Q_DISABLE_COPY(qSlicerTemplateHexMesherModule)
};
