// SPDX-License-Identifier: Apache-2.0
#include "qSlicerSurgicalPathScaleModuleWidget.h"

#include "PanelObstacle.h"
#include "ParameterPanel.h"
#include "ScaleProfile.h"
#include "ui_qSlicerSurgicalPathScaleModuleWidget.h"
#include "vtkMRMLSurgicalPathScaleNode.h"
#include "vtkSlicerSurgicalPathScaleLogic.h"
#include "vtkSurgicalMesherRun.h"

#include <vtkMRMLLabelMapVolumeNode.h>
#include <vtkMRMLMarkupsCurveNode.h>
#include <vtkMRMLMarkupsFiducialNode.h>
#include <vtkMRMLMarkupsLineNode.h>
#include <vtkMRMLPlotChartNode.h>
#include <vtkMRMLScalarVolumeNode.h>
#include <vtkMRMLScene.h>
#include <vtkMRMLSegmentationNode.h>
#include <vtkSlicerPlotsLogic.h>

#include <vtkImageData.h>

#include <QElapsedTimer>
#include <QLocale>
#include <QTimer>
#include <QToolButton>

#include <cmath>

using surgicalmesher::PanelObstacle;
using Node = vtkMRMLSurgicalPathScaleNode;
using Logic = vtkSlicerSurgicalPathScaleLogic;
using Problem = Logic::Problem;

class qSlicerSurgicalPathScaleModuleWidgetPrivate : public Ui_qSlicerSurgicalPathScaleModuleWidget,
                                                    public surgicalmesher::ParameterPanel<Node>
{
  Q_DECLARE_PUBLIC(qSlicerSurgicalPathScaleModuleWidget)
  qSlicerSurgicalPathScaleModuleWidget* const q_ptr;

public:
  explicit qSlicerSurgicalPathScaleModuleWidgetPrivate(qSlicerSurgicalPathScaleModuleWidget& object) : q_ptr(&object) {}

  Logic* logic() const { return Logic::SafeDownCast(q_ptr->logic()); }

  QTimer PreviewTimer;  ///< limits the preview to one per pause while a slider is dragged
  QTimer EstimateTimer; ///< the estimate takes longer and waits until the sliders rest

  void setParameterNode(vtkMRMLSurgicalPathScaleNode* node);
  void setupPlacing(qSlicerMarkupsPlaceWidget* place, qMRMLNodeComboBox* selector);
  void bindControls();
  void scheduleUpdates();
  void showObstacle(const Logic::Check& check);
  void placePoints(qMRMLNodeComboBox* selector, qSlicerMarkupsPlaceWidget* place);

  PanelObstacle obstacle(const Logic::Check& check);
  PanelObstacle focusObstacle(const Logic::Check& check);
  PanelObstacle valueObstacle(const Logic::Check& check);
};

namespace
{

/// Returns the count rounded to three significant digits.
QString roundedCount(double count)
{
  const double unit = count < 1000 ? 1 : std::pow(10.0, std::floor(std::log10(count)) - 2);
  return QLocale().toString(qlonglong(std::llround(count / unit) * std::llround(unit)));
}

QString sizeSentence(const Logic::Estimate& estimate)
{
  return qSlicerSurgicalPathScaleModuleWidget::tr("about %1 triangles, %2 tetrahedra")
    .arg(roundedCount(estimate.triangles), roundedCount(estimate.tetrahedra));
}

} // namespace

void qSlicerSurgicalPathScaleModuleWidgetPrivate::setParameterNode(vtkMRMLSurgicalPathScaleNode* node)
{
  Q_Q(qSlicerSurgicalPathScaleModuleWidget);
  q->qvtkReconnect(this->Parameters, node, vtkCommand::ModifiedEvent, q, SLOT(updateFromNode()));
  q->qvtkReconnect(this->Parameters, node, Node::InputModifiedEvent, q, SLOT(onInputChanged()));
  this->Parameters = node;
  q->updateFromNode();
}

/// Shows only the controls for placing points; colours and the like are edited in Markups.
void qSlicerSurgicalPathScaleModuleWidgetPrivate::setupPlacing(qSlicerMarkupsPlaceWidget* place,
                                                               qMRMLNodeComboBox* selector)
{
  place->setButtonsVisible(false);
  place->placeButton()->setVisible(true);
  place->deleteButton()->setVisible(true);
  place->setPlaceMultipleMarkups(qSlicerMarkupsPlaceWidget::ForcePlaceMultipleMarkups);
  QObject::connect(selector, SIGNAL(currentNodeChanged(vtkMRMLNode*)), place, SLOT(setCurrentNode(vtkMRMLNode*)));
}

