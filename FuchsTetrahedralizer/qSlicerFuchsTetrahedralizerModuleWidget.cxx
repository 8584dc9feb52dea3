// SPDX-License-Identifier: Apache-2.0
#include "qSlicerFuchsTetrahedralizerModuleWidget.h"
#include "ui_qSlicerFuchsTetrahedralizerModuleWidget.h"

#include "ParameterPanel.h"
#include "RunAdvice.h"
#include "vtkMRMLFuchsTetrahedralizerNode.h"
#include "vtkSlicerFuchsTetrahedralizerLogic.h"
#include "vtkSurgicalMesherRun.h"

#include <qMRMLThreeDView.h>
#include <qMRMLThreeDWidget.h>
#include <qSlicerApplication.h>
#include <qSlicerLayoutManager.h>
#include <vtkSlicerApplicationLogic.h>
#include <vtkSlicerPlotsLogic.h>
#include <vtkSlicerTablesLogic.h>

#include <vtkMRMLLayoutNode.h>
#include <vtkMRMLMarkupsNode.h>
#include <vtkMRMLModelNode.h>
#include <vtkMRMLPlotChartNode.h>
#include <vtkMRMLScalarVolumeNode.h>
#include <vtkMRMLScene.h>
#include <vtkMRMLSelectionNode.h>
#include <vtkMRMLSliceNode.h>
#include <vtkMRMLTableNode.h>
#include <vtkMRMLTransformableNode.h>
#include <vtkTable.h>
#include <vtkWeakPointer.h>

#include <QFileDialog>
#include <QFileInfo>
#include <QGuiApplication>
#include <QLocale>
#include <QSignalBlocker>
#include <QTimer>

#include <vector>

using Node = vtkMRMLFuchsTetrahedralizerNode;
using Logic = vtkSlicerFuchsTetrahedralizerLogic;

class qSlicerFuchsTetrahedralizerModuleWidgetPrivate : public Ui_qSlicerFuchsTetrahedralizerModuleWidget,
                                                       public surgicalmesher::ParameterPanel<Node>
{
  Q_DECLARE_PUBLIC(qSlicerFuchsTetrahedralizerModuleWidget)

public:
  explicit qSlicerFuchsTetrahedralizerModuleWidgetPrivate(qSlicerFuchsTetrahedralizerModuleWidget& object)
    : q_ptr(&object)
  {
  }

  Logic* logic() const;
  vtkMRMLModelNode* mesh() const;
  void setNode(Node* node);

  void bindInputs();
  void bindParameters();
  void bindDisplay();
  void bindButtons();

  void observeInputs();
  void updateDisplay();
  void updateSurface();
  void updateMarkups();
  void updateMesh();
  void updateProblem();
  QString summaryOfMesh() const;
  void say(const QString& sentence, bool isError = false);

  std::vector<vtkWeakPointer<vtkMRMLNode>> Inputs; ///< observed
  vtkWeakPointer<vtkMRMLSliceNode> Slice;          ///< moved by the clip slider
  bool IsMeshNew = false;                          ///< the run is to create it

protected:
  qSlicerFuchsTetrahedralizerModuleWidget* const q_ptr;
};

Logic* qSlicerFuchsTetrahedralizerModuleWidgetPrivate::logic() const
{
  Q_Q(const qSlicerFuchsTetrahedralizerModuleWidget);
  return Logic::SafeDownCast(q->logic());
}

vtkMRMLModelNode* qSlicerFuchsTetrahedralizerModuleWidgetPrivate::mesh() const
{
  vtkMRMLModelNode* mesh = this->Parameters ? this->Parameters->GetModelNode(Node::MeshRole()) : nullptr;
  return Logic::IsMesh(mesh) ? mesh : nullptr;
}

void qSlicerFuchsTetrahedralizerModuleWidgetPrivate::setNode(Node* node)
{
  Q_Q(qSlicerFuchsTetrahedralizerModuleWidget);
  q->qvtkReconnect(this->Parameters, node, vtkCommand::ModifiedEvent, q, SLOT(updateFromNode()));
  this->Parameters = node;
  q->updateFromNode();
}

// ---- controls and node ----------------------------------------------------------------------------------------------

