// SPDX-License-Identifier: Apache-2.0
#include "qSlicerSimplexMesherBalloonSection.h"

#include "ParameterPanel.h"
#include "ui_qSlicerSimplexMesherBalloonSection.h"
#include "vtkMRMLSimplexMesherNode.h"
#include "vtkSlicerSimplexMesherLogic.h"
#include "vtkSurgicalMesherRun.h"

#include <vtkMRMLMarkupsNode.h>
#include <vtkMRMLModelNode.h>
#include <vtkMRMLScene.h>

#include <vtkPolyData.h>
#include <vtkWeakPointer.h>

#include <QSignalBlocker>
#include <QTimer>

#include <set>

using surgicalmesher::BalloonProblem;
using surgicalmesher::PanelObstacle;
using surgicalmesher::TissueRow;
using Node = vtkMRMLSimplexMesherNode;

class qSlicerSimplexMesherBalloonSectionPrivate : public Ui_qSlicerSimplexMesherBalloonSection,
                                                  public surgicalmesher::ParameterPanel<Node>
{
public:
  vtkWeakPointer<vtkSlicerSimplexMesherLogic> Logic;
  vtkWeakPointer<vtkMRMLNode> Seeds; ///< observed
  PanelObstacle InputObstacle;
  QTimer GrowthTimer;

  PanelObstacle obstacle() const;
  void showObstacle();
  void showStops();
};

PanelObstacle qSlicerSimplexMesherBalloonSectionPrivate::obstacle() const
{
  if (!this->InputObstacle.sentence.isEmpty()) return this->InputObstacle;
  switch (this->Logic->GetBalloons().findProblem(this->Parameters))
  {
  case BalloonProblem::None: return {};
  case BalloonProblem::NoModule:
    return { qSlicerSimplexMesherBalloonSection::tr(
               "The command-line module BalloonSurfaceCLI isn't loaded; see the application's log."),
             {},
             {} };
  case BalloonProblem::NoSeeds:
    return { qSlicerSimplexMesherBalloonSection::tr("Choose a list of points, and place one where a balloon begins."),
             qSlicerSimplexMesherBalloonSection::tr("Markups"), [] { surgicalmesher::openModule("Markups"); } };
  default: return { qSlicerSimplexMesherBalloonSection::tr("Choose the tissues that stop the balloons."), {}, {} };
  }
}

void qSlicerSimplexMesherBalloonSectionPrivate::showObstacle()
{
  if (!this->Parameters || !this->Logic) return;
  const PanelObstacle found = this->obstacle();
  if (found.sentence.isEmpty()) this->BalloonRunWidget->clearProblem();
  else this->BalloonRunWidget->setProblem(found.sentence, found.fixText, found.fix);
}

void qSlicerSimplexMesherBalloonSectionPrivate::showStops()
{
  const std::set<std::string>& stops = this->Parameters->GetBalloonStops();
  for (int row = 0; row < this->StopsComboBox->count(); ++row)
  {
    const bool stopsHere = stops.count(this->StopsComboBox->itemData(row).toString().toStdString()) > 0;
    const QModelIndex index = this->StopsComboBox->model()->index(row, 0);
    const Qt::CheckState state = stopsHere ? Qt::Checked : Qt::Unchecked;
    if (this->StopsComboBox->checkState(index) != state) this->StopsComboBox->setCheckState(index, state);
  }
}

qSlicerSimplexMesherBalloonSection::qSlicerSimplexMesherBalloonSection(QWidget* parent)
  : QWidget(parent), d_ptr(new qSlicerSimplexMesherBalloonSectionPrivate)
{
  Q_D(qSlicerSimplexMesherBalloonSection);
  d->setupUi(this);
  d->bind(d->SeedsSelector, Node::BalloonSeedsRole());
  d->bind(d->BalloonSurfaceSelector, Node::BalloonSurfaceRole());
  d->bind(d->BalloonLabelMapSelector, Node::BalloonLabelMapRole());
  d->bind(d->LimitSpinBox, &Node::GetBalloonLimit, &Node::SetBalloonLimit);
  d->bind(d->RigiditySpinBox, &Node::GetBalloonRigidity, &Node::SetBalloonRigidity);
  d->onShow([d] { d->showStops(); });
  connect(d->StopsComboBox, SIGNAL(checkedIndexesChanged()), this, SLOT(onStopsChanged()));
  d->GrowthTimer.setInterval(500);
  connect(&d->GrowthTimer, SIGNAL(timeout()), this, SLOT(showGrowth()));
  connect(d->BalloonRunWidget, SIGNAL(applyRequested()), this, SLOT(apply()));
  connect(d->BalloonRunWidget, SIGNAL(runEnded()), this, SLOT(onRunEnded()));
}

