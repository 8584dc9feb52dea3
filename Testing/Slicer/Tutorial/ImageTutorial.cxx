// SPDX-License-Identifier: Apache-2.0
#include "HostApplication.h"
#include "HostLog.h"
#include "HostScene.h"
#include "MeshComparison.h"
#include "TissueMapIO.h"
#include "Tutorial.h"
#include "TutorialSteps.h"
#include "TutorialViews.h"
#include "Waiting.h"

#include <qMRMLCheckableNodeComboBox.h>
#include <qSlicerAbstractModuleWidget.h>
#include <qSlicerApplication.h>

#include <ctkSliderWidget.h>

#include <vtkMRMLLayoutNode.h>
#include <vtkMRMLMarkupsDisplayNode.h>
#include <vtkMRMLMarkupsNode.h>
#include <vtkMRMLModelNode.h>
#include <vtkMRMLScalarVolumeNode.h>
#include <vtkMRMLScene.h>

#include <QCheckBox>
#include <QDir>
#include <QDoubleSpinBox>
#include <QFileInfo>
#include <QLineEdit>
#include <QPushButton>
#include <QRadioButton>

namespace surgicalmesher::test
{
namespace
{

const std::string sources = SURGICALMESHER_SOURCES;
constexpr double HEAD_WIDTH = 260; ///< mm

/// Control points of a file, with their labels.
Markup pointsOf(const std::string& file) { return readLabelledMarkups(sources + "/" + file).front(); }

Point toRas(const Vec3& lps) { return { -lps.x, -lps.y, lps.z }; }

class ImageTutorial
{
public:
  explicit ImageTutorial(const QString& folder) : m_Folder(folder) { QDir().mkpath(folder); }

  void walk()
  {
    arrangeMainWindow();
    m_Log.complaints(); // of the start, which is not the tutorial's business
    loadImage();
    placeTrainingPoints();
    lookAtCompartments();
    classify();
    followNerve();
    addNerve();
    setScale();
    makeSurface();
    makeTetrahedra();
    const std::string complaints = m_Log.complaints();
    require(complaints.empty(), "no warning and no error in the host's log, found:\n" + complaints);
  }

private:
  vtkMRMLScene* scene() const { return qSlicerApplication::application()->mrmlScene(); }

  void take(const QString& name) { takePicture(m_Folder + "/tutorial-image-" + name + ".png"); }

  vtkMRMLMarkupsNode* addPoints(const char* name)
  {
    vtkMRMLMarkupsNode* markups = addMarkups(scene(), "vtkMRMLMarkupsFiducialNode", {});
    markups->SetName(name);
    auto* display = vtkMRMLMarkupsDisplayNode::SafeDownCast(markups->GetDisplayNode());
    display->SetPointLabelsVisibility(false);
    display->SetPropertiesLabelVisibility(false);
    return markups;
  }

  void loadImage()
  {
    vtkMRMLScalarVolumeNode* image = loadVolume(scene(), headImageFile());
    image->SetName("T1");
    showInSliceViews(image);
    waitFor(1);
    m_Log.complaints(); // on a busy machine the host draws the image once before its colours are there
    m_Panel = openModule("TissueMapper");
    showLayout(vtkMRMLLayoutNode::SlicerLayoutFourUpView);
    choose(m_Panel, "ImageSelector", image);
    showSlicesAt(m_Sella, HEAD_WIDTH);
    take("1-image");
  }

  void placeTrainingPoints()
  {
    m_Training = addPoints("Training");
    const Markup points = pointsOf("workflow/from-image/training.mrk.json");
    for (std::size_t n = 0; n < points.points.size(); ++n)
    {
      const Point p = toRas(points.points[n]);
      m_Training->SetNthControlPointLabel(m_Training->AddControlPoint(p[0], p[1], p[2]), points.labels[n]);
    }
    choose(m_Panel, "TrainingSelector", m_Training);
    showSlicesAt(toRas(points.points.front()), HEAD_WIDTH);
    take("2-training");
  }

  void lookAtCompartments()
  {
    collapse(m_Panel, "ImagesCollapsibleButton");
    collapse(m_Panel, "TrainingCollapsibleButton");
    expand(m_Panel, "CompartmentsCollapsibleButton");
    m_Training->SetDisplayVisibility(false);
    showSlicesAt(m_Sella, HEAD_WIDTH);
    apply(m_Panel, "CompartmentsRunWidget");
    waitForRun(m_Panel, "CompartmentsRunWidget");
    take("3-compartments");
    collapse(m_Panel, "CompartmentsCollapsibleButton");
  }

  void classify()
  {
    apply(m_Panel);
    waitFor(8);
    take("4-running");
    waitForRun(m_Panel);
    take("5-tissues");
  }

