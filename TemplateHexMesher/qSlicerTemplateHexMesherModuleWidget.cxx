// SPDX-License-Identifier: Apache-2.0
#include "qSlicerTemplateHexMesherModuleWidget.h"

#include "PanelObstacle.h"
#include "ParameterPanel.h"
#include "ui_qSlicerTemplateHexMesherModuleWidget.h"
#include "vtkMRMLTemplateHexMesherNode.h"
#include "vtkSlicerTemplateHexMesherLogic.h"
#include "vtkSurgicalMesherRun.h"

#include <qSlicerApplication.h>
#include <qSlicerIOManager.h>
#include <vtkSlicerApplicationLogic.h>
#include <vtkSlicerTablesLogic.h>

#include <vtkMRMLLayoutNode.h>
#include <vtkMRMLMarkupsFiducialNode.h>
#include <vtkMRMLModelNode.h>
#include <vtkMRMLScene.h>
#include <vtkMRMLSelectionNode.h>
#include <vtkMRMLTableNode.h>

#include <QHeaderView>
#include <QPointer>
#include <QSignalBlocker>
#include <QTimer>
#include <QToolButton>

#include <vector>

using surgicalmesher::FitCheck;
using surgicalmesher::LandmarkRow;
using surgicalmesher::PanelObstacle;
using Node = vtkMRMLTemplateHexMesherNode;
using Logic = vtkSlicerTemplateHexMesherLogic;
using Panel = qSlicerTemplateHexMesherModuleWidget;

class qSlicerTemplateHexMesherModuleWidgetPrivate : public Ui_qSlicerTemplateHexMesherModuleWidget,
                                                    public surgicalmesher::ParameterPanel<Node>
{
  Q_DECLARE_PUBLIC(qSlicerTemplateHexMesherModuleWidget)
  qSlicerTemplateHexMesherModuleWidget* const q_ptr;

public:
  explicit qSlicerTemplateHexMesherModuleWidgetPrivate(qSlicerTemplateHexMesherModuleWidget& object) : q_ptr(&object) {}

  /// Delays the preview, so that dragging a landmark updates it now and then, not hundreds of times.
  QTimer DisplayTimer;
  /// Widget of the list that gets the next point; null: no pairs are being placed.
  qSlicerMarkupsPlaceWidget* Placing = nullptr;

  Logic* logic() const { return Logic::SafeDownCast(q_ptr->logic()); }
  vtkMRMLMarkupsNode* onTemplate() const { return this->Parameters->GetMarkupsNode(Node::TemplateLandmarksRole()); }
  vtkMRMLMarkupsNode* onTarget() const { return this->Parameters->GetMarkupsNode(Node::TargetLandmarksRole()); }

  void setParameterNode(vtkMRMLTemplateHexMesherNode* node);
  void setupPlacing(qMRMLNodeComboBox* selector, qSlicerMarkupsPlaceWidget* place);
  void bindControls();
  void connectControls();
  void showLandmarks();
  void showObstacle(const FitCheck& check);

  PanelObstacle obstacle(const FitCheck& check);
  PanelObstacle nothingChosen(const QString& sentence, qMRMLNodeComboBox* selector);
};

void qSlicerTemplateHexMesherModuleWidgetPrivate::setParameterNode(vtkMRMLTemplateHexMesherNode* node)
{
  Q_Q(qSlicerTemplateHexMesherModuleWidget);
  q->qvtkReconnect(this->Parameters, node, vtkCommand::ModifiedEvent, q, SLOT(updateFromNode()));
  q->qvtkReconnect(this->Parameters, node, Node::InputModifiedEvent, q, SLOT(onInputChanged()));
  this->Parameters = node;
  q->updateFromNode();
}

void qSlicerTemplateHexMesherModuleWidgetPrivate::setupPlacing(qMRMLNodeComboBox* selector,
                                                               qSlicerMarkupsPlaceWidget* place)
{
  place->setButtonsVisible(false);
  place->placeButton()->setVisible(true);
  place->setPlaceMultipleMarkups(qSlicerMarkupsPlaceWidget::ForcePlaceMultipleMarkups);
  QObject::connect(selector, SIGNAL(currentNodeChanged(vtkMRMLNode*)), place, SLOT(setCurrentNode(vtkMRMLNode*)));
}

