// SPDX-License-Identifier: Apache-2.0
#include "qSlicerTissueMapperRegistrationWidget.h"

#include "ParameterPanel.h"
#include "TaskObstacle.h"
#include "ui_qSlicerTissueMapperRegistrationWidget.h"
#include "vtkMRMLTissueMapperNode.h"
#include "vtkSlicerTissueMapperLogic.h"
#include "vtkSurgicalMesherRun.h"

#include <QToolButton>

using surgicalmesher::PanelObstacle;
using surgicalmesher::TaskCheck;
using Node = vtkMRMLTissueMapperNode;
using Logic = vtkSlicerTissueMapperLogic;

class qSlicerTissueMapperRegistrationWidgetPrivate : public Ui_qSlicerTissueMapperRegistrationWidget,
                                                     public surgicalmesher::ParameterPanel<Node>
{
public:
  vtkWeakPointer<Logic> TheLogic;
  bool IsActive = false;

  void bindControls();
  void showObstacle(const TaskCheck& check);
  PanelObstacle obstacle(const TaskCheck& check);
};

void qSlicerTissueMapperRegistrationWidgetPrivate::bindControls()
{
  this->bind(this->FixedImageSelector, Node::FixedImageRole());
  this->bind(this->MovingImageSelector, Node::MovingImageRole());
  this->bind(this->TargetSelector, Node::TargetRole());
  this->bind(this->RegisteredImageSelector, Node::RegisteredImageRole());
  this->bind(this->TargetRadiusSpinBox, &Node::GetTargetRadius, &Node::SetTargetRadius);
  this->bindData(this->RegistrationStartComboBox, &Node::GetRegistrationStart, &Node::SetRegistrationStart);
  this->onShow([this]
               { this->TargetRadiusSpinBox->setEnabled(this->Parameters->GetNodeReference(Node::TargetRole())); });
}

void qSlicerTissueMapperRegistrationWidgetPrivate::showObstacle(const TaskCheck& check)
{
  const PanelObstacle found = this->obstacle(check);
  if (found.sentence.isEmpty()) this->RegistrationRunWidget->clearProblem();
  else this->RegistrationRunWidget->setProblem(found.sentence, found.fixText, found.fix);
}

PanelObstacle qSlicerTissueMapperRegistrationWidgetPrivate::obstacle(const TaskCheck& check)
{
  switch (check.problem)
  {
  case TaskCheck::NoMoving:
    return { qSlicerTissueMapperRegistrationWidget::tr("Choose the image that is to be moved."), {}, {} };
  case TaskCheck::SameImage:
    return { qSlicerTissueMapperRegistrationWidget::tr("The image %1 is chosen twice; choose another one to be moved.")
               .arg(QString::fromStdString(check.name)),
             {},
             {} };
  default: return surgicalmesher::taskObstacle(check, this->FixedImageSelector);
  }
}

//-----------------------------------------------------------------------------
qSlicerTissueMapperRegistrationWidget::qSlicerTissueMapperRegistrationWidget(QWidget* parent)
  : Superclass(parent), d_ptr(new qSlicerTissueMapperRegistrationWidgetPrivate)
{
  Q_D(qSlicerTissueMapperRegistrationWidget);
  d->setupUi(this);
  d->RegistrationStartComboBox->addItem(tr("centres of the heads"), "centre");
  d->RegistrationStartComboBox->addItem(tr("their principal axes"), "principal");
  d->TargetPlaceWidget->setButtonsVisible(false);
  d->TargetPlaceWidget->placeButton()->setVisible(true);
  d->TargetPlaceWidget->setPlaceMultipleMarkups(qSlicerMarkupsPlaceWidget::ForcePlaceSingleMarkup);
  connect(d->TargetSelector, SIGNAL(currentNodeChanged(vtkMRMLNode*)), d->TargetPlaceWidget,
          SLOT(setCurrentNode(vtkMRMLNode*)));
  d->bindControls();
  connect(d->RegistrationRunWidget, SIGNAL(applyRequested()), this, SLOT(registerImages()));
  connect(d->RegistrationRunWidget, SIGNAL(runEnded()), this, SLOT(onRunEnded()));
}

qSlicerTissueMapperRegistrationWidget::~qSlicerTissueMapperRegistrationWidget() { this->qvtkDisconnectAll(); }

void qSlicerTissueMapperRegistrationWidget::setLogic(vtkSlicerTissueMapperLogic* logic)
{
  Q_D(qSlicerTissueMapperRegistrationWidget);
  d->TheLogic = logic;
  d->RegistrationRunWidget->setRun(logic->GetRun(Logic::Register));
}

void qSlicerTissueMapperRegistrationWidget::setParameterNode(vtkMRMLTissueMapperNode* node)
{
  Q_D(qSlicerTissueMapperRegistrationWidget);
  this->qvtkReconnect(d->Parameters, node, vtkCommand::ModifiedEvent, this, SLOT(updateFromNode()));
  this->qvtkReconnect(d->Parameters, node, Node::InputModifiedEvent, this, SLOT(onInputChanged()));
  d->Parameters = node;
  this->updateFromNode();
}

void qSlicerTissueMapperRegistrationWidget::setActive(bool isActive)
{
  Q_D(qSlicerTissueMapperRegistrationWidget);
  d->IsActive = isActive;
  if (isActive) return this->onInputChanged();
  d->TargetPlaceWidget->setPlaceModeEnabled(false);
}

void qSlicerTissueMapperRegistrationWidget::updateFromNode()
{
  Q_D(qSlicerTissueMapperRegistrationWidget);
  if (!d->Parameters) return;
  d->show();
  this->onInputChanged();
}

void qSlicerTissueMapperRegistrationWidget::onInputChanged()
{
  Q_D(qSlicerTissueMapperRegistrationWidget);
  if (!d->Parameters || !d->TheLogic || !d->IsActive) return; // setActive() catches up
  d->showObstacle(d->TheLogic->FindProblem(Logic::Register, d->Parameters));
}

void qSlicerTissueMapperRegistrationWidget::registerImages()
{
  Q_D(qSlicerTissueMapperRegistrationWidget);
  if (!d->Parameters || !d->TheLogic) return;
  const TaskCheck check = d->TheLogic->Start(Logic::Register, d->Parameters);
  if (check.problem != TaskCheck::None) d->showObstacle(check);
}

void qSlicerTissueMapperRegistrationWidget::onRunEnded()
{
  Q_D(qSlicerTissueMapperRegistrationWidget);
  vtkSurgicalMesherRun* run = d->RegistrationRunWidget->run();
  if (run->GetStatus() != vtkSurgicalMesherRun::Completed || !d->Parameters) return;
  d->TheLogic->ShowRegistered(d->Parameters);
  const surgicalmesher::FoundRegistration& found = d->TheLogic->GetFoundRegistration();
  d->RegistrationRunWidget->setResult(tr("Registered in %1 s: %2 of %3 other starts lead to this pose, scale %4.")
                                        .arg(run->GetElapsedSeconds(), 0, 'f', 1)
                                        .arg(found.agreeingStarts)
                                        .arg(found.otherStarts)
                                        .arg(found.scale, 0, 'f', 3));
}
