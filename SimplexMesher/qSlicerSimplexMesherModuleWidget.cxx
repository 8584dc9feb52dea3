// SPDX-License-Identifier: Apache-2.0
#include "qSlicerSimplexMesherModuleWidget.h"

#include "PanelObstacle.h"
#include "ParameterPanel.h"
#include "ui_qSlicerSimplexMesherModuleWidget.h"
#include "vtkMRMLSimplexMesherNode.h"
#include "vtkSlicerSimplexMesherLogic.h"
#include "vtkSurgicalMesherRun.h"

#include <vtkMRMLDisplayableNode.h>
#include <vtkMRMLLabelMapVolumeNode.h>
#include <vtkMRMLModelNode.h>
#include <vtkMRMLPlotChartNode.h>
#include <vtkMRMLScene.h>
#include <vtkMRMLSegmentationNode.h>
#include <vtkMRMLTableNode.h>
#include <vtkSegmentation.h>
#include <vtkSlicerPlotsLogic.h>

#include <QSignalBlocker>
#include <QTableView>
#include <QTimer>

#include <vtkPolyData.h>
#include <vtkWeakPointer.h>

using surgicalmesher::PanelObstacle;
using Node = vtkMRMLSimplexMesherNode;
using Problem = vtkSlicerSimplexMesherLogic::Problem;

class qSlicerSimplexMesherModuleWidgetPrivate : public Ui_qSlicerSimplexMesherModuleWidget,
                                                public surgicalmesher::ParameterPanel<Node>
{
  Q_DECLARE_PUBLIC(qSlicerSimplexMesherModuleWidget)
  qSlicerSimplexMesherModuleWidget* const q_ptr;

public:
  explicit qSlicerSimplexMesherModuleWidgetPrivate(qSlicerSimplexMesherModuleWidget& object) : q_ptr(&object) {}

  vtkSlicerSimplexMesherLogic* logic() const { return vtkSlicerSimplexMesherLogic::SafeDownCast(q_ptr->logic()); }

  vtkWeakPointer<vtkMRMLNode> TissueMap; ///< the node whose tissues are listed
  vtkWeakPointer<vtkMRMLNode> Scale;     ///< observed
  QTimer ListTimer;

  void setParameterNode(vtkMRMLSimplexMesherNode* node);
  void observeTissueMap(vtkMRMLNode* node);
  void observeScale(vtkMRMLNode* node);
  void bindControls();
  void showReports();
  void showObstacle();

  PanelObstacle obstacle(const vtkSlicerSimplexMesherLogic::Check& check);
  PanelObstacle scaleObstacle(Problem problem);
  PanelObstacle tissueObstacle(const vtkSlicerSimplexMesherLogic::Check& check);
  PanelObstacle proximityObstacle();
};

void qSlicerSimplexMesherModuleWidgetPrivate::setParameterNode(vtkMRMLSimplexMesherNode* node)
{
  Q_Q(qSlicerSimplexMesherModuleWidget);
  q->qvtkReconnect(this->Parameters, node, vtkCommand::ModifiedEvent, q, SLOT(updateFromNode()));
  this->Parameters = node;
  this->TissueTable->setParameterNode(node);
  this->BalloonSection->setParameterNode(node);
  q->updateFromNode();
}

void qSlicerSimplexMesherModuleWidgetPrivate::observeTissueMap(vtkMRMLNode* node)
{
  Q_Q(qSlicerSimplexMesherModuleWidget);
  for (const unsigned long event :
       { (unsigned long)vtkCommand::ModifiedEvent, (unsigned long)vtkMRMLDisplayableNode::DisplayModifiedEvent,
         (unsigned long)vtkMRMLTransformableNode::TransformModifiedEvent,
         (unsigned long)vtkMRMLVolumeNode::ImageDataModifiedEvent,
         (unsigned long)vtkSegmentation::RepresentationModified, (unsigned long)vtkSegmentation::SegmentAdded,
         (unsigned long)vtkSegmentation::SegmentRemoved, (unsigned long)vtkSegmentation::SegmentModified,
         (unsigned long)vtkSegmentation::SegmentsOrderModified })
  {
    q->qvtkReconnect(this->TissueMap, node, event, q, SLOT(onTissueMapChanged()));
  }
  this->TissueMap = node;
  this->ListTimer.stop();
  q->listTissues();
}