void qSlicerFuchsTetrahedralizerModuleWidgetPrivate::bindInputs()
{
  for (qMRMLNodeComboBox* box : std::initializer_list<qMRMLNodeComboBox*>{ this->TargetComboBox, this->PathComboBox })
  {
    QObject::connect(box, &qMRMLNodeComboBox::nodeAdded, q_ptr, [this] { this->updateMarkups(); });
    QObject::connect(box, &qMRMLNodeComboBox::nodeAboutToBeRemoved, q_ptr,
                     [this] { QTimer::singleShot(0, this->q_ptr, [this] { this->updateMarkups(); }); });
  }
  this->bind(this->SurfaceComboBox, Node::SurfaceRole());
  this->bind(this->UseAmbientCheckBox, &Node::GetUseAmbient, &Node::SetUseAmbient);
  this->bind(this->EdgeLengthSourceComboBox, &Node::GetEdgeLengthSource, &Node::SetEdgeLengthSource);
  this->bind(this->ScaleComboBox, Node::ScaleRole());
  this->bind(this->EdgeLengthSlider, &Node::GetEdgeLength, &Node::SetEdgeLength);
  this->bind(this->MeshComboBox, Node::MeshRole());
  this->bind(this->ParentMeshComboBox, Node::ParentMeshRole());
  this->bind(this->ChildMeshComboBox, Node::ChildMeshRole());
  this->bind(this->ShellsComboBox, Node::ShellsRole());
}

void qSlicerFuchsTetrahedralizerModuleWidgetPrivate::bindParameters()
{
  this->bind(this->ShellTissuesLineEdit, &QLineEdit::textChanged, &Node::GetShellTissues, &Node::SetShellTissues);
  this->bind(this->ShellThicknessSlider, &Node::GetShellThickness, &Node::SetShellThickness);
  this->bind(this->MaterialsPathLineEdit, &Node::GetMaterialsFile, &Node::SetMaterialsFile);
  this->bind(this->TargetComboBox, Node::TargetRole());
  this->bind(this->PathComboBox, Node::PathRole());
  this->bind(this->NonlinearDistanceSlider, &Node::GetNonlinearDistance, &Node::SetNonlinearDistance);
  this->bind(this->NonlinearDistanceAtTargetSlider, &Node::GetNonlinearDistanceAtTarget,
             &Node::SetNonlinearDistanceAtTarget);
  this->bind(this->NullDisplacementRadiusSlider, &Node::GetNullDisplacementRadius, &Node::SetNullDisplacementRadius);
  this->bind(this->NullDisplacementPathDistanceSlider, &Node::GetNullDisplacementPathDistance,
             &Node::SetNullDisplacementPathDistance);
  this->bind(this->NullDisplacementPathDistanceAtTargetSlider, &Node::GetNullDisplacementPathDistanceAtTarget,
             &Node::SetNullDisplacementPathDistanceAtTarget);
  this->bind(this->ConditioningCheckBox, &Node::GetConditioning, &Node::SetConditioning);
  this->bind(this->FeatureAngleSlider, &Node::GetFeatureAngle, &Node::SetFeatureAngle);
  this->bind(this->ExportElementsComboBox, &Node::GetExportElements, &Node::SetExportElements);
  this->bind(this->ExportUnitsComboBox, &Node::GetExportUnits, &Node::SetExportUnits);
  this->bind(this->ThreadsSpinBox, &Node::GetThreads, &Node::SetThreads);
}

void qSlicerFuchsTetrahedralizerModuleWidgetPrivate::bindDisplay()
{
  this->bind(this->ColorComboBox, &Node::GetColorBy, &Node::SetColorBy);
  this->bind(this->ShowEdgesCheckBox, &Node::GetShowEdges, &Node::SetShowEdges);
  this->bind(this->ClipPlaneComboBox, &Node::GetClipPlane, &Node::SetClipPlane);
  this->bind(this->ClipFlippedCheckBox, &Node::GetClipFlipped, &Node::SetClipFlipped);
  // Connected after bind(), so that the node already has the values.
  const auto update = [this] { this->updateDisplay(); };
  for (QComboBox* box : { this->ColorComboBox, this->ClipPlaneComboBox })
    QObject::connect(box, QOverload<int>::of(&QComboBox::currentIndexChanged), q_ptr, update);
  for (QCheckBox* box : { this->ShowEdgesCheckBox, this->ClipFlippedCheckBox })
    QObject::connect(box, &QCheckBox::toggled, q_ptr, update);
  QObject::connect(this->ClipSlider, &ctkSliderWidget::valueChanged, q_ptr,
                   [this](double offset)
                   {
                     if (this->Slice) this->Slice->SetSliceOffset(offset);
                   });
}