  void followNerve()
  {
    collapse(m_Panel, "OutputsCollapsibleButton");
    expand(m_Panel, "TubeCollapsibleButton");
    findChild<QLineEdit>(m_Panel, "TubeNameLineEdit")->setText("optic nerve");
    emit findChild<QLineEdit>(m_Panel, "TubeNameLineEdit")->editingFinished();
    vtkMRMLMarkupsNode* points = addPoints("Optic nerve");
    const Markup places = pointsOf("TissueMapper/Testing/optic-nerve.mrk.json");
    Point middle{};
    for (const Vec3& place : places.points)
    {
      const Point p = toRas(place);
      for (int axis = 0; axis < 3; ++axis) middle[axis] += p[axis] / double(places.points.size());
      points->AddControlPoint(p[0], p[1], p[2]);
    }
    choose(m_Panel, "TubePointsSelector", points);
    waitFor(2); // it follows by itself
    waitForRun(m_Panel, "TubeRunWidget");
    showSlicesAt(middle, 70);
    scrollTo(findChild<QWidget>(m_Panel, "AddTubeButton"));
    take("6-nerve");
  }

  void addNerve()
  {
    findChild<QPushButton>(m_Panel, "AddTubeButton")->click();
    waitForRun(m_Panel, "TubeRunWidget");
    scrollTo(findChild<QWidget>(m_Panel, "MesherButton"));
    take("7-added");
  }

  /// By the button that goes on to the next panel.
  void setScale()
  {
    findChild<QPushButton>(m_Panel, "ScaleButton")->click();
    waitFor(0.5);
    qSlicerAbstractModuleWidget* panel = openModule("SurgicalPathScale");
    require(chosen(panel, "TissueMapSelector") == chosen(m_Panel, "LabelMapSelector"), "the tissues to be chosen");
    vtkMRMLMarkupsNode* target = addPoints("Sella");
    target->AddControlPoint(m_Sella[0], m_Sella[1], m_Sella[2]);
    choose(panel, "TargetsSelector", target);
    const std::vector<std::pair<const char*, double>> lengths{ { "MinimumEdgeLengthSlider", 1.5 },
                                                               { "MaximumEdgeLengthSlider", 8 },
                                                               { "ChildRadiusSlider", 10 },
                                                               { "DecayLengthSlider", 40 } };
    for (const auto& [slider, length] : lengths) findChild<ctkSliderWidget>(panel, slider)->setValue(length);
    findChild<QCheckBox>(panel, "PreviewCheckBox")->setChecked(true);
    showSlicesAt(m_Sella, HEAD_WIDTH);
    waitFor(3);
    take("8-scale");
    apply(panel);
    waitForRun(panel);
    m_Scale = chosen(panel, "ScaleSelector");
  }

  void makeSurface()
  {
    m_SurfacePanel = openModule("SimplexMesher");
    hideForeground();
    choose(m_SurfacePanel, "TissueMapSelector", chosen(m_Panel, "LabelMapSelector"));
    findChild<QRadioButton>(m_SurfacePanel, "ScaleRadioButton")->setChecked(true);
    choose(m_SurfacePanel, "ScaleSelector", m_Scale);
    findChild<QDoubleSpinBox>(m_SurfacePanel, "MinimumIslandVolumeSpinBox")->setValue(60);
    findChild<ctkSliderWidget>(m_SurfacePanel, "FeatureScaleSlider")->setValue(0.5);
    waitFor(1);
    apply(m_SurfacePanel);
    waitForRun(m_SurfacePanel);
    auto* surface = vtkMRMLModelNode::SafeDownCast(chosen(m_SurfacePanel, "SurfaceSelector"));
    require(surface && surface->GetMesh() && surface->GetMesh()->GetNumberOfCells() > 10000, "a surface");
    showLayout(vtkMRMLLayoutNode::SlicerLayoutOneUp3DView);
    lookAt({ 0, -10, -5 }, { -0.6, -0.75, -0.25 }, 280);
    scrollTo(findChild<QWidget>(m_SurfacePanel, "RunWidget"));
    take("9-surface");
  }

  void makeTetrahedra()
  {
    qSlicerAbstractModuleWidget* panel = openModule("FuchsTetrahedralizer");
    showLayout(vtkMRMLLayoutNode::SlicerLayoutConventionalWidescreenView);
    auto* surfaces = findChild<qMRMLCheckableNodeComboBox>(panel, "SurfaceComboBox");
    surfaces->setCheckState(chosen(m_SurfacePanel, "SurfaceSelector"), Qt::Checked);
    apply(panel);
    waitForRun(panel);
    showOnly(scene(), chosen(panel, "MeshComboBox"));
    showSlicesAt(m_Sella, HEAD_WIDTH);
    lookAt({ 0, -10, -5 }, { -0.6, -0.75, -0.25 }, 280);
    const QString file = QString::fromStdString(newFolder("ImageTutorialExport")) + "/head.inp";
    exportTo(file, panel);
    require(QFileInfo::exists(file), "an exported mesh");
    take("10-export");
  }

  const Point m_Sella = toRas(pointsOf("workflow/from-image/sella.mrk.json").points.front());
  QString m_Folder;
  HostLog m_Log;
  qSlicerAbstractModuleWidget* m_Panel = nullptr;
  qSlicerAbstractModuleWidget* m_SurfacePanel = nullptr;
  vtkMRMLMarkupsNode* m_Training = nullptr;
  vtkMRMLNode* m_Scale = nullptr;
};

} // namespace

int walkImageTutorial(const QString& pictureFolder)
{
  if (headImageFile().empty()) return SKIPPED;
  ImageTutorial(pictureFolder).walk();
  return 0;
}

} // namespace surgicalmesher::test
