// SPDX-License-Identifier: Apache-2.0
#include "Tutorial.h"

#include "HostApplication.h"
#include "HostLog.h"
#include "HostScene.h"
#include "MeshComparison.h"
#include "TutorialSteps.h"
#include "TutorialViews.h"
#include "Waiting.h"

#include <qMRMLCheckableNodeComboBox.h>
#include <qSlicerAbstractModuleWidget.h>
#include <qSlicerApplication.h>

#include <ctkSliderWidget.h>

#include <vtkMRMLApplicationLogic.h>
#include <vtkMRMLLabelMapVolumeNode.h>
#include <vtkMRMLLayoutNode.h>
#include <vtkMRMLMarkupsDisplayNode.h>
#include <vtkMRMLMarkupsNode.h>
#include <vtkMRMLModelNode.h>
#include <vtkMRMLScalarVolumeNode.h>
#include <vtkMRMLScene.h>
#include <vtkMRMLSegmentationDisplayNode.h>
#include <vtkMRMLSegmentationNode.h>
#include <vtkMRMLSelectionNode.h>
#include <vtkSlicerApplicationLogic.h>

#include <QCheckBox>
#include <QComboBox>
#include <QDir>
#include <QDoubleSpinBox>
#include <QFileInfo>
#include <QLabel>
#include <QPushButton>
#include <QRadioButton>

namespace surgicalmesher::test
{
namespace
{

constexpr Point SELLA{ 0, 0, -10 }; ///< near the pituitary gland, RAS
const std::vector<Point> TRANSNASAL_PATH{ { 0, 78, -34 }, { 0, 52, -26 }, { 0, 26, -17 }, SELLA };

class Tutorial
{
public:
  explicit Tutorial(const QString& folder) : m_Folder(folder) { QDir().mkpath(folder); }

  void walk()
  {
    arrangeMainWindow();
    m_Log.complaints(); // of the start, which is not the tutorial's business
    loadSegmentation();
    setScale();
    holdFarTissueStill();
    makeScale();
    setSurface();
    makeSurface();
    lookAtReport();
    makeTetrahedra();
    lookAtQuality();
    exportMesh();
    const std::string complaints = m_Log.complaints();
    require(complaints.empty(), "no warning and no error in the host's log, found:\n" + complaints);
  }

private:
  vtkMRMLScene* scene() const { return qSlicerApplication::application()->mrmlScene(); }

  void take(const QString& name) { takePicture(m_Folder + "/" + name + ".png"); }

  /// A patient's image and its segmentation: here a brain of one person and an atlas in the same space.
  void loadSegmentation()
  {
    vtkMRMLScalarVolumeNode* image = loadVolume(scene(), brainImageFile());
    qSlicerApplication* application = qSlicerApplication::application();
    application->applicationLogic()->GetSelectionNode()->SetActiveVolumeID(image->GetID());
    application->applicationLogic()->PropagateVolumeSelection();
    vtkMRMLLabelMapVolumeNode* atlas = loadJhuAtlas(scene());
    m_Segmentation = addSegmentation(scene(), atlas, "Brain");
    scene()->RemoveNode(atlas);
    vtkMRMLSegmentationDisplayNode::SafeDownCast(m_Segmentation->GetDisplayNode())->SetOpacity2DFill(0.6);
    openModule("Segmentations");
    showLayout(vtkMRMLLayoutNode::SlicerLayoutFourUpView);
    showSlicesAt(SELLA, 190);
    take("tutorial-1-segmentation");
  }

  /// A target and a path, the scale over the slices, and its profile as a plot.
  void setScale()
  {
    vtkMRMLMarkupsNode* target = addMarkups(scene(), "vtkMRMLMarkupsFiducialNode", { SELLA });
    target->SetName("Sella");
    vtkMRMLMarkupsNode* path = addMarkups(scene(), "vtkMRMLMarkupsCurveNode", TRANSNASAL_PATH);
    path->SetName("Transnasal");
    for (vtkMRMLMarkupsNode* markups : { target, path })
    {
      auto* display = vtkMRMLMarkupsDisplayNode::SafeDownCast(markups->GetDisplayNode());
      display->SetPointLabelsVisibility(false);
      display->SetPropertiesLabelVisibility(false);
    }
    m_Segmentation->SetDisplayVisibility(false);
    m_ScalePanel = openModule("SurgicalPathScale");
    choose(m_ScalePanel, "TissueMapSelector", m_Segmentation);
    choose(m_ScalePanel, "TargetsSelector", target);
    choose(m_ScalePanel, "PathSelector", path);
    findChild<ctkSliderWidget>(m_ScalePanel, "MinimumEdgeLengthSlider")->setValue(1.5);
    findChild<QCheckBox>(m_ScalePanel, "PreviewCheckBox")->setChecked(true);
    findChild<QCheckBox>(m_ScalePanel, "ProfileCheckBox")->setChecked(true);
    showSlicesAt(SELLA, 190);
    waitFor(3); // preview and estimate
    take("tutorial-2-scale");
  }

  void holdFarTissueStill()
  {
    collapse(m_ScalePanel, "EdgeLengthCollapsibleButton");
    expand(m_ScalePanel, "NullDisplacementCollapsibleButton");
    findChild<QDoubleSpinBox>(m_ScalePanel, "NullDisplacementRadiusSpinBox")->setValue(40);
    findChild<QDoubleSpinBox>(m_ScalePanel, "NullDisplacementPathDistanceSpinBox")->setValue(20);
    waitFor(3);
    take("tutorial-3-null-displacement");
    findChild<QDoubleSpinBox>(m_ScalePanel, "NullDisplacementRadiusSpinBox")->setValue(0);
    findChild<QDoubleSpinBox>(m_ScalePanel, "NullDisplacementPathDistanceSpinBox")->setValue(0);
  }