void qSlicerFuchsTetrahedralizerModuleWidgetPrivate::bindButtons()
{
  Q_Q(qSlicerFuchsTetrahedralizerModuleWidget);
  using Panel = qSlicerFuchsTetrahedralizerModuleWidget;
  QObject::connect(this->ShowHistogramButton, &QPushButton::clicked, q, &Panel::showHistogram);
  QObject::connect(this->ShowTableButton, &QPushButton::clicked, q, &Panel::showTable);
  QObject::connect(this->AssessButton, &QPushButton::clicked, q, &Panel::onAssess);
  QObject::connect(this->ExportButton, &QPushButton::clicked, q, &Panel::onExport);
  QObject::connect(this->RunWidget, &qSurgicalMesherRunWidget::applyRequested, q, &Panel::apply);
  QObject::connect(this->RunWidget, &qSurgicalMesherRunWidget::runEnded, q, &Panel::onRunEnded);
}

/// Inputs are not observed through the node's references: Slicer warns when a node observed in this way has a second
/// role, even an unsuitable one.
void qSlicerFuchsTetrahedralizerModuleWidgetPrivate::observeInputs()
{
  Q_Q(qSlicerFuchsTetrahedralizerModuleWidget);
  const unsigned long events[] = { vtkCommand::ModifiedEvent,
                                   vtkMRMLModelNode::MeshModifiedEvent,
                                   vtkMRMLVolumeNode::ImageDataModifiedEvent,
                                   vtkMRMLTransformableNode::TransformModifiedEvent,
                                   vtkMRMLMarkupsNode::PointPositionDefinedEvent,
                                   vtkMRMLMarkupsNode::PointRemovedEvent };
  std::vector<vtkWeakPointer<vtkMRMLNode>> inputs;
  for (const char* role : { Node::SurfaceRole(), Node::ScaleRole(), Node::TargetRole(), Node::PathRole() })
  {
    if (!this->Parameters) break;
    for (vtkMRMLNode* node : this->Parameters->GetNodes(role)) inputs.emplace_back(node);
  }
  if (inputs == this->Inputs) return;
  for (vtkMRMLNode* node : this->Inputs)
    for (const unsigned long event : events) q->qvtkDisconnect(node, event, q, SLOT(updateFromNode()));
  for (vtkMRMLNode* node : inputs)
    for (const unsigned long event : events) q->qvtkConnect(node, event, q, SLOT(updateFromNode()));
  this->Inputs = inputs;
}

// ---- what the panel says --------------------------------------------------------------------------------------------

void qSlicerFuchsTetrahedralizerModuleWidgetPrivate::updateDisplay()
{
  Q_Q(qSlicerFuchsTetrahedralizerModuleWidget);
  if (!this->mesh()) return;
  const bool isColored = this->logic()->UpdateDisplay(this->Parameters);
  this->say(isColored ? QString() : q->tr("This mesh does not tell what the colours stand for."), true);
  q->updateClipSlider();
}

void qSlicerFuchsTetrahedralizerModuleWidgetPrivate::updateSurface()
{
  Q_Q(qSlicerFuchsTetrahedralizerModuleWidget);
  const Logic::Surface surface = this->logic()->DescribeSurface(this->Parameters);
  const QLocale locale;
  QString text;
  if (surface.isLabelled)
    text = q->tr("%1 triangles, %2 tissues").arg(locale.toString(qlonglong(surface.triangles))).arg(surface.tissues);
  else if (surface.triangles > 0)
    text = q->tr("%1 triangles; each closed shell becomes a tissue").arg(locale.toString(qlonglong(surface.triangles)));
  this->SurfaceInfoLabel->setText(text);
  this->SurfaceInfoLabel->setVisible(!text.isEmpty());
  this->UseAmbientCheckBox->setVisible(surface.ambient != nullptr);
  const int source = this->Parameters->GetEdgeLengthSource();
  for (QWidget* widget :
       { static_cast<QWidget*>(this->ScaleComboBox), static_cast<QWidget*>(this->ScaleComboBoxLabel) })
    widget->setVisible(source == Node::FromScale);
  for (QWidget* widget :
       { static_cast<QWidget*>(this->EdgeLengthSlider), static_cast<QWidget*>(this->EdgeLengthSliderLabel) })
    widget->setVisible(source == Node::Uniform);
}

