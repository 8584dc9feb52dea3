// SPDX-License-Identifier: Apache-2.0
#include "qSlicerTissueMapperModuleWidget.h"

#include "MarkupsInput.h"
#include "ParameterPanel.h"
#include "TaskObstacle.h"
#include "TrainingPoints.h"
#include "ui_qSlicerTissueMapperModuleWidget.h"
#include "vtkMRMLTissueMapperNode.h"
#include "vtkSlicerTissueMapperLogic.h"
#include "vtkSurgicalMesherRun.h"

#include <vtkMRMLLabelMapVolumeNode.h>
#include <vtkMRMLMarkupsFiducialNode.h>
#include <vtkMRMLScalarVolumeNode.h>
#include <vtkMRMLScene.h>

#include <QSignalBlocker>
#include <QToolButton>

#include <algorithm>
#include <vector>

using surgicalmesher::PanelObstacle;
using surgicalmesher::TaskCheck;
using surgicalmesher::TrainedClass;
using Node = vtkMRMLTissueMapperNode;
using Logic = vtkSlicerTissueMapperLogic;

class qSlicerTissueMapperModuleWidgetPrivate : public Ui_qSlicerTissueMapperModuleWidget,
                                               public surgicalmesher::ParameterPanel<Node>
{
  Q_DECLARE_PUBLIC(qSlicerTissueMapperModuleWidget)
  qSlicerTissueMapperModuleWidget* const q_ptr;

public:
  explicit qSlicerTissueMapperModuleWidgetPrivate(qSlicerTissueMapperModuleWidget& object) : q_ptr(&object) {}

  Logic* logic() const { return Logic::SafeDownCast(q_ptr->logic()); }
  vtkMRMLMarkupsNode* training() const { return this->Parameters->GetMarkupsNode(Node::TrainingRole()); }

  void setParameterNode(vtkMRMLTissueMapperNode* node);
  void setupPlacing();
  void bindControls();
  void showClasses();
  void showObstacle(const TaskCheck& check);
  void placePoints();
  void leaveOut(const std::string& image);

  PanelObstacle obstacle(const TaskCheck& check);
};

void qSlicerTissueMapperModuleWidgetPrivate::setParameterNode(vtkMRMLTissueMapperNode* node)
{
  Q_Q(qSlicerTissueMapperModuleWidget);
  q->qvtkReconnect(this->Parameters, node, vtkCommand::ModifiedEvent, q, SLOT(updateFromNode()));
  q->qvtkReconnect(this->Parameters, node, Node::InputModifiedEvent, q, SLOT(onInputChanged()));
  this->Parameters = node;
  this->RegistrationWidget->setParameterNode(node);
  this->CompartmentsWidget->setParameterNode(node);
  this->TubeWidget->setParameterNode(node);
  q->updateFromNode();
}

void qSlicerTissueMapperModuleWidgetPrivate::setupPlacing()
{
  this->TrainingPlaceWidget->setButtonsVisible(false);
  this->TrainingPlaceWidget->placeButton()->setVisible(true);
  this->TrainingPlaceWidget->deleteButton()->setVisible(true);
  this->TrainingPlaceWidget->setPlaceMultipleMarkups(qSlicerMarkupsPlaceWidget::ForcePlaceMultipleMarkups);
  QObject::connect(this->TrainingSelector, SIGNAL(currentNodeChanged(vtkMRMLNode*)), this->TrainingPlaceWidget,
                   SLOT(setCurrentNode(vtkMRMLNode*)));
}

