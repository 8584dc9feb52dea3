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
  return { "SurgicalPathScale", "SimplexMesher", "FuchsTetrahedralizer", "Segmentations", "Volumes" };
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
    status = surgicalmesher::test::walkTutorial(qEnvironmentVariable("SURGICALMESHER_TUTORIAL"));
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