void qSlicerSimplexMesherModuleWidgetPrivate::observeScale(vtkMRMLNode* node)
{
  Q_Q(qSlicerSimplexMesherModuleWidget);
  for (const unsigned long event :
       { (unsigned long)vtkCommand::ModifiedEvent, (unsigned long)vtkMRMLTransformableNode::TransformModifiedEvent,
         (unsigned long)vtkMRMLVolumeNode::ImageDataModifiedEvent })
  {
    q->qvtkReconnect(this->Scale, node, event, q, SLOT(onObstacleChanged()));
  }
  this->Scale = node;
}

void qSlicerSimplexMesherModuleWidgetPrivate::bindControls()
{
  this->bind(this->TissueMapSelector, Node::TissueMapRole());
  this->bind(this->ScaleSelector, Node::ScaleRole());
  this->bind(this->SurfaceSelector, Node::SurfaceRole());
  this->bind(this->PreparedLabelMapSelector, Node::PreparedLabelMapRole());
  this->bind(this->SimplexMeshSelector, Node::SimplexMeshRole());
  this->bind(this->FollowedScaleSelector, Node::FollowedScaleRole());
  this->bind(this->ScaleRadioButton, &Node::GetUseScale, &Node::SetUseScale);
  this->bind(this->EdgeLengthSlider, &Node::GetEdgeLength, &Node::SetEdgeLength);
  this->bind(this->TissueModelsCheckBox, &Node::GetTissueModels, &Node::SetTissueModels);
  this->bind(this->KeepAmbientCheckBox, &Node::GetKeepAmbient, &Node::SetKeepAmbient);
  this->bind(this->ReportCheckBox, &Node::GetReport, &Node::SetReport);
  this->bind(this->MinimumIslandVolumeSpinBox, &Node::GetMinimumIslandVolume, &Node::SetMinimumIslandVolume);
  this->bind(this->MinimumCavityVolumeSpinBox, &Node::GetMinimumCavityVolume, &Node::SetMinimumCavityVolume);
  this->bind(this->FeatureScaleSlider, &Node::GetFeatureScale, &Node::SetFeatureScale);
  this->bind(this->SmoothingSlider, &Node::GetSmoothing, &Node::SetSmoothing);
  this->bind(this->RigiditySlider, &Node::GetRigidity, &Node::SetRigidity);
  this->bind(this->ContinuityComboBox, &Node::GetContinuity, &Node::SetContinuity);
  this->bind(this->ProximityNearSpinBox, &Node::GetProximityNear, &Node::SetProximityNear);
  this->bind(this->ProximityFarSpinBox, &Node::GetProximityFar, &Node::SetProximityFar);
  this->bind(this->ChordErrorSpinBox, &Node::GetChordError, &Node::SetChordError);
  this->bind(this->BackgroundSpinBox, &Node::GetBackground, &Node::SetBackground);
  this->bind(this->MaximumDistanceSpinBox, &Node::GetMaximumDistance, &Node::SetMaximumDistance);
  this->bind(this->GradationSlider, &Node::GetGradation, &Node::SetGradation);
  this->bind(this->FollowThicknessCheckBox, &Node::GetFollowThickness, &Node::SetFollowThickness);
  this->bind(this->ThreadsSpinBox, &Node::GetThreads, &Node::SetThreads);
  this->onShow(
    [this]
    {
      const bool useScale = this->Parameters->GetUseScale();
      this->EdgeLengthRadioButton->setChecked(!useScale);
      this->ScaleSelector->setEnabled(useScale);
      this->EdgeLengthSlider->setEnabled(!useScale);
    });
}

/// Shows the available tables and plots.
void qSlicerSimplexMesherModuleWidgetPrivate::showReports()
{
  Q_Q(qSlicerSimplexMesherModuleWidget);
  const QString plot = this->PlotComboBox->currentText();
  const QSignalBlocker blocker(this->PlotComboBox);
  this->PlotComboBox->clear();
  for (int i = 0; i < this->Parameters->GetNumberOfNodeReferences(Node::EvolutionChartRole()); ++i)
  {
    auto* chart =
      vtkMRMLPlotChartNode::SafeDownCast(this->Parameters->GetNthNodeReference(Node::EvolutionChartRole(), i));
    if (chart) this->PlotComboBox->addItem(QString::fromUtf8(chart->GetTitle()), QString(chart->GetID()));
  }
  this->PlotComboBox->setCurrentIndex(qMax(0, this->PlotComboBox->findText(plot)));
  this->PlotComboBox->setEnabled(this->PlotComboBox->count() > 0);
  this->ShowPlotButton->setEnabled(this->PlotComboBox->count() > 0);
  q->showReport();
}

