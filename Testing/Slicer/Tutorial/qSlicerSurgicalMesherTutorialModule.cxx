// SPDX-License-Identifier: Apache-2.0
#include "qSlicerSurgicalMesherTutorialModule.h"

#include "Tutorial.h"

#include <qSlicerApplication.h>

#include <QTimer>

#include <exception>
#include <iostream>

qSlicerSurgicalMesherTutorialModule::qSlicerSurgicalMesherTutorialModule(QObject* parent)
  : qSlicerLoadableModule(parent)
{
}

QString qSlicerSurgicalMesherTutorialModule::title() const { return tr("Surgical Mesher Tutorial"); }

bool qSlicerSurgicalMesherTutorialModule::isHidden() const { return true; }

QStringList qSlicerSurgicalMesherTutorialModule::dependencies() const
{
  return { "TissueMapper", "SurgicalPathScale", "SimplexMesher", "FuchsTetrahedralizer", "Segmentations", "Volumes" };
}

void qSlicerSurgicalMesherTutorialModule::setup()
{
  if (!qEnvironmentVariableIsSet("SURGICALMESHER_TUTORIAL")) return;
  QObject::connect(qSlicerApplication::application(), &qSlicerApplication::startupCompleted, this,
                   [this] { QTimer::singleShot(0, this, [this] { this->walk(); }); });
}

void qSlicerSurgicalMesherTutorialModule::walk()
{
  int status = EXIT_SUCCESS;
  try
  {
    const QString folder = qEnvironmentVariable("SURGICALMESHER_TUTORIAL");
    const bool isOfImage = qEnvironmentVariable("SURGICALMESHER_TUTORIAL_FROM") == "image";
    status = isOfImage ? surgicalmesher::test::walkImageTutorial(folder) : surgicalmesher::test::walkTutorial(folder);
  }
  catch (const std::exception& e)
  {
    std::cerr << "tutorial: " << e.what() << std::endl;
    status = EXIT_FAILURE;
  }
  QCoreApplication::exit(status);
}

qSlicerAbstractModuleRepresentation* qSlicerSurgicalMesherTutorialModule::createWidgetRepresentation()
{
  return nullptr;
}

vtkMRMLAbstractLogic* qSlicerSurgicalMesherTutorialModule::createLogic() { return nullptr; }