void qSlicerSurgicalPathScaleModuleWidgetPrivate::bindControls()
{
  this->bind(this->TissueMapSelector, Node::TissueMapRole());
  this->bind(this->TargetsSelector, Node::TargetsRole());
  this->bind(this->PathSelector, Node::PathRole());
  this->bind(this->FurtherMarkupsSelector, Node::FurtherMarkupsRole());
  this->bind(this->ScaleSelector, Node::ScaleRole());
  this->bind(this->OutputLabelMapSelector, Node::OutputLabelMapRole());
  this->bind(this->MinimumEdgeLengthSlider, &Node::GetMinimumEdgeLength, &Node::SetMinimumEdgeLength);
  this->bind(this->MaximumEdgeLengthSlider, &Node::GetMaximumEdgeLength, &Node::SetMaximumEdgeLength);
  this->bind(this->ChildRadiusSlider, &Node::GetChildRadius, &Node::SetChildRadius);
  this->bind(this->DecayLengthSlider, &Node::GetDecayLength, &Node::SetDecayLength);
  this->bind(this->NullDisplacementRadiusSpinBox, &Node::GetNullDisplacementRadius, &Node::SetNullDisplacementRadius);
  this->bind(this->NullDisplacementPathDistanceSpinBox, &Node::GetNullDisplacementPathDistance,
             &Node::SetNullDisplacementPathDistance);
  this->bind(this->NullDisplacementPathDistanceAtTargetSpinBox, &Node::GetNullDisplacementPathDistanceAtTarget,
             &Node::SetNullDisplacementPathDistanceAtTarget);
  this->bind(this->NullDisplacementTissuesLineEdit, &QLineEdit::editingFinished, &Node::GetNullDisplacementTissues,
             &Node::SetNullDisplacementTissues);
  this->bindData(this->CombineComboBox, &Node::GetCombine, &Node::SetCombine);
  this->bind(this->PathChildRadiusSpinBox, &Node::GetPathChildRadius, &Node::SetPathChildRadius);
  this->bind(this->PathDecayLengthSpinBox, &Node::GetPathDecayLength, &Node::SetPathDecayLength);
  this->bind(this->GradationSpinBox, &Node::GetGradation, &Node::SetGradation);
  this->bind(this->SpacingSpinBox, &Node::GetSpacing, &Node::SetSpacing);
  this->bind(this->TissueLengthsPathLineEdit, &Node::GetTissueLengths, &Node::SetTissueLengths);
  this->onShow(
    [this]
    {
      this->OutputLabelMapSelector->setEnabled(this->Parameters->WantsNullDisplacement());
      this->ProfileCheckBox->setChecked(this->Parameters->GetPlotChartNode(Node::ProfileChartRole()) != nullptr);
    });
}

void qSlicerSurgicalPathScaleModuleWidgetPrivate::scheduleUpdates()
{
  if (this->PreviewCheckBox->isChecked()) this->PreviewTimer.start();
  this->EstimateTimer.start();
}

void qSlicerSurgicalPathScaleModuleWidgetPrivate::showObstacle(const Logic::Check& check)
{
  const PanelObstacle found = this->obstacle(check);
  if (found.sentence.isEmpty()) this->RunWidget->clearProblem();
  else this->RunWidget->setProblem(found.sentence, found.fixText, found.fix);
}

PanelObstacle qSlicerSurgicalPathScaleModuleWidgetPrivate::obstacle(const Logic::Check& check)
{
  switch (check.problem)
  {
  case Problem::None: return {};
  case Problem::NoModule:
    return { qSlicerSurgicalPathScaleModuleWidget::tr(
               "The command-line module SurgicalPathScaleCLI isn't loaded; see the application's log."),
             {},
             {} };
  case Problem::TissueMap:
    return surgicalmesher::tissueMapObstacle(check.tissueMap, this->Parameters->GetNodeReference(Node::TissueMapRole()),
                                             this->TissueMapSelector);
  case Problem::NoFocus:
  case Problem::PathOfOnePoint:
  case Problem::NoTarget:
  case Problem::NoPath: return this->focusObstacle(check);
  case Problem::Refused:
    return { qSlicerSurgicalPathScaleModuleWidget::tr("The parameters can't be used: %1.")
               .arg(QString::fromStdString(check.name)),
             {},
             {} };
  default: return this->valueObstacle(check);
  }
}