void qSlicerTemplateHexMesherModuleWidgetPrivate::bindControls()
{
  this->bind(this->TemplateSelector, Node::TemplateRole());
  this->bind(this->TargetSelector, Node::TargetRole());
  this->bind(this->InnerSelector, Node::InnerRole());
  this->bind(this->CarriedComboBox, Node::CarriedRole());
  this->bind(this->TemplateLandmarksSelector, Node::TemplateLandmarksRole());
  this->bind(this->TargetLandmarksSelector, Node::TargetLandmarksRole());
  this->bind(this->FittedSelector, Node::FittedRole());
  this->bind(this->SideBySideCheckBox, &Node::GetSideBySide, &Node::SetSideBySide);
  this->bind(this->ShowPreviewCheckBox, &Node::GetShowPreview, &Node::SetShowPreview);
  this->bind(this->ColorByQualityCheckBox, &Node::GetColorByQuality, &Node::SetColorByQuality);
  this->bind(this->AlphaSpinBox, &Node::GetAlpha, &Node::SetAlpha);
  this->bind(this->IterationsSpinBox, &Node::GetIterations, &Node::SetIterations);
  this->bind(this->LandmarkWeightSpinBox, &Node::GetLandmarkWeight, &Node::SetLandmarkWeight);
  this->onShow(
    [this] { this->ShowTableButton->setEnabled(this->Parameters->GetTableNode(Node::QualityTableRole()) != nullptr); });
}

void qSlicerTemplateHexMesherModuleWidgetPrivate::connectControls()
{
  Q_Q(qSlicerTemplateHexMesherModuleWidget);
  // The obstacle depends on which models exist; queued, because they are known only after the scene has changed.
  for (qMRMLNodeComboBox* selector : { this->TemplateSelector, this->TargetSelector })
  {
    QObject::connect(selector, SIGNAL(nodeAdded(vtkMRMLNode*)), q, SLOT(onInputChanged()), Qt::QueuedConnection);
    QObject::connect(selector, SIGNAL(nodeAboutToBeRemoved(vtkMRMLNode*)), q, SLOT(onInputChanged()),
                     Qt::QueuedConnection);
  }
  // The place mode must not change while Slicer handles the click that placed a point.
  for (qSlicerMarkupsPlaceWidget* place : { this->TemplatePlaceWidget, this->TargetPlaceWidget })
    QObject::connect(place, SIGNAL(activeMarkupsPlaceModeChanged(bool)), q, SLOT(followPlacing()),
                     Qt::QueuedConnection);
  QObject::connect(this->PlacePairsButton, &QPushButton::toggled, q, &Panel::placePairs);
  QObject::connect(this->RemoveLandmarkButton, &QPushButton::clicked, q, &Panel::removeLandmark);
  QObject::connect(this->LandmarkTable, &QTableWidget::itemSelectionChanged, q,
                   [this] { this->RemoveLandmarkButton->setEnabled(!this->LandmarkTable->selectedItems().isEmpty()); });
  QObject::connect(this->ShowTableButton, &QPushButton::clicked, q, &Panel::showTable);
  QObject::connect(this->RunWidget, &qSurgicalMesherRunWidget::applyRequested, q, &Panel::apply);
  QObject::connect(this->RunWidget, &qSurgicalMesherRunWidget::runEnded, q, &Panel::onRunEnded);
  this->DisplayTimer.setSingleShot(true);
  this->DisplayTimer.setInterval(50);
  QObject::connect(&this->DisplayTimer, &QTimer::timeout, q, &Panel::updateDisplay);
}

void qSlicerTemplateHexMesherModuleWidgetPrivate::showLandmarks()
{
  const std::vector<LandmarkRow> rows = this->logic()->GetLandmarks(this->Parameters);
  const auto length = [](double mm) { return mm < 0 ? QString() : QString::number(mm, 'f', 2); };
  const QSignalBlocker blocker(this->LandmarkTable);
  this->LandmarkTable->setRowCount(int(rows.size()));
  for (int row = 0; row < int(rows.size()); ++row)
  {
    const LandmarkRow& landmark = rows[std::size_t(row)];
    const QString where = landmark.onTemplate && landmark.onTarget ? Panel::tr("both")
                          : landmark.onTemplate                    ? Panel::tr("template")
                                                                   : Panel::tr("patient");
    const QString texts[] = { QString::fromStdString(landmark.name), where, length(landmark.leftOut),
                              length(landmark.fitted) };
    for (int column = 0; column < 4; ++column)
    {
      QTableWidgetItem* item = this->LandmarkTable->item(row, column);
      if (!item) this->LandmarkTable->setItem(row, column, item = new QTableWidgetItem);
      if (item->text() != texts[column]) item->setText(texts[column]);
    }
  }
  this->RemoveLandmarkButton->setEnabled(!this->LandmarkTable->selectedItems().isEmpty());
}