void qSlicerTissueMapperModuleWidgetPrivate::bindControls()
{
  this->bind(this->ImageSelector, Node::ImageRole());
  this->bind(this->SecondImageSelector, Node::SecondImageRole());
  this->bind(this->ThirdImageSelector, Node::ThirdImageRole());
  this->bind(this->FourthImageSelector, Node::FourthImageRole());
  this->bind(this->TrainingSelector, Node::TrainingRole());
  this->bind(this->LabelMapSelector, Node::LabelMapRole());
  this->bind(this->ClassComboBox->lineEdit(), &QLineEdit::textChanged, &Node::GetTrainingClass,
             &Node::SetTrainingClass);
  this->bind(this->ClassesPathLineEdit, &Node::GetClasses, &Node::SetClasses);
  this->bind(this->CorrectBiasCheckBox, &Node::GetCorrectBias, &Node::SetCorrectBias);
  this->bind(this->DenoiseCheckBox, &Node::GetDenoise, &Node::SetDenoise);
  this->bind(this->UseCompartmentsCheckBox, &Node::GetUseCompartments, &Node::SetUseCompartments);
  this->bind(this->UseContiguityCheckBox, &Node::GetUseContiguity, &Node::SetUseContiguity);
  this->bind(this->UseProximityCheckBox, &Node::GetUseProximity, &Node::SetUseProximity);
  this->onShow([this] { this->UseProximityCheckBox->setEnabled(this->Parameters->GetUseContiguity()); });
  this->onShow(
    [this]
    {
      if (this->training()) surgicalmesher::labelNewPoints(this->training(), this->Parameters->GetTrainingClass());
      for (QPushButton* button : { this->ScaleButton, this->MesherButton })
        button->setEnabled(this->Parameters->GetLabelMapNode(Node::LabelMapRole()) != nullptr);
    });
}

/// Shows the number of points by class, and the classes to choose from.
void qSlicerTissueMapperModuleWidgetPrivate::showClasses()
{
  const std::vector<TrainedClass> classes = surgicalmesher::countTrainingPoints(this->training());
  this->ClassTable->setRowCount(int(classes.size()));
  QStringList names;
  for (const std::string& usual : surgicalmesher::usualClasses()) names << QString::fromStdString(usual);
  for (int row = 0; row < int(classes.size()); ++row)
  {
    const QString name = QString::fromStdString(classes[row].name);
    this->ClassTable->setItem(row, 0, new QTableWidgetItem(name));
    this->ClassTable->setItem(row, 1, new QTableWidgetItem(QString::number(classes[row].pointCount)));
    if (!name.isEmpty() && !names.contains(name, Qt::CaseInsensitive)) names << name;
  }
  if (this->ClassComboBox->count() == names.size()) return; // classes are added and removed, but not renamed
  const QSignalBlocker blocker(this->ClassComboBox->lineEdit());
  const QString text = this->ClassComboBox->currentText();
  this->ClassComboBox->clear();
  this->ClassComboBox->addItems(names);
  this->ClassComboBox->setEditText(text);
}

void qSlicerTissueMapperModuleWidgetPrivate::showObstacle(const TaskCheck& check)
{
  const PanelObstacle found = this->obstacle(check);
  if (found.sentence.isEmpty()) this->RunWidget->clearProblem();
  else this->RunWidget->setProblem(found.sentence, found.fixText, found.fix);
}

PanelObstacle qSlicerTissueMapperModuleWidgetPrivate::obstacle(const TaskCheck& check)
{
  const QString name = QString::fromStdString(check.name);
  switch (check.problem)
  {
  case TaskCheck::NoTraining:
    return { qSlicerTissueMapperModuleWidget::tr("Place some twenty points in each tissue."),
             qSlicerTissueMapperModuleWidget::tr("Place points"), [this] { this->placePoints(); } };
  case TaskCheck::NoClassFile:
    return { qSlicerTissueMapperModuleWidget::tr("There is no file %1 with a table of classes.").arg(name),
             qSlicerTissueMapperModuleWidget::tr("Do without"),
             [this] { this->Parameters->SetClasses(std::string()); } };
  case TaskCheck::OtherGrid:
    return { qSlicerTissueMapperModuleWidget::tr("The image %1 lies on another grid than the first.").arg(name),
             qSlicerTissueMapperModuleWidget::tr("Leave it out"),
             [this, image = check.name] { this->leaveOut(image); } };
  default: return surgicalmesher::taskObstacle(check, this->ImageSelector);
  }
}