PanelObstacle qSlicerSurgicalPathScaleModuleWidgetPrivate::focusObstacle(const Logic::Check& check)
{
  const auto placeTargets = [this] { this->placePoints(this->TargetsSelector, this->TargetsPlaceWidget); };
  const auto placePath = [this] { this->placePoints(this->PathSelector, this->PathPlaceWidget); };
  const auto countBoth = [this] { this->Parameters->SetCombine("smaller"); };
  switch (check.problem)
  {
  case Problem::PathOfOnePoint:
    return { qSlicerSurgicalPathScaleModuleWidget::tr("%1 has one point; a path needs two or more.")
               .arg(QString::fromStdString(check.name)),
             qSlicerSurgicalPathScaleModuleWidget::tr("Place points"), placePath };
  case Problem::NoTarget:
    return { qSlicerSurgicalPathScaleModuleWidget::tr("Only targets are to count, and no target is placed."),
             qSlicerSurgicalPathScaleModuleWidget::tr("Count both"), countBoth };
  case Problem::NoPath:
    return { qSlicerSurgicalPathScaleModuleWidget::tr("Only paths are to count, and there is no path."),
             qSlicerSurgicalPathScaleModuleWidget::tr("Count both"), countBoth };
  default:
    return { qSlicerSurgicalPathScaleModuleWidget::tr("Place a target or a path that the mesh has to be fine around."),
             qSlicerSurgicalPathScaleModuleWidget::tr("Place targets"), placeTargets };
  }
}

PanelObstacle qSlicerSurgicalPathScaleModuleWidgetPrivate::valueObstacle(const Logic::Check& check)
{
  switch (check.problem)
  {
  case Problem::LengthsContradict:
    return { qSlicerSurgicalPathScaleModuleWidget::tr("The minimum edge length is above the maximum."),
             qSlicerSurgicalPathScaleModuleWidget::tr("Exchange them"),
             [this]
             {
               MRMLNodeModifyBlocker blocker(this->Parameters);
               const double minimum = this->Parameters->GetMinimumEdgeLength();
               this->Parameters->SetMinimumEdgeLength(this->Parameters->GetMaximumEdgeLength());
               this->Parameters->SetMaximumEdgeLength(minimum);
             } };
  case Problem::NoTissueLengths:
    return { qSlicerSurgicalPathScaleModuleWidget::tr("There is no file %1 with lengths by tissue.")
               .arg(QString::fromStdString(check.name)),
             qSlicerSurgicalPathScaleModuleWidget::tr("Do without"),
             [this] { this->Parameters->SetTissueLengths(std::string()); } };
  case Problem::NullDisplacementTarget:
    return { qSlicerSurgicalPathScaleModuleWidget::tr(
               "Null displacement is to begin at a distance from targets, and there is no target."),
             qSlicerSurgicalPathScaleModuleWidget::tr("Do without"),
             [this] { this->Parameters->SetNullDisplacementRadius(0); } };
  default:
    return { qSlicerSurgicalPathScaleModuleWidget::tr(
               "Null displacement is to begin at a distance from paths, and there is no path."),
             qSlicerSurgicalPathScaleModuleWidget::tr("Do without"),
             [this] { this->Parameters->SetNullDisplacementPathDistance(0); } };
  }
}

void qSlicerSurgicalPathScaleModuleWidgetPrivate::placePoints(qMRMLNodeComboBox* selector,
                                                              qSlicerMarkupsPlaceWidget* place)
{
  if (!selector->currentNode()) selector->addNode();
  place->setCurrentNode(selector->currentNode());
  place->setPlaceModeEnabled(true);
}

//-----------------------------------------------------------------------------
qSlicerSurgicalPathScaleModuleWidget::qSlicerSurgicalPathScaleModuleWidget(QWidget* parent)
  : Superclass(parent), d_ptr(new qSlicerSurgicalPathScaleModuleWidgetPrivate(*this))
{
}

qSlicerSurgicalPathScaleModuleWidget::~qSlicerSurgicalPathScaleModuleWidget() = default;

