// SPDX-License-Identifier: Apache-2.0
#include "qSlicerSimplexMesherModule.h"

#include "qSlicerSimplexMesherModuleWidget.h"
#include "vtkSlicerSimplexMesherLogic.h"

qSlicerSimplexMesherModule::qSlicerSimplexMesherModule(QObject* parent) : Superclass(parent) {}

qSlicerSimplexMesherModule::~qSlicerSimplexMesherModule() = default;

QString qSlicerSimplexMesherModule::helpText() const
{
  return tr(
    "<p>Turns a segmentation or label map into the boundaries of all its tissues at once: one complex of "
    "triangles, in which a face between two tissues exists once, every tissue keeps the connected pieces, tunnels "
    "and cavities that it has in the map, nothing crosses, and edges are as long as the scale asks for.</p>"
    "<p>Choose the tissues and a scale volume made by <i>Surgical Path Scale</i>, or one edge length, and press "
    "Apply. The surface and the tetrahedra around it are what <i>Fuchs Tetrahedralizer</i> begins with.</p>");
}

QString qSlicerSimplexMesherModule::acknowledgementText() const
{
  return tr(
    "<p>After M. A. Audette, H. Delingette, A. Fuchs, O. Astley, K. Chinzei: A topologically faithful, "
    "tissue-guided, spatially varying meshing strategy for computing patient-specific head models for endoscopic "
    "pituitary surgery simulation. Computer Aided Surgery 12(1):43-52, 2007; and H. Delingette: General object "
    "reconstruction based on simplex meshes. International Journal of Computer Vision 32(2):111-146, 1999.</p>"
    "<p>Apache License 2.0.</p>");
}

QStringList qSlicerSimplexMesherModule::contributors() const { return { tr("The SurgicalMesher contributors") }; }

QIcon qSlicerSimplexMesherModule::icon() const { return QIcon(":/Icons/SimplexMesher.png"); }

QStringList qSlicerSimplexMesherModule::categories() const { return { tr("Surgical Meshing") }; }

QStringList qSlicerSimplexMesherModule::dependencies() const { return { "Segmentations", "Plots" }; }

QStringList qSlicerSimplexMesherModule::associatedNodeTypes() const { return { "vtkMRMLSimplexMesherNode" }; }

qSlicerAbstractModuleRepresentation* qSlicerSimplexMesherModule::createWidgetRepresentation()
{
  return new qSlicerSimplexMesherModuleWidget;
}

vtkMRMLAbstractLogic* qSlicerSimplexMesherModule::createLogic() { return vtkSlicerSimplexMesherLogic::New(); }
