// SPDX-License-Identifier: Apache-2.0
#include "qSlicerTissueMapperTubeWidget.h"

#include "MarkupsInput.h"
#include "ParameterPanel.h"
#include "TaskObstacle.h"
#include "ui_qSlicerTissueMapperTubeWidget.h"
#include "vtkMRMLTissueMapperNode.h"
#include "vtkSlicerTissueMapperLogic.h"
#include "vtkSurgicalMesherRun.h"

#include <vtkMRMLMarkupsNode.h>
#include <vtkMRMLScalarVolumeNode.h>

#include <QTimer>
#include <QToolButton>

#include <vector>

using surgicalmesher::PanelObstacle;
using surgicalmesher::TaskCheck;
using surgicalmesher::Vec3;
using Node = vtkMRMLTissueMapperNode;
using Logic = vtkSlicerTissueMapperLogic;

class qSlicerTissueMapperTubeWidgetPrivate : public Ui_qSlicerTissueMapperTubeWidget,
                                             public surgicalmesher::ParameterPanel<Node>
{
public:
  vtkWeakPointer<Logic> TheLogic;
  bool IsActive = false;
  /// Delays the run, so that dragging a point starts one run, not hundreds.
  QTimer Timer;
  std::vector<Vec3> FollowedPoints; ///< points of the last automatic run

  std::vector<Vec3> points() const
  {
    return surgicalmesher::markupsPoints(this->Parameters->GetMarkupsNode(Node::TubePointsRole()));
  }
  void bindControls();
  void start(Logic::Task task);
  void showObstacle(const TaskCheck& check);
  PanelObstacle obstacle(const TaskCheck& check);
  void placePoints();
};

void qSlicerTissueMapperTubeWidgetPrivate::bindControls()
{
  this->bind(this->TubeImageSelector, Node::TubeImageRole());
  this->bind(this->TubePointsSelector, Node::TubePointsRole());
  this->bind(this->TubePathSelector, Node::TubePathRole());
  this->bind(this->TubeNameLineEdit, &QLineEdit::editingFinished, &Node::GetTubeName, &Node::SetTubeName);
  this->bindData(this->PolarityComboBox, &Node::GetPolarity, &Node::SetPolarity);
  this->bindData(this->PotentialComboBox, &Node::GetTubePotential, &Node::SetTubePotential);
  this->bind(this->SnapSpinBox, &Node::GetTubeSnap, &Node::SetTubeSnap);
  this->bind(this->MarginSpinBox, &Node::GetTubeMargin, &Node::SetTubeMargin);
  this->bind(this->MinimumRadiusSpinBox, &Node::GetMinimumRadius, &Node::SetMinimumRadius);
  this->bind(this->MaximumRadiusSpinBox, &Node::GetMaximumRadius, &Node::SetMaximumRadius);
  this->bind(this->TraceAtOnceCheckBox, &Node::GetTraceAtOnce, &Node::SetTraceAtOnce);
}

/// Starts a task unless one is running; the foot of the panel shows its run.
void qSlicerTissueMapperTubeWidgetPrivate::start(Logic::Task task)
{
  if (!this->Parameters || !this->TheLogic) return;
  for (const Logic::Task other : { Logic::TraceTube, Logic::AddTube })
  {
    if (this->TheLogic->GetRun(other)->IsBusy()) return;
  }
  this->TubeRunWidget->setRun(this->TheLogic->GetRun(task));
  const TaskCheck check = this->TheLogic->Start(task, this->Parameters);
  if (check.problem != TaskCheck::None) this->showObstacle(check);
}

void qSlicerTissueMapperTubeWidgetPrivate::showObstacle(const TaskCheck& check)
{
  const PanelObstacle found = this->obstacle(check);
  if (found.sentence.isEmpty()) this->TubeRunWidget->clearProblem();
  else this->TubeRunWidget->setProblem(found.sentence, found.fixText, found.fix);
}

PanelObstacle qSlicerTissueMapperTubeWidgetPrivate::obstacle(const TaskCheck& check)
{
  switch (check.problem)
  {
  case TaskCheck::FewPoints:
    return { qSlicerTissueMapperTubeWidget::tr("Place two points or more on a vessel or nerve."),
             qSlicerTissueMapperTubeWidget::tr("Place points"), [this] { this->placePoints(); } };
  case TaskCheck::RadiiOdd:
    return { qSlicerTissueMapperTubeWidget::tr("The smallest radius has to be given with the largest, and below it."),
             qSlicerTissueMapperTubeWidget::tr("As the voxels say"),
             [this]
             {
               MRMLNodeModifyBlocker blocker(this->Parameters);
               this->Parameters->SetMinimumRadius(0);
               this->Parameters->SetMaximumRadius(0);
             } };
  case TaskCheck::NoTissues:
    return { qSlicerTissueMapperTubeWidget::tr("There are no tissues yet that it could be added to."), {}, {} };
  default: return surgicalmesher::taskObstacle(check, this->TubeImageSelector);
  }
}

void qSlicerTissueMapperTubeWidgetPrivate::placePoints()
{
  if (!this->TubePointsSelector->currentNode()) this->TubePointsSelector->addNode();
  this->TubePlaceWidget->setCurrentNode(this->TubePointsSelector->currentNode());
  this->TubePlaceWidget->setPlaceModeEnabled(true);
}