void qSlicerSurgicalPathScaleModuleWidget::setup()
{
  Q_D(qSlicerSurgicalPathScaleModuleWidget);
  d->setupUi(this);
  this->Superclass::setup();
  d->CombineComboBox->addItem(tr("the shorter length counts"), "smaller");
  d->CombineComboBox->addItem(tr("only targets count"), "targets");
  d->CombineComboBox->addItem(tr("only paths count"), "path");
  d->setupPlacing(d->TargetsPlaceWidget, d->TargetsSelector);
  d->setupPlacing(d->PathPlaceWidget, d->PathSelector);
  d->PreviewTimer.setSingleShot(true);
  d->PreviewTimer.setInterval(100);
  d->EstimateTimer.setSingleShot(true);
  d->EstimateTimer.setInterval(500);
  connect(&d->PreviewTimer, SIGNAL(timeout()), this, SLOT(updatePreview()));
  connect(&d->EstimateTimer, SIGNAL(timeout()), this, SLOT(updateEstimate()));
  d->bindControls();
  // The problem shown depends on the available nodes, which are known only after the scene has changed.
  connect(d->TissueMapSelector, SIGNAL(nodeAdded(vtkMRMLNode*)), this, SLOT(onInputChanged()), Qt::QueuedConnection);
  connect(d->TissueMapSelector, SIGNAL(nodeAboutToBeRemoved(vtkMRMLNode*)), this, SLOT(onInputChanged()),
          Qt::QueuedConnection);
  connect(d->PreviewCheckBox, SIGNAL(toggled(bool)), this, SLOT(updatePreview()));
  connect(d->ProfileCheckBox, SIGNAL(toggled(bool)), this, SLOT(showProfile(bool)));
  connect(d->RunWidget, SIGNAL(applyRequested()), this, SLOT(apply()));
  connect(d->RunWidget, SIGNAL(runEnded()), this, SLOT(onRunEnded()));
  d->RunWidget->setRun(d->logic()->GetRun());
}

void qSlicerSurgicalPathScaleModuleWidget::enter()
{
  Q_D(qSlicerSurgicalPathScaleModuleWidget);
  this->Superclass::enter();
  d->setParameterNode(d->logic()->ParameterNode());
}

void qSlicerSurgicalPathScaleModuleWidget::exit()
{
  Q_D(qSlicerSurgicalPathScaleModuleWidget);
  d->EstimateTimer.stop();
  d->logic()->ReleaseTissueMap();
  d->TargetsPlaceWidget->setPlaceModeEnabled(false);
  d->PathPlaceWidget->setPlaceModeEnabled(false);
  this->Superclass::exit();
  this->updatePreview(); // hides it, unless a run is just starting
}

bool qSlicerSurgicalPathScaleModuleWidget::setEditedNode(vtkMRMLNode* node, QString role, QString context)
{
  Q_D(qSlicerSurgicalPathScaleModuleWidget);
  if (auto* parameters = vtkMRMLSurgicalPathScaleNode::SafeDownCast(node))
  {
    d->setParameterNode(parameters);
    return true;
  }
  if (!d->Parameters) d->setParameterNode(d->logic()->ParameterNode());
  if (!d->Parameters) return false;
  const char* target = nullptr;
  if (vtkMRMLSegmentationNode::SafeDownCast(node) || vtkMRMLLabelMapVolumeNode::SafeDownCast(node))
    target = Node::TissueMapRole();
  else if (vtkMRMLMarkupsFiducialNode::SafeDownCast(node)) target = Node::TargetsRole();
  else if (vtkMRMLMarkupsCurveNode::SafeDownCast(node) || vtkMRMLMarkupsLineNode::SafeDownCast(node))
    target = Node::PathRole();
  if (!target) return this->Superclass::setEditedNode(node, role, context);
  d->Parameters->SetNode(target, node);
  return true;
}

void qSlicerSurgicalPathScaleModuleWidget::setMRMLScene(vtkMRMLScene* scene)
{
  for (const unsigned long event : { vtkMRMLScene::EndImportEvent, vtkMRMLScene::EndBatchProcessEvent,
                                     vtkMRMLScene::EndCloseEvent, vtkMRMLScene::EndRestoreEvent })
  {
    this->qvtkReconnect(this->mrmlScene(), scene, event, this, SLOT(onSceneReplaced()));
  }
  this->Superclass::setMRMLScene(scene);
  this->onSceneReplaced();
}

