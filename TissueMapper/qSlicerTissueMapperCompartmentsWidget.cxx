// SPDX-License-Identifier: Apache-2.0
#include "qSlicerTissueMapperCompartmentsWidget.h"

#include "MarkupsInput.h"
#include "ParameterPanel.h"
#include "TaskObstacle.h"
#include "ui_qSlicerTissueMapperCompartmentsWidget.h"
#include "vtkMRMLTissueMapperNode.h"
#include "vtkSlicerTissueMapperLogic.h"
#include "vtkSurgicalMesherRun.h"

#include <vtkMRMLMarkupsNode.h>
#include <vtkMRMLScalarVolumeNode.h>
#include <vtkMRMLTransformNode.h>

#include <vtkImageData.h>

#include <QTimer>

#include <string>
#include <tuple>
#include <vector>

using surgicalmesher::TaskCheck;
using Node = vtkMRMLTissueMapperNode;
using Logic = vtkSlicerTissueMapperLogic;

namespace
{

/// An image's node ID, and when its voxels and its place were last changed.
using ImageState = std::tuple<std::string, vtkMTimeType, vtkMTimeType>;

ImageState stateOf(vtkMRMLScalarVolumeNode* image)
{
  vtkImageData* voxels = image->GetImageData();
  vtkMRMLTransformNode* transform = image->GetParentTransformNode();
  return { image->GetID(), voxels ? voxels->GetMTime() : 0, transform ? transform->GetTransformToWorldMTime() : 0 };
}

/// Inputs of the compartments.
struct CompartmentInputs
{
  std::vector<ImageState> images;
  surgicalmesher::Markup points;
  std::string classes;
  bool correctBias = false, denoise = false;

  bool operator==(const CompartmentInputs& other) const
  {
    return images == other.images && points.points == other.points.points && points.labels == other.points.labels &&
           classes == other.classes && correctBias == other.correctBias && denoise == other.denoise;
  }
};

CompartmentInputs inputsOf(Node* parameters)
{
  CompartmentInputs inputs;
  for (vtkMRMLScalarVolumeNode* image : parameters->GetImages()) inputs.images.push_back(stateOf(image));
  inputs.points = surgicalmesher::labelledPoints(parameters->GetMarkupsNode(Node::TrainingRole()));
  inputs.classes = parameters->GetClasses();
  inputs.correctBias = parameters->GetCorrectBias();
  inputs.denoise = parameters->GetDenoise();
  return inputs;
}

} // namespace

class qSlicerTissueMapperCompartmentsWidgetPrivate : public Ui_qSlicerTissueMapperCompartmentsWidget,
                                                     public surgicalmesher::ParameterPanel<Node>
{
public:
  vtkWeakPointer<Logic> TheLogic;
  bool IsActive = false;
  /// Delays the run, so that dragging a point starts one run, not hundreds.
  QTimer Timer;
  CompartmentInputs FollowedInputs; ///< inputs of the last run

  void showObstacle(const TaskCheck& check);
};

void qSlicerTissueMapperCompartmentsWidgetPrivate::showObstacle(const TaskCheck& check)
{
  if (check.problem == TaskCheck::None) return this->CompartmentsRunWidget->clearProblem();
  this->CompartmentsRunWidget->setProblem(
    qSlicerTissueMapperCompartmentsWidget::tr("What the tissues need is missing; see above."));
}

//-----------------------------------------------------------------------------
qSlicerTissueMapperCompartmentsWidget::qSlicerTissueMapperCompartmentsWidget(QWidget* parent)
  : Superclass(parent), d_ptr(new qSlicerTissueMapperCompartmentsWidgetPrivate)
{
  Q_D(qSlicerTissueMapperCompartmentsWidget);
  d->setupUi(this);
  d->bind(d->CompartmentsSelector, Node::CompartmentsRole());
  d->bind(d->CompartmentsAtOnceCheckBox, &Node::GetCompartmentsAtOnce, &Node::SetCompartmentsAtOnce);
  d->onShow([d] { d->ShowTissuesButton->setEnabled(d->Parameters->GetNodeReference(Node::LabelMapRole())); });
  d->Timer.setSingleShot(true);
  d->Timer.setInterval(500);
  connect(&d->Timer, SIGNAL(timeout()), this, SLOT(followInputs()));
  connect(d->CompartmentsRunWidget, SIGNAL(applyRequested()), this, SLOT(find()));
  connect(d->CompartmentsRunWidget, SIGNAL(runEnded()), this, SLOT(onRunEnded()));
  connect(d->ShowTissuesButton, SIGNAL(clicked()), this, SLOT(showTissues()));
}