void qSlicerTissueMapperModuleWidgetPrivate::placePoints()
{
  if (!this->TrainingSelector->currentNode()) this->TrainingSelector->addNode();
  this->TrainingPlaceWidget->setCurrentNode(this->TrainingSelector->currentNode());
  this->TrainingPlaceWidget->setPlaceModeEnabled(true);
}

void qSlicerTissueMapperModuleWidgetPrivate::leaveOut(const std::string& image)
{
  for (const char* role : { Node::SecondImageRole(), Node::ThirdImageRole(), Node::FourthImageRole() })
  {
    vtkMRMLNode* node = this->Parameters->GetNodeReference(role);
    if (node && node->GetName() == image) return this->Parameters->SetNode(role, nullptr);
  }
}

//-----------------------------------------------------------------------------
qSlicerTissueMapperModuleWidget::qSlicerTissueMapperModuleWidget(QWidget* parent)
  : Superclass(parent), d_ptr(new qSlicerTissueMapperModuleWidgetPrivate(*this))
{
}

qSlicerTissueMapperModuleWidget::~qSlicerTissueMapperModuleWidget() = default;

void qSlicerTissueMapperModuleWidget::setup()
{
  Q_D(qSlicerTissueMapperModuleWidget);
  d->setupUi(this);
  this->Superclass::setup();
  d->setupPlacing();
  d->bindControls();
  // The obstacle depends on which images exist; queued, because they are known only after the scene has changed.
  connect(d->ImageSelector, SIGNAL(nodeAdded(vtkMRMLNode*)), this, SLOT(onInputChanged()), Qt::QueuedConnection);
  connect(d->ImageSelector, SIGNAL(nodeAboutToBeRemoved(vtkMRMLNode*)), this, SLOT(onInputChanged()),
          Qt::QueuedConnection);
  connect(d->ClassTable, SIGNAL(cellClicked(int, int)), this, SLOT(chooseClass(int)));
  connect(d->RunWidget, SIGNAL(applyRequested()), this, SLOT(apply()));
  connect(d->RunWidget, SIGNAL(runEnded()), this, SLOT(onRunEnded()));
  connect(d->ScaleButton, SIGNAL(clicked()), this, SLOT(openScale()));
  connect(d->MesherButton, SIGNAL(clicked()), this, SLOT(openMesher()));
  d->RunWidget->setRun(d->logic()->GetRun(Logic::Classify));
  d->RegistrationWidget->setLogic(d->logic());
  d->CompartmentsWidget->setLogic(d->logic());
  d->TubeWidget->setLogic(d->logic());
}

void qSlicerTissueMapperModuleWidget::enter()
{
  Q_D(qSlicerTissueMapperModuleWidget);
  this->Superclass::enter();
  d->setParameterNode(d->logic()->ParameterNode());
  d->RegistrationWidget->setActive(true);
  d->CompartmentsWidget->setActive(true);
  d->TubeWidget->setActive(true);
}

void qSlicerTissueMapperModuleWidget::exit()
{
  Q_D(qSlicerTissueMapperModuleWidget);
  d->TrainingPlaceWidget->setPlaceModeEnabled(false);
  d->RegistrationWidget->setActive(false);
  d->CompartmentsWidget->setActive(false);
  d->TubeWidget->setActive(false);
  this->Superclass::exit();
}

bool qSlicerTissueMapperModuleWidget::setEditedNode(vtkMRMLNode* node, QString role, QString context)
{
  Q_D(qSlicerTissueMapperModuleWidget);
  if (auto* parameters = vtkMRMLTissueMapperNode::SafeDownCast(node))
  {
    d->setParameterNode(parameters);
    return true;
  }
  if (!d->Parameters) d->setParameterNode(d->logic()->ParameterNode());
  if (!d->Parameters) return false;
  const char* target = nullptr;
  if (vtkMRMLLabelMapVolumeNode::SafeDownCast(node)) target = Node::LabelMapRole();
  else if (vtkMRMLScalarVolumeNode::SafeDownCast(node)) target = Node::ImageRole();
  else if (vtkMRMLMarkupsFiducialNode::SafeDownCast(node)) target = Node::TrainingRole();
  if (!target) return this->Superclass::setEditedNode(node, role, context);
  d->Parameters->SetNode(target, node);
  return true;
}

