// SPDX-License-Identifier: Apache-2.0
#include "qSlicerTissueMapperModule.h"

#include "qSlicerTissueMapperModuleWidget.h"
#include "vtkSlicerTissueMapperLogic.h"

qSlicerTissueMapperModule::qSlicerTissueMapperModule(QObject* parent) : Superclass(parent) {}

qSlicerTissueMapperModule::~qSlicerTissueMapperModule() = default;

QString qSlicerTissueMapperModule::helpText() const
{
  return tr(
    "<p>From images of a head to the label map that <i>Simplex Mesher</i> starts from: choose an MR image, a CT, or "
    "both "
    "on one grid, place some twenty points in each tissue, and Apply. What lies within the skull and what outside is "
    "found first, and each tissue is admitted where it can be.</p>"
    "<p>The tissues go on to <i>Surgical Path Scale</i> and <i>Simplex Mesher</i> by a button.</p>");
}

QString qSlicerTissueMapperModule::acknowledgementText() const
{
  return tr(
    "<p>After M. A. Audette, H. Delingette, A. Fuchs, O. Astley, K. Chinzei: A topologically faithful, "
    "tissue-guided, spatially varying meshing strategy for computing patient-specific head models for endoscopic "
    "pituitary surgery simulation. Computer Aided Surgery 12(1):43-52, 2007.</p>"
    "<p>Apache License 2.0.</p>");
}

QStringList qSlicerTissueMapperModule::contributors() const { return { tr("The SurgicalMesher contributors") }; }

QIcon qSlicerTissueMapperModule::icon() const { return QIcon(":/Icons/TissueMapper.png"); }

QStringList qSlicerTissueMapperModule::categories() const { return { tr("Surgical Meshing") }; }

QStringList qSlicerTissueMapperModule::dependencies() const
{
  return { "Colors", "Markups", "Segmentations", "Volumes" };
}

QStringList qSlicerTissueMapperModule::associatedNodeTypes() const { return { "vtkMRMLTissueMapperNode" }; }

qSlicerAbstractModuleRepresentation* qSlicerTissueMapperModule::createWidgetRepresentation()
{
  return new qSlicerTissueMapperModuleWidget;
}

vtkMRMLAbstractLogic* qSlicerTissueMapperModule::createLogic() { return vtkSlicerTissueMapperLogic::New(); }