void qSlicerSimplexMesherModuleWidgetPrivate::showObstacle()
{
  const PanelObstacle busy{
    qSlicerSimplexMesherModuleWidget::tr("One run at a time: wait for the other, or cancel it."), {}, {}
  };
  const PanelObstacle inputs = this->obstacle(this->logic()->FindProblem(this->Parameters, {}));
  this->BalloonSection->setInputObstacle(this->logic()->GetRun()->IsBusy() ? busy : inputs);
  const PanelObstacle found =
    this->logic()->GetBalloons().run()->IsBusy()
      ? busy
      : this->obstacle(this->logic()->FindProblem(this->Parameters, this->TissueTable->tissues()));
  if (found.sentence.isEmpty()) this->RunWidget->clearProblem();
  else this->RunWidget->setProblem(found.sentence, found.fixText, found.fix);
}

PanelObstacle qSlicerSimplexMesherModuleWidgetPrivate::obstacle(const vtkSlicerSimplexMesherLogic::Check& check)
{
  switch (check.problem)
  {
  case Problem::None: return {};
  case Problem::NoModule:
    return { qSlicerSimplexMesherModuleWidget::tr(
               "The command-line module SimplexMesherCLI isn't loaded; see the application's log."),
             {},
             {} };
  case Problem::TissueMap:
    return surgicalmesher::tissueMapObstacle(check.tissueMap, this->Parameters->GetNodeReference(Node::TissueMapRole()),
                                             this->TissueMapSelector);
  case Problem::ProximityUnfit: return this->proximityObstacle();
  case Problem::LabelTaken:
  case Problem::NothingToMesh:
  case Problem::LengthsContradict:
  case Problem::LengthsOfShellDiffer: return this->tissueObstacle(check);
  default: return this->scaleObstacle(check.problem);
  }
}

PanelObstacle qSlicerSimplexMesherModuleWidgetPrivate::scaleObstacle(Problem problem)
{
  switch (problem)
  {
  case Problem::NoScale:
    return { qSlicerSimplexMesherModuleWidget::tr("Choose a scale volume, or one edge length for all."),
             qSlicerSimplexMesherModuleWidget::tr("One edge length"), [this] { this->Parameters->UseScaleOff(); } };
  case Problem::ScaleWarped:
    return { qSlicerSimplexMesherModuleWidget::tr(
               "The scale volume is under a transform that isn't linear; harden or remove it."),
             qSlicerSimplexMesherModuleWidget::tr("Transforms"), [] { surgicalmesher::openModule("Transforms"); } };
  case Problem::ScaleTooSmall:
    return { qSlicerSimplexMesherModuleWidget::tr(
               "The scale volume doesn't cover the whole label map; make one for this map."),
             qSlicerSimplexMesherModuleWidget::tr("Surgical Path Scale"),
             [] { surgicalmesher::openModule("SurgicalPathScale"); } };
  default:
    return { qSlicerSimplexMesherModuleWidget::tr("The edge length has to be above 0."),
             qSlicerSimplexMesherModuleWidget::tr("2 mm"), [this] { this->Parameters->SetEdgeLength(2); } };
  }
}

PanelObstacle qSlicerSimplexMesherModuleWidgetPrivate::proximityObstacle()
{
  const auto makeEqual = [this]
  {
    const double larger = qMax(this->Parameters->GetProximityNear(), this->Parameters->GetProximityFar());
    this->Parameters->SetProximityNear(larger);
    this->Parameters->SetProximityFar(larger);
  };
  return { qSlicerSimplexMesherModuleWidget::tr(
             "The proximity where edges are shortest has to be above 0, and not above that where they are longest."),
           qSlicerSimplexMesherModuleWidget::tr("Make them equal"), makeEqual };
}

PanelObstacle qSlicerSimplexMesherModuleWidgetPrivate::tissueObstacle(const vtkSlicerSimplexMesherLogic::Check& check)
{
  if (check.problem == Problem::NothingToMesh)
    return { qSlicerSimplexMesherModuleWidget::tr("All tissues are left out."),
             qSlicerSimplexMesherModuleWidget::tr("Mesh all"), [this] { this->Parameters->SetTissueSettings({}); } };
  const auto dropMaximum = [this, id = check.tissue.id]
  {
    surgicalmesher::TissueSetting setting = this->Parameters->GetTissueSetting(id);
    setting.maximumEdgeLength = 0;
    this->Parameters->SetTissueSetting(id, setting);
  };
  const QString tissue = QString::fromStdString(check.tissue.name);
  if (check.problem == Problem::LabelTaken)
    return { qSlicerSimplexMesherModuleWidget::tr("%1 has the label that the surroundings are to have.").arg(tissue),
             qSlicerSimplexMesherModuleWidget::tr("Leave the surroundings out"),
             [this] { this->Parameters->SetBackground(0); } };
  const QString sentence =
    check.problem == Problem::LengthsContradict
      ? qSlicerSimplexMesherModuleWidget::tr("The minimum edge length of %1 is above its maximum.").arg(tissue)
      : qSlicerSimplexMesherModuleWidget::tr("%1 is a shell, which has one edge length, not two.").arg(tissue);
  return { sentence, qSlicerSimplexMesherModuleWidget::tr("Drop the maximum"), dropMaximum };
}

