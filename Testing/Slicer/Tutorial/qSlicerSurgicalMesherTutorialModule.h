// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A module that, once the host has started, walks the tutorial and ends the host: exit status 0 if every step did what
/// it should, 1 if one did not, 77 if the atlas is not installed. It does nothing unless the environment variable
/// SURGICALMESHER_TUTORIAL names the folder for the pictures. With SURGICALMESHER_TUTORIAL_FROM=image it is the tutorial
/// that begins with an image.

#include <qSlicerLoadableModule.h>

class qSlicerSurgicalMesherTutorialModule : public qSlicerLoadableModule
{
  Q_OBJECT
  Q_PLUGIN_METADATA(IID "org.slicer.modules.loadable.qSlicerLoadableModule/1.0")
  Q_INTERFACES(qSlicerLoadableModule)

public:
  explicit qSlicerSurgicalMesherTutorialModule(QObject* parent = nullptr);

  QString title() const override;
  bool isHidden() const override;
  QStringList dependencies() const override;

protected:
  void setup() override;
  qSlicerAbstractModuleRepresentation* createWidgetRepresentation() override;
  vtkMRMLAbstractLogic* createLogic() override;

private:
  void walk();

  Q_DISABLE_COPY(qSlicerSurgicalMesherTutorialModule)
};