void qSlicerTemplateHexMesherModuleWidgetPrivate::showObstacle(const FitCheck& check)
{
  const PanelObstacle found = this->obstacle(check);
  if (found.sentence.isEmpty()) this->RunWidget->clearProblem();
  else this->RunWidget->setProblem(found.sentence, found.fixText, found.fix);
}

PanelObstacle qSlicerTemplateHexMesherModuleWidgetPrivate::nothingChosen(const QString& sentence,
                                                                         qMRMLNodeComboBox* selector)
{
  for (int n = 0; n < selector->nodeCount(); ++n)
  {
    vtkMRMLNode* node = selector->nodeFromIndex(n);
    if (node == this->TemplateSelector->currentNode() || node == this->TargetSelector->currentNode()) continue;
    const QPointer<qMRMLNodeComboBox> where(selector);
    return { sentence, Panel::tr("Choose %1").arg(node->GetName()),
             [where, id = std::string(node->GetID())]
             {
               if (where) where->setCurrentNodeID(QString::fromStdString(id));
             } };
  }
  return { sentence, Panel::tr("Add data..."),
           [] { qSlicerApplication::application()->ioManager()->openAddDataDialog(); } };
}

PanelObstacle qSlicerTemplateHexMesherModuleWidgetPrivate::obstacle(const FitCheck& check)
{
  const QString name = QString::fromStdString(check.name);
  switch (check.problem)
  {
  case FitCheck::NoModule:
    return { Panel::tr("The command-line module %1 isn't loaded; see the application's log.").arg(name), {}, {} };
  case FitCheck::NoTemplate:
    return this->nothingChosen(Panel::tr("Choose a template: a mesh of hexahedra, or a surface."),
                               this->TemplateSelector);
  case FitCheck::NoTarget: return this->nothingChosen(Panel::tr("Choose the patient's surface."), this->TargetSelector);
  case FitCheck::SameModel:
    return { Panel::tr("The model %1 is both the template and the patient.").arg(name), {}, {} };
  case FitCheck::NoCells: return { Panel::tr("The model %1 is empty; choose another one.").arg(name), {}, {} };
  case FitCheck::NoLandmarks:
    return { Panel::tr("Place pairs of landmarks: a point on the template, the same on the patient, and so on."),
             Panel::tr("Place pairs"), [this] { this->PlacePairsButton->setChecked(true); } };
  case FitCheck::SameList:
    return { Panel::tr("The list %1 holds both the template's and the patient's landmarks.").arg(name), {}, {} };
  case FitCheck::Refused: return { Panel::tr("The input can't be used: %1.").arg(name), {}, {} };
  default: return {};
  }
}

//-----------------------------------------------------------------------------
qSlicerTemplateHexMesherModuleWidget::qSlicerTemplateHexMesherModuleWidget(QWidget* parent)
  : Superclass(parent), d_ptr(new qSlicerTemplateHexMesherModuleWidgetPrivate(*this))
{
}

qSlicerTemplateHexMesherModuleWidget::~qSlicerTemplateHexMesherModuleWidget() { this->qvtkDisconnectAll(); }

void qSlicerTemplateHexMesherModuleWidget::setup()
{
  Q_D(qSlicerTemplateHexMesherModuleWidget);
  d->setupUi(this);
  this->Superclass::setup();
  d->LandmarkTable->horizontalHeader()->setSectionResizeMode(QHeaderView::Stretch);
  d->setupPlacing(d->TemplateLandmarksSelector, d->TemplatePlaceWidget);
  d->setupPlacing(d->TargetLandmarksSelector, d->TargetPlaceWidget);
  d->bindControls();
  d->connectControls();
  d->RunWidget->setRun(d->logic()->GetRun());
}