/// A box without nodes would claim that all of them are chosen.
void qSlicerFuchsTetrahedralizerModuleWidgetPrivate::updateMarkups()
{
  const std::pair<qMRMLNodeComboBox*, QLabel*> boxes[] = { { this->TargetComboBox, this->NoTargetLabel },
                                                           { this->PathComboBox, this->NoPathLabel } };
  for (const auto& [box, label] : boxes)
  {
    box->setVisible(box->nodeCount() > 0);
    label->setVisible(box->nodeCount() == 0);
  }
}

void qSlicerFuchsTetrahedralizerModuleWidgetPrivate::updateMesh()
{
  Q_Q(qSlicerFuchsTetrahedralizerModuleWidget);
  const bool isBusy = this->logic()->GetRun()->IsBusy();
  vtkMRMLModelNode* mesh = this->mesh();
  for (QWidget* widget : std::initializer_list<QWidget*>{ this->ColorComboBox, this->ShowEdgesCheckBox,
                                                          this->ClipPlaneComboBox, this->ClipFlippedCheckBox })
    widget->setEnabled(mesh != nullptr);
  this->AssessButton->setEnabled(mesh && !isBusy);
  this->ExportButton->setEnabled(mesh && !isBusy);
  this->ShowTableButton->setEnabled(Logic::GetQualityTable(mesh) != nullptr);
  const bool hasHistogram = Logic::GetHistogram(mesh, 0) != nullptr;
  this->HistogramComboBox->setEnabled(hasHistogram);
  this->ShowHistogramButton->setEnabled(hasHistogram);
  q->updateClipSlider();
}

void qSlicerFuchsTetrahedralizerModuleWidgetPrivate::updateProblem()
{
  const Logic::Check check = this->logic()->FindProblem(this->Parameters);
  if (check.problem == Logic::Problem::None)
  {
    this->RunWidget->clearProblem();
    return;
  }
  const Advice advice = adviceOn(check, this->logic());
  this->RunWidget->setProblem(advice.sentence, advice.fixText,
                              [this, fix = advice.fix]
                              {
                                if (this->Parameters && fix) fix(this->Parameters);
                              });
}

/// Returns size and worst angles of the mesh, from the first row of the quality table, which is the whole mesh.
QString qSlicerFuchsTetrahedralizerModuleWidgetPrivate::summaryOfMesh() const
{
  Q_Q(const qSlicerFuchsTetrahedralizerModuleWidget);
  vtkMRMLTableNode* table = Logic::GetQualityTable(this->mesh());
  if (!table || table->GetNumberOfRows() == 0) return {};
  const auto value = [table](int column) { return table->GetTable()->GetValue(0, column).ToDouble(); };
  const QLocale locale;
  return q->tr("%1 tetrahedra, %2 points, dihedral angles from %3 to %4 degrees.")
    .arg(locale.toString(qlonglong(value(1))), locale.toString(qlonglong(value(2))), locale.toString(value(4), 'f', 1),
         locale.toString(value(5), 'f', 1));
}

void qSlicerFuchsTetrahedralizerModuleWidgetPrivate::say(const QString& sentence, bool isError)
{
  this->MeshInfoLabel->setText(isError && !sentence.isEmpty()
                                 ? QString("<font color=\"#b2182b\">%1</font>").arg(sentence.toHtmlEscaped())
                                 : sentence.toHtmlEscaped());
  this->MeshInfoLabel->setVisible(!sentence.isEmpty());
}

// ---- the panel ------------------------------------------------------------------------------------------------------

qSlicerFuchsTetrahedralizerModuleWidget::qSlicerFuchsTetrahedralizerModuleWidget(QWidget* parent)
  : Superclass(parent), d_ptr(new qSlicerFuchsTetrahedralizerModuleWidgetPrivate(*this))
{
}

qSlicerFuchsTetrahedralizerModuleWidget::~qSlicerFuchsTetrahedralizerModuleWidget() = default;

void qSlicerFuchsTetrahedralizerModuleWidget::setup()
{
  Q_D(qSlicerFuchsTetrahedralizerModuleWidget);
  d->setupUi(this);
  this->Superclass::setup();
  d->bindInputs();
  d->bindParameters();
  d->bindDisplay();
  d->bindButtons();
  d->RunWidget->setRun(d->logic()->GetRun());
  d->say({});
}