qSlicerTissueMapperCompartmentsWidget::~qSlicerTissueMapperCompartmentsWidget() { this->qvtkDisconnectAll(); }

void qSlicerTissueMapperCompartmentsWidget::setLogic(vtkSlicerTissueMapperLogic* logic)
{
  Q_D(qSlicerTissueMapperCompartmentsWidget);
  d->TheLogic = logic;
  d->CompartmentsRunWidget->setRun(logic->GetRun(Logic::FindCompartments));
}

void qSlicerTissueMapperCompartmentsWidget::setParameterNode(vtkMRMLTissueMapperNode* node)
{
  Q_D(qSlicerTissueMapperCompartmentsWidget);
  this->qvtkReconnect(d->Parameters, node, vtkCommand::ModifiedEvent, this, SLOT(updateFromNode()));
  this->qvtkReconnect(d->Parameters, node, Node::InputModifiedEvent, this, SLOT(onInputChanged()));
  d->Parameters = node;
  this->updateFromNode();
}

void qSlicerTissueMapperCompartmentsWidget::setActive(bool isActive)
{
  Q_D(qSlicerTissueMapperCompartmentsWidget);
  d->IsActive = isActive;
  if (isActive) return this->onInputChanged();
  d->Timer.stop();
}

void qSlicerTissueMapperCompartmentsWidget::updateFromNode()
{
  Q_D(qSlicerTissueMapperCompartmentsWidget);
  if (!d->Parameters) return;
  d->show();
  this->onInputChanged();
}

void qSlicerTissueMapperCompartmentsWidget::onInputChanged()
{
  Q_D(qSlicerTissueMapperCompartmentsWidget);
  if (!d->Parameters || !d->TheLogic || !d->IsActive) return; // setActive() catches up
  const TaskCheck check = d->TheLogic->FindProblem(Logic::FindCompartments, d->Parameters);
  d->showObstacle(check);
  const bool isAsked = check.problem == TaskCheck::None && d->Parameters->GetCompartmentsAtOnce();
  if (isAsked && !(inputsOf(d->Parameters) == d->FollowedInputs)) d->Timer.start();
}

void qSlicerTissueMapperCompartmentsWidget::followInputs()
{
  Q_D(qSlicerTissueMapperCompartmentsWidget);
  if (!d->Parameters || !d->TheLogic || !d->IsActive || !d->CompartmentsRunWidget->problem().isEmpty()) return;
  if (d->TheLogic->GetRun(Logic::FindCompartments)->IsBusy()) return d->Timer.start(); // retries after the current run
  this->find();
}

void qSlicerTissueMapperCompartmentsWidget::find()
{
  Q_D(qSlicerTissueMapperCompartmentsWidget);
  if (!d->Parameters || !d->TheLogic) return;
  d->FollowedInputs = inputsOf(d->Parameters);
  const TaskCheck check = d->TheLogic->Start(Logic::FindCompartments, d->Parameters);
  if (check.problem != TaskCheck::None) d->showObstacle(check);
}

void qSlicerTissueMapperCompartmentsWidget::showTissues()
{
  Q_D(qSlicerTissueMapperCompartmentsWidget);
  if (d->Parameters) d->TheLogic->ShowLabelMap(d->Parameters->GetNodeReference(Node::LabelMapRole()));
}

void qSlicerTissueMapperCompartmentsWidget::onRunEnded()
{
  Q_D(qSlicerTissueMapperCompartmentsWidget);
  vtkSurgicalMesherRun* run = d->CompartmentsRunWidget->run();
  if (run->GetStatus() != vtkSurgicalMesherRun::Completed || !d->Parameters) return;
  d->TheLogic->ShowLabelMap(d->Parameters->GetNodeReference(Node::CompartmentsRole()));
  d->CompartmentsRunWidget->setResult(tr("Found in %1 s.").arg(run->GetElapsedSeconds(), 0, 'f', 1));
}