void qSlicerTemplateHexMesherModuleWidget::enter()
{
  Q_D(qSlicerTemplateHexMesherModuleWidget);
  this->Superclass::enter();
  d->setParameterNode(d->logic()->ParameterNode());
}

void qSlicerTemplateHexMesherModuleWidget::exit()
{
  Q_D(qSlicerTemplateHexMesherModuleWidget);
  d->PlacePairsButton->setChecked(false);
  for (qSlicerMarkupsPlaceWidget* place : { d->TemplatePlaceWidget, d->TargetPlaceWidget })
    place->setPlaceModeEnabled(false);
  d->DisplayTimer.stop();
  this->Superclass::exit();
}

bool qSlicerTemplateHexMesherModuleWidget::setEditedNode(vtkMRMLNode* node, QString role, QString context)
{
  Q_D(qSlicerTemplateHexMesherModuleWidget);
  if (auto* parameters = vtkMRMLTemplateHexMesherNode::SafeDownCast(node))
  {
    d->setParameterNode(parameters);
    return true;
  }
  if (!d->Parameters) d->setParameterNode(d->logic()->ParameterNode());
  if (!d->Parameters) return false;
  const char* target = nullptr;
  if (vtkMRMLModelNode::SafeDownCast(node)) target = Node::TemplateRole();
  else if (vtkMRMLMarkupsFiducialNode::SafeDownCast(node)) target = Node::TemplateLandmarksRole();
  if (!target) return this->Superclass::setEditedNode(node, role, context);
  d->Parameters->SetNode(target, node);
  return true;
}

void qSlicerTemplateHexMesherModuleWidget::setMRMLScene(vtkMRMLScene* scene)
{
  for (const unsigned long event : { vtkMRMLScene::EndImportEvent, vtkMRMLScene::EndBatchProcessEvent,
                                     vtkMRMLScene::EndCloseEvent, vtkMRMLScene::EndRestoreEvent })
  {
    this->qvtkReconnect(this->mrmlScene(), scene, event, this, SLOT(onSceneReplaced()));
  }
  this->Superclass::setMRMLScene(scene);
  this->onSceneReplaced();
}

void qSlicerTemplateHexMesherModuleWidget::onSceneReplaced()
{
  Q_D(qSlicerTemplateHexMesherModuleWidget);
  vtkMRMLScene* scene = this->mrmlScene();
  if (scene && scene->IsBatchProcessing()) return;
  vtkMRMLNode* node = scene ? scene->GetFirstNodeByClass("vtkMRMLTemplateHexMesherNode") : nullptr;
  if (!node && scene && this->isEntered()) node = d->logic()->ParameterNode();
  d->setParameterNode(vtkMRMLTemplateHexMesherNode::SafeDownCast(node));
}

void qSlicerTemplateHexMesherModuleWidget::updateFromNode()
{
  Q_D(qSlicerTemplateHexMesherModuleWidget);
  this->setEnabled(d->Parameters != nullptr);
  if (!d->Parameters) return;
  d->show();
  this->onInputChanged();
}

void qSlicerTemplateHexMesherModuleWidget::onInputChanged()
{
  Q_D(qSlicerTemplateHexMesherModuleWidget);
  if (!d->Parameters || !this->isEntered()) return; // enter() catches up
  surgicalmesher::nameNextLandmarks(d->onTemplate(), d->onTarget());
  d->showLandmarks();
  d->showObstacle(d->logic()->FindProblem(d->Parameters));
  if (!d->DisplayTimer.isActive()) d->DisplayTimer.start();
  if (d->Placing) QTimer::singleShot(0, this, &Panel::followPlacing);
}

void qSlicerTemplateHexMesherModuleWidget::updateDisplay()
{
  Q_D(qSlicerTemplateHexMesherModuleWidget);
  if (!d->Parameters || !this->isEntered()) return;
  if (d->logic()->GetRun()->IsStarting()) return d->DisplayTimer.start(); // retries after the start
  d->logic()->UpdateDisplay(d->Parameters);
}

