// SPDX-License-Identifier: Apache-2.0
#include "qSlicerSurgicalPathScaleModule.h"

#include "qSlicerSurgicalPathScaleModuleWidget.h"
#include "vtkSlicerSurgicalPathScaleLogic.h"

qSlicerSurgicalPathScaleModule::qSlicerSurgicalPathScaleModule(QObject* parent) : Superclass(parent) {}

qSlicerSurgicalPathScaleModule::~qSlicerSurgicalPathScaleModule() = default;

QString qSlicerSurgicalPathScaleModule::helpText() const
{
  return tr(
    "<p>How long should the edges of a mesh be? Within the child radius of a surgical target or path the minimum, "
    "farther away rising exponentially to the maximum, at a rate given by the decay length. The result is a volume "
    "of edge lengths in mm, which <i>Simplex Mesher</i> and <i>Fuchs Tetrahedralizer</i> follow.</p>"
    "<p>Choose the tissues, place a target or a path, and move the sliders: the slice views show the edge lengths, "
    "and the panel tells how large a mesh to expect. Tissue far from every target and path can become one label "
    "that the simulation holds still (null displacement).</p>");
}

QString qSlicerSurgicalPathScaleModule::acknowledgementText() const
{
  return tr(
    "<p>After M. A. Audette, H. Delingette, A. Fuchs, O. Astley, K. Chinzei: A topologically faithful, "
    "tissue-guided, spatially varying meshing strategy for computing patient-specific head models for endoscopic "
    "pituitary surgery simulation. Computer Aided Surgery 12(1):43-52, 2007.</p>"
    "<p>Apache License 2.0.</p>");
}

QStringList qSlicerSurgicalPathScaleModule::contributors() const { return { tr("The SurgicalMesher contributors") }; }

QIcon qSlicerSurgicalPathScaleModule::icon() const { return QIcon(":/Icons/SurgicalPathScale.png"); }

QStringList qSlicerSurgicalPathScaleModule::categories() const { return { tr("Surgical Meshing") }; }

QStringList qSlicerSurgicalPathScaleModule::dependencies() const
{
  return { "Colors", "Markups", "Plots", "Segmentations" };
}

QStringList qSlicerSurgicalPathScaleModule::associatedNodeTypes() const { return { "vtkMRMLSurgicalPathScaleNode" }; }

qSlicerAbstractModuleRepresentation* qSlicerSurgicalPathScaleModule::createWidgetRepresentation()
{
  return new qSlicerSurgicalPathScaleModuleWidget;
}

vtkMRMLAbstractLogic* qSlicerSurgicalPathScaleModule::createLogic() { return vtkSlicerSurgicalPathScaleLogic::New(); }
