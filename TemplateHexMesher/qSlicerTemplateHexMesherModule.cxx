// SPDX-License-Identifier: Apache-2.0
#include "qSlicerTemplateHexMesherModule.h"

#include "qSlicerTemplateHexMesherModuleWidget.h"
#include "vtkSlicerTemplateHexMesherLogic.h"

qSlicerTemplateHexMesherModule::qSlicerTemplateHexMesherModule(QObject* parent) : Superclass(parent) {}

qSlicerTemplateHexMesherModule::~qSlicerTemplateHexMesherModule() = default;

QString qSlicerTemplateHexMesherModule::helpText() const
{
  return tr(
    "<p>Fits one template, a mesh of hexahedra or a surface that was made with care once, to a patient's surface, and "
    "leaves no element invalid: choose both, place pairs of landmarks, and Apply. The preview shows where the "
    "landmarks alone take the template.</p>"
    "<p>What lies in the template, muscles for one, goes along. Templates are made by "
    "<i>Volumetric Hex</i>.</p>");
}

QString qSlicerTemplateHexMesherModule::acknowledgementText() const
{
  return tr("<p>After Kim et al.: An eFTD-VP framework for efficiently generating patient-specific anatomically "
            "detailed facial soft tissue FE mesh for craniomaxillofacial surgery simulation. Biomechanics and Modeling "
            "in Mechanobiology 17, 2018.</p>"
            "<p>Apache License 2.0.</p>");
}

QStringList qSlicerTemplateHexMesherModule::contributors() const { return { tr("The SurgicalMesher contributors") }; }

QIcon qSlicerTemplateHexMesherModule::icon() const { return QIcon(":/Icons/TemplateHexMesher.png"); }

QStringList qSlicerTemplateHexMesherModule::categories() const { return { tr("Surgical Meshing") }; }

QStringList qSlicerTemplateHexMesherModule::dependencies() const { return { "Colors", "Markups", "Tables" }; }

QStringList qSlicerTemplateHexMesherModule::associatedNodeTypes() const { return { "vtkMRMLTemplateHexMesherNode" }; }

qSlicerAbstractModuleRepresentation* qSlicerTemplateHexMesherModule::createWidgetRepresentation()
{
  return new qSlicerTemplateHexMesherModuleWidget;
}

vtkMRMLAbstractLogic* qSlicerTemplateHexMesherModule::createLogic() { return vtkSlicerTemplateHexMesherLogic::New(); }