//-----------------------------------------------------------------------------
void qSlicerTemplateHexMesherModuleWidget::placePairs(bool isOn)
{
  Q_D(qSlicerTemplateHexMesherModuleWidget);
  if (!isOn)
  {
    if (d->Placing) d->Placing->setPlaceModeEnabled(false);
    d->Placing = nullptr;
    return;
  }
  for (qMRMLNodeComboBox* selector : { d->TemplateLandmarksSelector, d->TargetLandmarksSelector })
  {
    if (!selector->currentNode()) selector->addNode();
  }
  d->Placing = d->TargetPlaceWidget; // the opposite of the list that starts: followPlacing() switches
  if (surgicalmesher::isTurnOfTarget(d->onTemplate(), d->onTarget())) d->Placing = d->TemplatePlaceWidget;
  this->followPlacing();
}

void qSlicerTemplateHexMesherModuleWidget::followPlacing()
{
  Q_D(qSlicerTemplateHexMesherModuleWidget);
  if (!d->Placing || !d->Parameters) return;
  const bool isTarget = surgicalmesher::isTurnOfTarget(d->onTemplate(), d->onTarget());
  qSlicerMarkupsPlaceWidget* next = isTarget ? d->TargetPlaceWidget : d->TemplatePlaceWidget;
  if (next == d->Placing)
  {
    if (!next->placeModeEnabled()) d->PlacePairsButton->setChecked(false); // the user has ended the placing
    return;
  }
  qSlicerMarkupsPlaceWidget* before = d->Placing;
  d->Placing = next;
  before->setPlaceModeEnabled(false);
  next->setCurrentNode(isTarget ? d->onTarget() : d->onTemplate());
  next->setPlaceModeEnabled(true);
}

void qSlicerTemplateHexMesherModuleWidget::removeLandmark()
{
  Q_D(qSlicerTemplateHexMesherModuleWidget);
  const int row = d->LandmarkTable->currentRow();
  if (!d->Parameters || row < 0) return;
  surgicalmesher::removeLandmark(d->LandmarkTable->item(row, 0)->text().toStdString(), d->onTemplate(), d->onTarget());
}

void qSlicerTemplateHexMesherModuleWidget::apply()
{
  Q_D(qSlicerTemplateHexMesherModuleWidget);
  if (!d->Parameters) return;
  d->PlacePairsButton->setChecked(false);
  const FitCheck check = d->logic()->Start(d->Parameters);
  if (check.problem != FitCheck::None) d->showObstacle(check);
}

void qSlicerTemplateHexMesherModuleWidget::onRunEnded()
{
  Q_D(qSlicerTemplateHexMesherModuleWidget);
  vtkSurgicalMesherRun* run = d->logic()->GetRun();
  if (run->GetStatus() != vtkSurgicalMesherRun::Completed || !d->Parameters) return;
  const surgicalmesher::FitSummary found = d->logic()->GetFound(d->Parameters);
  QString sentence = tr("Fitted in %1 s, %2 mm from the patient on average.")
                       .arg(run->GetElapsedSeconds(), 0, 'f', 1)
                       .arg(found.toTarget, 0, 'f', 2);
  if (found.elements > 0)
    sentence += " " + tr("%1 elements, %2 invalid, scaled Jacobian at least %3.")
                        .arg(found.elements)
                        .arg(found.invalid)
                        .arg(found.minimum, 0, 'f', 3);
  if (found.turnedFacets > 0) sentence += " " + tr("%1 facets are turned over.").arg(found.turnedFacets);
  d->RunWidget->setResult(sentence);
  this->onInputChanged();
}

void qSlicerTemplateHexMesherModuleWidget::showTable()
{
  Q_D(qSlicerTemplateHexMesherModuleWidget);
  vtkMRMLTableNode* table = d->Parameters ? d->Parameters->GetTableNode(Node::QualityTableRole()) : nullptr;
  auto* layout = vtkMRMLLayoutNode::SafeDownCast(this->mrmlScene()->GetFirstNodeByClass("vtkMRMLLayoutNode"));
  vtkSlicerApplicationLogic* application = d->logic()->GetApplicationLogic();
  if (!table || !layout || !application) return;
  layout->SetViewArrangement(vtkSlicerTablesLogic::GetLayoutWithTable(layout->GetViewArrangement()));
  application->GetSelectionNode()->SetActiveTableID(table->GetID());
  application->PropagateTableSelection();
}
