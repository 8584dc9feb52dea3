// SPDX-License-Identifier: Apache-2.0
#include "qSlicerFuchsTetrahedralizerModule.h"

#include "qSlicerFuchsTetrahedralizerModuleWidget.h"
#include "vtkSlicerFuchsTetrahedralizerLogic.h"

#include <QIcon>

qSlicerFuchsTetrahedralizerModule::qSlicerFuchsTetrahedralizerModule(QObject* parent) : Superclass(parent) {}

qSlicerFuchsTetrahedralizerModule::~qSlicerFuchsTetrahedralizerModule() = default;

QString qSlicerFuchsTetrahedralizerModule::helpText() const
{
  return tr(
    "<p>Fills a surface of many tissues with near-regular tetrahedra whose edge lengths follow a scale: a mesh for "
    "finite elements, with a fine child around the surgical target and a coarse parent.</p>"
    "<p>Choose what <i>Simplex Mesher</i> made, any other model with the cell array <tt>BoundaryLabels</tt>, or "
    "closed models, each of which becomes a tissue. The tetrahedra come as a model. They are cut open at a slice, "
    "coloured by tissue, sub-mesh or quality, measured in a table and in plots, and exported for solvers with "
    "named sets, materials and shells.</p>");
}

QString qSlicerFuchsTetrahedralizerModule::acknowledgementText() const
{
  return tr(
    "<p>After M. Audette, H. Delingette, A. Fuchs, O. Burgert and K. Chinzei, <i>A topologically faithful, "
    "tissue-guided, spatially varying meshing strategy for computing patient-specific head models for endoscopic "
    "pituitary surgery simulation</i>, Computer Aided Surgery 12(1), 2007, and A. Fuchs, <i>Automatic grid "
    "generation with almost regular Delaunay tetrahedra</i>, 7th International Meshing Roundtable, 1998.</p>"
    "<p>Surfaces without ambient tetrahedra are filled by TetGen (AGPL) and checked by CGAL (GPL), which bind "
    "whoever distributes this module; see the file NOTICE.</p>");
}

QStringList qSlicerFuchsTetrahedralizerModule::contributors() const
{
  return { tr("The SurgicalMesher contributors") };
}

QIcon qSlicerFuchsTetrahedralizerModule::icon() const { return QIcon(":/Icons/FuchsTetrahedralizer.png"); }

QStringList qSlicerFuchsTetrahedralizerModule::categories() const { return { "Surgical Meshing" }; }

QStringList qSlicerFuchsTetrahedralizerModule::dependencies() const
{
  return { "Colors", "FuchsTetrahedralizerCLI", "Plots", "Tables" };
}

QStringList qSlicerFuchsTetrahedralizerModule::associatedNodeTypes() const
{
  return { "vtkMRMLFuchsTetrahedralizerNode" };
}

qSlicerAbstractModuleRepresentation* qSlicerFuchsTetrahedralizerModule::createWidgetRepresentation()
{
  return new qSlicerFuchsTetrahedralizerModuleWidget;
}

vtkMRMLAbstractLogic* qSlicerFuchsTetrahedralizerModule::createLogic()
{
  return vtkSlicerFuchsTetrahedralizerLogic::New();
}