//-----------------------------------------------------------------------------
qSlicerTissueMapperTubeWidget::qSlicerTissueMapperTubeWidget(QWidget* parent)
  : Superclass(parent), d_ptr(new qSlicerTissueMapperTubeWidgetPrivate)
{
  Q_D(qSlicerTissueMapperTubeWidget);
  d->setupUi(this);
  d->PolarityComboBox->addItem(tr("as at the points"), "auto");
  d->PolarityComboBox->addItem(tr("brighter than around it"), "bright");
  d->PolarityComboBox->addItem(tr("darker than around it"), "dark");
  d->PotentialComboBox->addItem(tr("axis of the tube (flux)"), "flux");
  d->PotentialComboBox->addItem(tr("edges (gradient)"), "gradient");
  d->PotentialComboBox->addItem(tr("brightness (intensity)"), "intensity");
  d->TubePlaceWidget->setButtonsVisible(false);
  d->TubePlaceWidget->placeButton()->setVisible(true);
  d->TubePlaceWidget->deleteButton()->setVisible(true);
  d->TubePlaceWidget->setPlaceMultipleMarkups(qSlicerMarkupsPlaceWidget::ForcePlaceMultipleMarkups);
  connect(d->TubePointsSelector, SIGNAL(currentNodeChanged(vtkMRMLNode*)), d->TubePlaceWidget,
          SLOT(setCurrentNode(vtkMRMLNode*)));
  d->bindControls();
  d->Timer.setSingleShot(true);
  d->Timer.setInterval(300);
  connect(&d->Timer, SIGNAL(timeout()), this, SLOT(followPoints()));
  connect(d->TubeRunWidget, SIGNAL(applyRequested()), this, SLOT(trace()));
  connect(d->TubeRunWidget, SIGNAL(runEnded()), this, SLOT(onRunEnded()));
  connect(d->AddTubeButton, SIGNAL(clicked()), this, SLOT(addTube()));
}

qSlicerTissueMapperTubeWidget::~qSlicerTissueMapperTubeWidget() { this->qvtkDisconnectAll(); }

void qSlicerTissueMapperTubeWidget::setLogic(vtkSlicerTissueMapperLogic* logic)
{
  Q_D(qSlicerTissueMapperTubeWidget);
  d->TheLogic = logic;
  d->TubeRunWidget->setRun(logic->GetRun(Logic::TraceTube));
}

void qSlicerTissueMapperTubeWidget::setParameterNode(vtkMRMLTissueMapperNode* node)
{
  Q_D(qSlicerTissueMapperTubeWidget);
  this->qvtkReconnect(d->Parameters, node, vtkCommand::ModifiedEvent, this, SLOT(updateFromNode()));
  this->qvtkReconnect(d->Parameters, node, Node::InputModifiedEvent, this, SLOT(onInputChanged()));
  d->Parameters = node;
  if (node) d->FollowedPoints = d->points(); // keeps a path that exists already
  this->updateFromNode();
}

void qSlicerTissueMapperTubeWidget::setActive(bool isActive)
{
  Q_D(qSlicerTissueMapperTubeWidget);
  d->IsActive = isActive;
  if (isActive) return this->onInputChanged();
  d->Timer.stop();
  d->TubePlaceWidget->setPlaceModeEnabled(false);
}

void qSlicerTissueMapperTubeWidget::updateFromNode()
{
  Q_D(qSlicerTissueMapperTubeWidget);
  if (!d->Parameters) return;
  d->show();
  this->onInputChanged();
}

void qSlicerTissueMapperTubeWidget::onInputChanged()
{
  Q_D(qSlicerTissueMapperTubeWidget);
  if (!d->Parameters || !d->TheLogic || !d->IsActive) return; // setActive() catches up
  const TaskCheck check = d->TheLogic->FindProblem(Logic::TraceTube, d->Parameters);
  d->showObstacle(check);
  d->AddTubeButton->setEnabled(d->TheLogic->FindProblem(Logic::AddTube, d->Parameters).problem == TaskCheck::None);
  const bool isNew = check.problem == TaskCheck::None && d->points() != d->FollowedPoints;
  if (d->Parameters->GetTraceAtOnce() && isNew) d->Timer.start();
}

void qSlicerTissueMapperTubeWidget::followPoints()
{
  Q_D(qSlicerTissueMapperTubeWidget);
  if (!d->Parameters || !d->TheLogic || !d->IsActive || !d->TubeRunWidget->problem().isEmpty()) return;
  for (const Logic::Task task : { Logic::Classify, Logic::TraceTube, Logic::AddTube })
  {
    if (d->TheLogic->GetRun(task)->IsBusy()) return d->Timer.start(); // retries after the current run
  }
  d->FollowedPoints = d->points();
  this->trace();
}

void qSlicerTissueMapperTubeWidget::trace()
{
  Q_D(qSlicerTissueMapperTubeWidget);
  d->start(Logic::TraceTube);
}

void qSlicerTissueMapperTubeWidget::addTube()
{
  Q_D(qSlicerTissueMapperTubeWidget);
  d->start(Logic::AddTube);
}

void qSlicerTissueMapperTubeWidget::onRunEnded()
{
  Q_D(qSlicerTissueMapperTubeWidget);
  vtkSurgicalMesherRun* run = d->TubeRunWidget->run();
  if (run->GetStatus() != vtkSurgicalMesherRun::Completed || !d->Parameters) return;
  const bool isAdded = run == d->TheLogic->GetRun(Logic::AddTube);
  const surgicalmesher::FoundTube& tube = d->TheLogic->GetFoundTube(isAdded ? Logic::AddTube : Logic::TraceTube);
  QString sentence = (isAdded ? tr("Added: %1 mm long, radius %2 to %3 mm.") : tr("%1 mm long, radius %2 to %3 mm."))
                       .arg(tube.length, 0, 'f', 1)
                       .arg(tube.smallestRadius, 0, 'f', 2)
                       .arg(tube.largestRadius, 0, 'f', 2);
  for (const std::string& warning : tube.warnings) sentence += " " + QString::fromStdString(warning) + ".";
  d->TubeRunWidget->setResult(sentence);
}