qSlicerSimplexMesherBalloonSection::~qSlicerSimplexMesherBalloonSection() = default;

void qSlicerSimplexMesherBalloonSection::setLogic(vtkSlicerSimplexMesherLogic* logic)
{
  Q_D(qSlicerSimplexMesherBalloonSection);
  d->Logic = logic;
  d->BalloonRunWidget->setRun(logic->GetBalloons().run());
}

void qSlicerSimplexMesherBalloonSection::setParameterNode(vtkMRMLSimplexMesherNode* node)
{
  Q_D(qSlicerSimplexMesherBalloonSection);
  this->qvtkReconnect(d->Parameters, node, vtkCommand::ModifiedEvent, this, SLOT(updateFromNode()));
  d->Parameters = node;
  this->updateFromNode();
}

void qSlicerSimplexMesherBalloonSection::setTissues(const std::vector<TissueRow>& tissues)
{
  Q_D(qSlicerSimplexMesherBalloonSection);
  const QSignalBlocker blocker(d->StopsComboBox);
  d->StopsComboBox->clear();
  for (const TissueRow& tissue : tissues)
  {
    const QString name = QString::fromStdString(tissue.name.empty() ? tissue.id : tissue.name);
    d->StopsComboBox->addItem(name, QString::fromStdString(tissue.id));
  }
  if (d->Parameters) d->showStops();
}

void qSlicerSimplexMesherBalloonSection::setInputObstacle(const PanelObstacle& obstacle)
{
  Q_D(qSlicerSimplexMesherBalloonSection);
  d->InputObstacle = obstacle;
  d->showObstacle();
}

void qSlicerSimplexMesherBalloonSection::setMRMLScene(vtkMRMLScene* scene)
{
  Q_D(qSlicerSimplexMesherBalloonSection);
  for (qMRMLNodeComboBox* selector : { d->SeedsSelector, d->BalloonSurfaceSelector, d->BalloonLabelMapSelector })
    selector->setMRMLScene(scene);
}

void qSlicerSimplexMesherBalloonSection::updateFromNode()
{
  Q_D(qSlicerSimplexMesherBalloonSection);
  if (!d->Parameters) return;
  d->show();
  vtkMRMLNode* seeds = d->Parameters->GetNodeReference(Node::BalloonSeedsRole());
  for (const unsigned long event :
       { (unsigned long)vtkMRMLMarkupsNode::PointModifiedEvent, (unsigned long)vtkMRMLMarkupsNode::PointRemovedEvent })
  {
    this->qvtkReconnect(d->Seeds, seeds, event, this, SLOT(onSeedsChanged()));
  }
  d->Seeds = seeds;
  d->showObstacle();
}

void qSlicerSimplexMesherBalloonSection::onSeedsChanged() { d_ptr->showObstacle(); }

void qSlicerSimplexMesherBalloonSection::onStopsChanged()
{
  Q_D(qSlicerSimplexMesherBalloonSection);
  if (!d->isListening()) return;
  std::set<std::string> stops;
  for (const QModelIndex& index : d->StopsComboBox->checkedIndexes())
    stops.insert(d->StopsComboBox->itemData(index.row()).toString().toStdString());
  d->Parameters->SetBalloonStops(stops);
}

void qSlicerSimplexMesherBalloonSection::apply()
{
  Q_D(qSlicerSimplexMesherBalloonSection);
  if (!d->Parameters || !d->BalloonRunWidget->problem().isEmpty()) return;
  if (!d->Logic->GetBalloons().start(d->Parameters))
  {
    const std::string failure = d->Logic->GetBalloons().run()->GetErrorText();
    if (!failure.empty()) d->BalloonRunWidget->setProblem(QString::fromStdString(failure));
    return;
  }
  d->GrowthTimer.start();
  emit this->runStarted();
}

void qSlicerSimplexMesherBalloonSection::showGrowth() { d_ptr->Logic->GetBalloons().showGrowth(); }

void qSlicerSimplexMesherBalloonSection::onRunEnded()
{
  Q_D(qSlicerSimplexMesherBalloonSection);
  d->GrowthTimer.stop();
  vtkSurgicalMesherRun* run = d->Logic->GetBalloons().run();
  vtkMRMLModelNode* surface = d->Parameters ? d->Parameters->GetModelNode(Node::BalloonSurfaceRole()) : nullptr;
  if (run->GetStatus() == vtkSurgicalMesherRun::Completed && surface && surface->GetPolyData())
    d->BalloonRunWidget->setResult(tr("%L1 triangles after %2 motions, in %3 s.")
                                     .arg(qlonglong(surface->GetPolyData()->GetNumberOfCells()))
                                     .arg(QString::fromStdString(run->GetReturnedValue("motionCount")))
                                     .arg(run->GetElapsedSeconds(), 0, 'f', 1));
  emit this->runEnded();
}