void qSlicerSurgicalPathScaleModuleWidget::onSceneReplaced()
{
  Q_D(qSlicerSurgicalPathScaleModuleWidget);
  vtkMRMLScene* scene = this->mrmlScene();
  if (scene && scene->IsBatchProcessing()) return;
  vtkMRMLNode* node = scene ? scene->GetFirstNodeByClass("vtkMRMLSurgicalPathScaleNode") : nullptr;
  if (!node && scene && this->isEntered()) node = d->logic()->ParameterNode();
  d->setParameterNode(vtkMRMLSurgicalPathScaleNode::SafeDownCast(node));
}

void qSlicerSurgicalPathScaleModuleWidget::updateFromNode()
{
  Q_D(qSlicerSurgicalPathScaleModuleWidget);
  this->setEnabled(d->Parameters != nullptr);
  if (!d->Parameters) return;
  d->show();
  // While a scene is being read, the plot may be incomplete.
  const bool isReading = this->mrmlScene()->IsBatchProcessing();
  if (d->Parameters->GetPlotChartNode(Node::ProfileChartRole()) && !isReading)
    surgicalmesher::plotProfile(d->Parameters);
  this->onInputChanged();
}

void qSlicerSurgicalPathScaleModuleWidget::onInputChanged()
{
  Q_D(qSlicerSurgicalPathScaleModuleWidget);
  if (!d->Parameters || !this->isEntered()) return; // enter() updates the panel
  d->showObstacle(d->logic()->FindProblem(d->Parameters));
  d->scheduleUpdates();
}

void qSlicerSurgicalPathScaleModuleWidget::updatePreview()
{
  Q_D(qSlicerSurgicalPathScaleModuleWidget);
  d->PreviewTimer.stop();
  if (d->logic()->GetRun()->IsStarting()) // Slicer's thread looks up the run's nodes; the scene must not change
  {
    d->PreviewTimer.start();
    return;
  }
  if (d->Parameters && this->isEntered() && d->PreviewCheckBox->isChecked()) d->logic()->ShowPreview(d->Parameters);
  else d->logic()->HidePreview();
}

void qSlicerSurgicalPathScaleModuleWidget::updateEstimate()
{
  Q_D(qSlicerSurgicalPathScaleModuleWidget);
  if (!d->Parameters || !this->isEntered()) return;
  QElapsedTimer timer;
  timer.start();
  const Logic::Estimate estimate = d->logic()->EstimateMesh(d->Parameters);
  d->EstimateTimer.setInterval(
    qMax(500, 3 * int(timer.elapsed()))); // for large maps, wait longer for the sliders to rest
  d->EstimateLabel->setText(estimate.triangles < 0 ? tr("not known yet") : sizeSentence(estimate));
}

void qSlicerSurgicalPathScaleModuleWidget::showProfile(bool isWanted)
{
  Q_D(qSlicerSurgicalPathScaleModuleWidget);
  if (!d->isListening()) return;
  if (!isWanted) return surgicalmesher::removeProfile(d->Parameters);
  vtkMRMLPlotChartNode* chart = surgicalmesher::plotProfile(d->Parameters);
  auto* plots = vtkSlicerPlotsLogic::SafeDownCast(d->logic()->GetModuleLogic("Plots"));
  if (plots) plots->ShowChartInLayout(chart);
}

void qSlicerSurgicalPathScaleModuleWidget::apply()
{
  Q_D(qSlicerSurgicalPathScaleModuleWidget);
  if (!d->Parameters) return;
  if (!d->logic()->Start(d->Parameters)) d->showObstacle(d->logic()->GetStartProblem());
}

void qSlicerSurgicalPathScaleModuleWidget::onRunEnded()
{
  Q_D(qSlicerSurgicalPathScaleModuleWidget);
  vtkSurgicalMesherRun* run = d->logic()->GetRun();
  vtkMRMLScalarVolumeNode* scale = d->Parameters ? d->Parameters->GetScalarVolumeNode(Node::ScaleRole()) : nullptr;
  if (run->GetStatus() != vtkSurgicalMesherRun::Completed || !scale || !scale->GetImageData()) return;
  d->PreviewCheckBox->setChecked(false); // replaced by the result
  d->logic()->ShowResult(d->Parameters);
  double range[2];
  scale->GetImageData()->GetScalarRange(range);
  d->RunWidget->setResult(tr("Edge lengths from %1 to %2 mm; %3 to expect.")
                            .arg(range[0], 0, 'g', 3)
                            .arg(range[1], 0, 'g', 3)
                            .arg(sizeSentence(d->logic()->GetEstimateOfRun())));
}