void qSlicerFuchsTetrahedralizerModuleWidget::setMRMLScene(vtkMRMLScene* scene)
{
  Q_D(qSlicerFuchsTetrahedralizerModuleWidget);
  this->qvtkReconnect(this->mrmlScene(), scene, vtkMRMLScene::EndCloseEvent, this, SLOT(onSceneClosed()));
  this->qvtkReconnect(this->mrmlScene(), scene, vtkMRMLScene::EndImportEvent, this, SLOT(onSceneImported()));
  this->Superclass::setMRMLScene(scene);
  vtkMRMLNode* node = scene ? scene->GetFirstNodeByClass("vtkMRMLFuchsTetrahedralizerNode") : nullptr;
  d->setNode(vtkMRMLFuchsTetrahedralizerNode::SafeDownCast(node));
}

void qSlicerFuchsTetrahedralizerModuleWidget::enter()
{
  Q_D(qSlicerFuchsTetrahedralizerModuleWidget);
  this->Superclass::enter();
  if (d->Parameters) this->updateFromNode();
  else d->setNode(d->logic()->ParameterNode());
}

bool qSlicerFuchsTetrahedralizerModuleWidget::setEditedNode(vtkMRMLNode* node, QString, QString)
{
  Q_D(qSlicerFuchsTetrahedralizerModuleWidget);
  auto* parameters = vtkMRMLFuchsTetrahedralizerNode::SafeDownCast(node);
  if (!parameters) return false;
  d->setNode(parameters);
  return true;
}

void qSlicerFuchsTetrahedralizerModuleWidget::onSceneClosed()
{
  Q_D(qSlicerFuchsTetrahedralizerModuleWidget);
  d->say({});
  d->setNode(this->isEntered() ? d->logic()->ParameterNode() : nullptr);
}

void qSlicerFuchsTetrahedralizerModuleWidget::onSceneImported()
{
  Q_D(qSlicerFuchsTetrahedralizerModuleWidget);
  vtkMRMLNode* node = this->mrmlScene()->GetFirstNodeByClass("vtkMRMLFuchsTetrahedralizerNode");
  if (node || !this->isEntered()) d->setNode(vtkMRMLFuchsTetrahedralizerNode::SafeDownCast(node));
}

void qSlicerFuchsTetrahedralizerModuleWidget::updateFromNode()
{
  Q_D(qSlicerFuchsTetrahedralizerModuleWidget);
  for (QWidget* section : { d->InputsCollapsibleButton, d->OutputsCollapsibleButton, d->FiniteElementsCollapsibleButton,
                            d->ClassesCollapsibleButton, d->MeshCollapsibleButton, d->AdvancedCollapsibleButton })
    section->setEnabled(d->Parameters != nullptr);
  d->observeInputs();
  if (!d->Parameters || !this->isEntered() || this->mrmlScene()->IsBatchProcessing()) return;
  d->show();
  d->updateSurface();
  d->updateMarkups();
  d->updateMesh();
  d->updateProblem();
}

void qSlicerFuchsTetrahedralizerModuleWidget::updateClipSlider()
{
  Q_D(qSlicerFuchsTetrahedralizerModuleWidget);
  double range[2] = { -100, 100 };
  const bool clips = d->Parameters && d->logic()->GetClipRange(d->Parameters, range);
  vtkMRMLSliceNode* slice = clips ? d->logic()->GetClipSlice(d->Parameters) : nullptr;
  this->qvtkReconnect(d->Slice, slice, vtkCommand::ModifiedEvent, this, SLOT(updateClipSlider()));
  d->Slice = slice;
  d->ClipSlider->setEnabled(slice != nullptr);
  if (!slice) return;
  const QSignalBlocker blocker(d->ClipSlider);
  d->ClipSlider->setRange(range[0], range[1]);
  d->ClipSlider->setValue(slice->GetSliceOffset());
}

void qSlicerFuchsTetrahedralizerModuleWidget::apply()
{
  Q_D(qSlicerFuchsTetrahedralizerModuleWidget);
  if (!d->Parameters) return;
  d->say({});
  d->IsMeshNew = !d->Parameters->GetModelNode(vtkMRMLFuchsTetrahedralizerNode::MeshRole());
  const bool isStarted = d->logic()->Start(d->Parameters);
  this->updateFromNode();
  const QString failure = QString::fromStdString(d->logic()->GetRun()->GetErrorText());
  if (!isStarted && d->RunWidget->problem().isEmpty() && !failure.isEmpty()) d->RunWidget->setProblem(failure);
}