  void makeScale()
  {
    collapse(m_ScalePanel, "NullDisplacementCollapsibleButton");
    expand(m_ScalePanel, "EdgeLengthCollapsibleButton");
    apply(m_ScalePanel);
    waitForRun(m_ScalePanel);
  }

  void setSurface()
  {
    m_SurfacePanel = openModule("SimplexMesher");
    showLayout(vtkMRMLLayoutNode::SlicerLayoutFourUpView);
    hideForeground();
    m_Segmentation->SetDisplayVisibility(true);
    choose(m_SurfacePanel, "TissueMapSelector", m_Segmentation);
    findChild<QRadioButton>(m_SurfacePanel, "ScaleRadioButton")->setChecked(true);
    choose(m_SurfacePanel, "ScaleSelector", chosen(m_ScalePanel, "ScaleSelector"));
    findChild<QDoubleSpinBox>(m_SurfacePanel, "MinimumIslandVolumeSpinBox")->setValue(30);
    findChild<QCheckBox>(m_SurfacePanel, "TissueModelsCheckBox")->setChecked(true);
    waitFor(1);
    take("tutorial-4-tissues");
  }

  void makeSurface()
  {
    apply(m_SurfacePanel);
    waitFor(8);
    scrollTo(findChild<QWidget>(m_SurfacePanel, "RunWidget"));
    take("tutorial-5-running");
    waitForRun(m_SurfacePanel);
    collapse(m_SurfacePanel, "TissuesCollapsibleButton");
    auto* surface = vtkMRMLModelNode::SafeDownCast(chosen(m_SurfacePanel, "SurfaceSelector"));
    require(surface && surface->GetMesh() && surface->GetMesh()->GetNumberOfCells() > 10000, "a surface");
    showLayout(vtkMRMLLayoutNode::SlicerLayoutOneUp3DView);
    lookAt(SELLA, { 0.25, -0.75, 0.6 }, 100);
    scrollTo(findChild<QWidget>(m_SurfacePanel, "RunWidget"));
    take("tutorial-6-surface");
  }

  void lookAtReport()
  {
    collapse(m_SurfacePanel, "InputsCollapsibleButton");
    collapse(m_SurfacePanel, "OutputsCollapsibleButton");
    expand(m_SurfacePanel, "ReportCollapsibleButton");
    findChild<QPushButton>(m_SurfacePanel, "ShowPlotButton")->click();
    waitFor(1);
    take("tutorial-7-report");
  }

  void makeTetrahedra()
  {
    m_MeshPanel = openModule("FuchsTetrahedralizer");
    showLayout(vtkMRMLLayoutNode::SlicerLayoutConventionalWidescreenView);
    auto* surfaces = findChild<qMRMLCheckableNodeComboBox>(m_MeshPanel, "SurfaceComboBox");
    surfaces->setCheckState(chosen(m_SurfacePanel, "SurfaceSelector"), Qt::Checked);
    apply(m_MeshPanel);
    waitForRun(m_MeshPanel);
    showOnly(scene(), chosen(m_MeshPanel, "MeshComboBox"));
    showSlicesAt(SELLA, 190);
    lookAt({ 0, 0, 8 }, { -0.4, -0.9, -0.2 }, 150);
    collapse(m_MeshPanel, "OutputsCollapsibleButton");
    take("tutorial-8-tetrahedra");
  }

  /// Coloured by quality, with a histogram and the table.
  void lookAtQuality()
  {
    auto* colors = findChild<QComboBox>(m_MeshPanel, "ColorComboBox");
    select(colors, colors->count() - 1);
    findChild<QPushButton>(m_MeshPanel, "ShowHistogramButton")->click();
    findChild<QPushButton>(m_MeshPanel, "ShowTableButton")->click();
    showLayout(vtkMRMLLayoutNode::SlicerLayoutFourUpPlotTableView);
    scrollTo(findChild<QWidget>(m_MeshPanel, "ExportButton"));
    take("tutorial-9-quality");
  }

  /// Through the dialogue of the panel's button, answered as a user would.
  void exportMesh()
  {
    const QString file = QString::fromStdString(newFolder("TutorialExport")) + "/brain.inp";
    exportTo(file, m_MeshPanel);
    require(QFileInfo::exists(file),
            "an exported mesh, found: " + findChild<QLabel>(m_MeshPanel, "MeshInfoLabel")->text().toStdString());
    showLayout(vtkMRMLLayoutNode::SlicerLayoutConventionalWidescreenView);
    lookAt(SELLA, { -0.4, -0.9, -0.2 }, 70);
    take("tutorial-10-export");
  }

  QString m_Folder;
  HostLog m_Log;
  qSlicerAbstractModuleWidget* m_ScalePanel = nullptr;
  qSlicerAbstractModuleWidget* m_SurfacePanel = nullptr;
  qSlicerAbstractModuleWidget* m_MeshPanel = nullptr;
  vtkMRMLSegmentationNode* m_Segmentation = nullptr;
};

} // namespace

int walkTutorial(const QString& pictureFolder)
{
  if (jhuAtlasFile().empty() || brainImageFile().empty()) return SKIPPED;
  Tutorial(pictureFolder).walk();
  return 0;
}

} // namespace surgicalmesher::test