qSlicerSimplexMesherModuleWidget::qSlicerSimplexMesherModuleWidget(QWidget* parent)
  : Superclass(parent), d_ptr(new qSlicerSimplexMesherModuleWidgetPrivate(*this))
{
}

qSlicerSimplexMesherModuleWidget::~qSlicerSimplexMesherModuleWidget() = default;

void qSlicerSimplexMesherModuleWidget::setup()
{
  Q_D(qSlicerSimplexMesherModuleWidget);
  d->setupUi(this);
  this->Superclass::setup();
  d->ReportTableComboBox->addItem(tr("Tissues"), QByteArray(Node::TissueTableRole()));
  d->ReportTableComboBox->addItem(tr("Evolution, step by step"), QByteArray(Node::EvolutionTableRole()));
  d->ReportTableComboBox->addItem(tr("Roughness, folds and ears"), QByteArray(Node::ShapeTableRole()));
  d->ReportTableComboBox->addItem(tr("The longest folds"), QByteArray(Node::FoldTableRole()));
  d->ReportTableComboBox->addItem(tr("The largest ears"), QByteArray(Node::EarTableRole()));
  d->ListTimer.setSingleShot(true);
  d->ListTimer.setInterval(300);
  connect(&d->ListTimer, SIGNAL(timeout()), this, SLOT(listTissues()));
  d->bindControls();
  connect(d->RunWidget, SIGNAL(applyRequested()), this, SLOT(apply()));
  connect(d->RunWidget, SIGNAL(runEnded()), this, SLOT(onRunEnded()));
  connect(d->ReportTableComboBox, SIGNAL(currentIndexChanged(int)), this, SLOT(showReport()));
  connect(d->ShowPlotButton, SIGNAL(clicked()), this, SLOT(showPlot()));
  d->RunWidget->setRun(d->logic()->GetRun());
  d->BalloonSection->setLogic(d->logic());
  connect(d->BalloonSection, SIGNAL(runStarted()), this, SLOT(onObstacleChanged()));
  connect(d->BalloonSection, SIGNAL(runEnded()), this, SLOT(onObstacleChanged()));
}

void qSlicerSimplexMesherModuleWidget::enter()
{
  Q_D(qSlicerSimplexMesherModuleWidget);
  this->Superclass::enter();
  d->setParameterNode(d->logic()->ParameterNode());
  this->listTissues();
}

bool qSlicerSimplexMesherModuleWidget::setEditedNode(vtkMRMLNode* node, QString role, QString context)
{
  Q_D(qSlicerSimplexMesherModuleWidget);
  if (auto* parameters = vtkMRMLSimplexMesherNode::SafeDownCast(node))
  {
    d->setParameterNode(parameters);
    return true;
  }
  if (!d->Parameters) d->setParameterNode(d->logic()->ParameterNode());
  if (!d->Parameters) return false;
  if (vtkMRMLSegmentationNode::SafeDownCast(node) || vtkMRMLLabelMapVolumeNode::SafeDownCast(node))
  {
    d->Parameters->SetNode(Node::TissueMapRole(), node);
    return true;
  }
  return this->Superclass::setEditedNode(node, role, context);
}

void qSlicerSimplexMesherModuleWidget::setMRMLScene(vtkMRMLScene* scene)
{
  for (const unsigned long event : { vtkMRMLScene::EndImportEvent, vtkMRMLScene::EndBatchProcessEvent,
                                     vtkMRMLScene::EndCloseEvent, vtkMRMLScene::EndRestoreEvent })
  {
    this->qvtkReconnect(this->mrmlScene(), scene, event, this, SLOT(onSceneReplaced()));
  }
  for (const unsigned long event : { vtkMRMLScene::NodeAddedEvent, vtkMRMLScene::NodeRemovedEvent })
  {
    this->qvtkReconnect(this->mrmlScene(), scene, event, this, SLOT(onSceneChanged()));
  }
  this->Superclass::setMRMLScene(scene);
  this->onSceneReplaced();
}