void qSlicerFuchsTetrahedralizerModuleWidget::onRunEnded()
{
  Q_D(qSlicerFuchsTetrahedralizerModuleWidget);
  this->updateFromNode();
  if (d->logic()->GetRun()->GetStatus() != vtkSurgicalMesherRun::Completed) return;
  d->RunWidget->setResult(d->summaryOfMesh());
  qSlicerLayoutManager* layout = qSlicerApplication::application()->layoutManager();
  if (d->IsMeshNew && layout && layout->threeDViewCount() > 0) layout->threeDWidget(0)->threeDView()->resetFocalPoint();
}

bool qSlicerFuchsTetrahedralizerModuleWidget::exportMesh(const QString& file)
{
  Q_D(qSlicerFuchsTetrahedralizerModuleWidget);
  if (!d->Parameters) return false;
  QGuiApplication::setOverrideCursor(Qt::WaitCursor);
  const std::string failure = d->logic()->Export(d->Parameters, file.toStdString());
  QGuiApplication::restoreOverrideCursor();
  if (failure.empty()) d->say(tr("Written: %1, and the names of its sets beside it.").arg(QFileInfo(file).fileName()));
  else d->say(tr("Not exported: %1").arg(QString::fromStdString(failure)), true);
  return failure.empty();
}

void qSlicerFuchsTetrahedralizerModuleWidget::onExport()
{
  Q_D(qSlicerFuchsTetrahedralizerModuleWidget);
  if (!d->mesh()) return;
  QStringList filters;
  QString filter;
  for (const Logic::Format& format : Logic::GetExportFormats())
  {
    filters
      << QString("%1 (*%2)").arg(QString::fromStdString(format.description), QString::fromStdString(format.extension));
    if (format.extension == ".inp") filter = filters.last(); // chosen at first
  }
  QString file = QFileDialog::getSaveFileName(this, tr("Export tetrahedra"), QString::fromUtf8(d->mesh()->GetName()),
                                              filters.join(";;"), &filter);
  if (file.isEmpty()) return;
  const QString extension = QString::fromStdString(Logic::GetExportFormats()[filters.indexOf(filter)].extension);
  if (!Logic::HasExportExtension(file.toStdString())) file += extension; // a name may have dots of its own
  this->exportMesh(file);
}

void qSlicerFuchsTetrahedralizerModuleWidget::onAssess()
{
  Q_D(qSlicerFuchsTetrahedralizerModuleWidget);
  if (!d->mesh()) return;
  QGuiApplication::setOverrideCursor(Qt::WaitCursor);
  const std::string failure = d->logic()->Assess(d->mesh());
  QGuiApplication::restoreOverrideCursor();
  if (failure.empty()) d->say(d->summaryOfMesh());
  else d->say(tr("Not assessed: %1").arg(QString::fromStdString(failure)), true);
  d->updateMesh();
}

void qSlicerFuchsTetrahedralizerModuleWidget::showHistogram()
{
  Q_D(qSlicerFuchsTetrahedralizerModuleWidget);
  vtkMRMLPlotChartNode* chart = Logic::GetHistogram(d->mesh(), d->HistogramComboBox->currentIndex());
  auto* plots = vtkSlicerPlotsLogic::SafeDownCast(d->logic()->GetModuleLogic("Plots"));
  if (chart && plots) plots->ShowChartInLayout(chart);
}

void qSlicerFuchsTetrahedralizerModuleWidget::showTable()
{
  Q_D(qSlicerFuchsTetrahedralizerModuleWidget);
  vtkMRMLTableNode* table = Logic::GetQualityTable(d->mesh());
  auto* layout = vtkMRMLLayoutNode::SafeDownCast(this->mrmlScene()->GetFirstNodeByClass("vtkMRMLLayoutNode"));
  vtkSlicerApplicationLogic* application = d->logic()->GetApplicationLogic();
  if (!table || !layout || !application) return;
  layout->SetViewArrangement(vtkSlicerTablesLogic::GetLayoutWithTable(layout->GetViewArrangement()));
  application->GetSelectionNode()->SetActiveTableID(table->GetID());
  application->PropagateTableSelection();
}