void qSlicerTissueMapperModuleWidget::setMRMLScene(vtkMRMLScene* scene)
{
  for (const unsigned long event : { vtkMRMLScene::EndImportEvent, vtkMRMLScene::EndBatchProcessEvent,
                                     vtkMRMLScene::EndCloseEvent, vtkMRMLScene::EndRestoreEvent })
  {
    this->qvtkReconnect(this->mrmlScene(), scene, event, this, SLOT(onSceneReplaced()));
  }
  this->Superclass::setMRMLScene(scene);
  this->onSceneReplaced();
}

void qSlicerTissueMapperModuleWidget::onSceneReplaced()
{
  Q_D(qSlicerTissueMapperModuleWidget);
  vtkMRMLScene* scene = this->mrmlScene();
  if (scene && scene->IsBatchProcessing()) return;
  vtkMRMLNode* node = scene ? scene->GetFirstNodeByClass("vtkMRMLTissueMapperNode") : nullptr;
  if (!node && scene && this->isEntered()) node = d->logic()->ParameterNode();
  d->setParameterNode(vtkMRMLTissueMapperNode::SafeDownCast(node));
}

void qSlicerTissueMapperModuleWidget::updateFromNode()
{
  Q_D(qSlicerTissueMapperModuleWidget);
  this->setEnabled(d->Parameters != nullptr);
  if (!d->Parameters) return;
  d->show();
  this->onInputChanged();
}

void qSlicerTissueMapperModuleWidget::onInputChanged()
{
  Q_D(qSlicerTissueMapperModuleWidget);
  if (!d->Parameters || !this->isEntered()) return; // enter() catches up
  d->showClasses();
  d->showObstacle(d->logic()->FindProblem(Logic::Classify, d->Parameters));
}

void qSlicerTissueMapperModuleWidget::chooseClass(int row)
{
  Q_D(qSlicerTissueMapperModuleWidget);
  if (d->Parameters) d->Parameters->SetTrainingClass(d->ClassTable->item(row, 0)->text().toStdString());
}

void qSlicerTissueMapperModuleWidget::apply()
{
  Q_D(qSlicerTissueMapperModuleWidget);
  if (!d->Parameters) return;
  const TaskCheck check = d->logic()->Start(Logic::Classify, d->Parameters);
  if (check.problem != TaskCheck::None) d->showObstacle(check);
}

void qSlicerTissueMapperModuleWidget::onRunEnded()
{
  Q_D(qSlicerTissueMapperModuleWidget);
  vtkSurgicalMesherRun* run = d->logic()->GetRun(Logic::Classify);
  if (run->GetStatus() != vtkSurgicalMesherRun::Completed || !d->Parameters) return;
  d->logic()->ShowLabelMap(d->Parameters->GetNodeReference(Node::LabelMapRole()));
  QString sentence = tr("Classified in %1 s.").arg(run->GetElapsedSeconds(), 0, 'f', 1);
  for (const std::string& name : d->logic()->GetEmptyClasses())
    sentence += " " + tr("No voxel is %1.").arg(QString::fromStdString(name));
  d->RunWidget->setResult(sentence);
}

void qSlicerTissueMapperModuleWidget::openScale()
{
  Q_D(qSlicerTissueMapperModuleWidget);
  if (d->Parameters)
    surgicalmesher::openModule("SurgicalPathScale", d->Parameters->GetLabelMapNode(Node::LabelMapRole()));
}

void qSlicerTissueMapperModuleWidget::openMesher()
{
  Q_D(qSlicerTissueMapperModuleWidget);
  if (d->Parameters) surgicalmesher::openModule("SimplexMesher", d->Parameters->GetLabelMapNode(Node::LabelMapRole()));
}