void qSlicerSimplexMesherModuleWidget::onSceneReplaced()
{
  Q_D(qSlicerSimplexMesherModuleWidget);
  vtkMRMLScene* scene = this->mrmlScene();
  if (scene && scene->IsBatchProcessing()) return;
  vtkMRMLNode* node = scene ? scene->GetFirstNodeByClass("vtkMRMLSimplexMesherNode") : nullptr;
  if (!node && scene && this->isEntered()) node = d->logic()->ParameterNode();
  d->setParameterNode(vtkMRMLSimplexMesherNode::SafeDownCast(node));
}

void qSlicerSimplexMesherModuleWidget::onSceneChanged()
{
  Q_D(qSlicerSimplexMesherModuleWidget);
  if (d->Parameters && !d->Parameters->GetScene()) this->onSceneReplaced();
  if (d->Parameters && !d->Parameters->GetNodeReference(Node::TissueMapRole()))
    d->ListTimer.start(); // a map may be available now
}

void qSlicerSimplexMesherModuleWidget::updateFromNode()
{
  Q_D(qSlicerSimplexMesherModuleWidget);
  this->setEnabled(d->Parameters != nullptr);
  if (!d->Parameters)
  {
    d->TissueTable->setTissues({});
    d->BalloonSection->setTissues({});
    return;
  }
  d->show();
  d->showReports();
  if (d->Scale != d->Parameters->GetScalarVolumeNode(Node::ScaleRole()))
    d->observeScale(d->Parameters->GetScalarVolumeNode(Node::ScaleRole()));
  vtkMRMLNode* map = d->Parameters->GetNodeReference(Node::TissueMapRole());
  if (map != d->TissueMap) d->observeTissueMap(map);
  else if (!map) this->listTissues(); // the map may have been deleted
  else d->showObstacle();
}

void qSlicerSimplexMesherModuleWidget::onTissueMapChanged()
{
  Q_D(qSlicerSimplexMesherModuleWidget);
  d->ListTimer.start();
}

void qSlicerSimplexMesherModuleWidget::onObstacleChanged()
{
  Q_D(qSlicerSimplexMesherModuleWidget);
  if (d->Parameters) d->showObstacle();
}

void qSlicerSimplexMesherModuleWidget::listTissues()
{
  Q_D(qSlicerSimplexMesherModuleWidget);
  if (!d->Parameters || !this->isEntered()) return; // enter() lists the tissues
  d->TissueTable->setTissues(surgicalmesher::listTissues(d->TissueMap));
  d->BalloonSection->setTissues(d->TissueTable->tissues());
  d->showObstacle();
}

void qSlicerSimplexMesherModuleWidget::apply()
{
  Q_D(qSlicerSimplexMesherModuleWidget);
  if (!d->Parameters) return;
  d->ListTimer.stop();
  this->listTissues(); // includes the latest edits
  if (d->RunWidget->problem().isEmpty() && d->logic()->Start(d->Parameters)) d->showObstacle();
}

void qSlicerSimplexMesherModuleWidget::onRunEnded()
{
  Q_D(qSlicerSimplexMesherModuleWidget);
  this->onObstacleChanged();
  vtkSurgicalMesherRun* run = d->logic()->GetRun();
  vtkMRMLModelNode* surface = d->Parameters ? d->Parameters->GetModelNode(Node::SurfaceRole()) : nullptr;
  if (run->GetStatus() != vtkSurgicalMesherRun::Completed || !surface || !surface->GetPolyData()) return;
  d->RunWidget->setResult(tr("%L1 triangles between %L2 points, in %3 s.")
                            .arg(qlonglong(surface->GetPolyData()->GetNumberOfCells()))
                            .arg(qlonglong(surface->GetPolyData()->GetNumberOfPoints()))
                            .arg(run->GetElapsedSeconds(), 0, 'f', 1));
}

void qSlicerSimplexMesherModuleWidget::showReport()
{
  Q_D(qSlicerSimplexMesherModuleWidget);
  const QByteArray role = d->ReportTableComboBox->currentData().toByteArray();
  vtkMRMLNode* table = d->Parameters ? d->Parameters->GetNodeReference(role.constData()) : nullptr;
  if (table != d->ReportTableView->mrmlTableNode()) d->ReportTableView->setMRMLTableNode(table);
}

void qSlicerSimplexMesherModuleWidget::showPlot()
{
  Q_D(qSlicerSimplexMesherModuleWidget);
  const QByteArray id = d->PlotComboBox->currentData().toString().toUtf8();
  auto* chart = vtkMRMLPlotChartNode::SafeDownCast(this->mrmlScene()->GetNodeByID(id.constData()));
  auto* plots = vtkSlicerPlotsLogic::SafeDownCast(d->logic()->GetModuleLogic("Plots"));
  if (chart && plots) plots->ShowChartInLayout(chart);
}
