// SPDX-License-Identifier: Apache-2.0
#include "ClassificationTask.h"

#include "Errors.h"
#include "HostDifferences.h"
#include "MarkupsInput.h"
#include "TissueClassesIO.h"
#include "TissueColors.h"
#include "TissueMapIO.h"
#include "TissueMapInput.h"
#include "vtkMRMLTissueMapperNode.h"
#include "vtkSurgicalMesherRun.h"

#include <vtkMRMLLabelMapVolumeNode.h>
#include <vtkMRMLMarkupsNode.h>
#include <vtkMRMLScene.h>

#include <vtkImageData.h>
#include <vtkImageShrink3D.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtksys/SystemTools.hxx>

#include <algorithm>

namespace surgicalmesher
{

using Node = vtkMRMLTissueMapperNode;

namespace
{

constexpr const char* channelParameters[] = { "image", "channel", "channel2", "channel3" };

TaskCheck checkImages(const std::vector<vtkMRMLScalarVolumeNode*>& images)
{
  if (images.empty()) return { TaskCheck::NoImage, {} };
  for (vtkMRMLScalarVolumeNode* image : images)
  {
    const TaskCheck check = checkImage(image);
    if (check.problem != TaskCheck::None) return check;
    if (!isOnSameGrid(images.front(), image)) return { TaskCheck::OtherGrid, image->GetName() };
  }
  return {};
}

TaskCheck checkTraining(Node* parameters)
{
  vtkMRMLMarkupsNode* training = parameters->GetMarkupsNode(Node::TrainingRole());
  const Markup points = labelledPoints(training);
  if (points.points.empty()) return { TaskCheck::NoTraining, {} };
  const std::string classes = parameters->GetClasses();
  if (!classes.empty() && !vtksys::SystemTools::FileExists(classes, true)) return { TaskCheck::NoClassFile, classes };
  try
  {
    tissueClasses({ points }, training->GetName(), classes);
  }
  catch (const Error& error)
  {
    return { TaskCheck::Refused, error.what() };
  }
  return {};
}

/// Subsamples the volume to voxels of about 2 mm. Takes every second or third voxel, not means, which would mix the
/// brightnesses that thresholds have to separate.
vtkSmartPointer<vtkMRMLScalarVolumeNode> coarseCopyForRun(vtkMRMLScalarVolumeNode* volume)
{
  const auto copy = copyForRun(volume);
  vtkNew<vtkImageShrink3D> shrink;
  shrink->MeanOff();
  shrink->SetInputData(copy->GetImageData());
  vtkNew<vtkMatrix4x4> toWorld;
  copy->GetIJKToRASMatrix(toWorld);
  vtkNew<vtkMatrix4x4> toFine;
  int factors[3];
  for (int axis = 0; axis < 3; ++axis)
  {
    factors[axis] = std::max(1, int(2 / copy->GetSpacing()[axis] + 0.1));
    toFine->SetElement(axis, axis, factors[axis]);
  }
  shrink->SetShrinkFactors(factors);
  shrink->Update();
  vtkNew<vtkImageData> coarse;
  coarse->ShallowCopy(shrink->GetOutput());
  coarse->SetExtent(0, coarse->GetDimensions()[0] - 1, 0, coarse->GetDimensions()[1] - 1, 0,
                    coarse->GetDimensions()[2] - 1);
  coarse->SetOrigin(0, 0, 0);
  coarse->SetSpacing(1, 1, 1);
  copy->SetAndObserveImageData(coarse);
  vtkMatrix4x4::Multiply4x4(toWorld, toFine, toWorld);
  copy->SetIJKToRASMatrix(toWorld);
  return copy;
}

} // namespace

TaskCheck checkImage(vtkMRMLScalarVolumeNode* image)
{
  if (!image) return { TaskCheck::NoImage, {} };
  if (!image->GetImageData() || image->GetImageData()->GetNumberOfPoints() == 0)
    return { TaskCheck::NoVoxels, image->GetName() };
  if (isUnderWarp(image)) return { TaskCheck::UnderWarp, image->GetName() };
  return {};
}

TaskCheck ClassificationTask::findProblem(vtkMRMLTissueMapperNode* parameters)
{
  const TaskCheck images = checkImages(parameters->GetImages());
  return images.problem == TaskCheck::None ? checkTraining(parameters) : images;
}

void ClassificationTask::prepare(vtkMRMLTissueMapperNode* parameters)
{
  vtkSurgicalMesherRun* run = this->run();
  const std::vector<vtkMRMLScalarVolumeNode*> images = parameters->GetImages();
  for (std::size_t n = 0; n < images.size(); ++n)
  {
    const auto copy = m_Wanted == Compartments ? coarseCopyForRun(images[n]) : copyForRun(images[n]);
    run->AddTemporaryNode(copy);
    run->SetParameterNode(channelParameters[n], copy);
  }
  const std::string training = run->NewTemporaryFile(".mrk.json");
  writeLabelledMarkups({ labelledPoints(parameters->GetMarkupsNode(Node::TrainingRole())) }, training);
  run->SetParameter("training", training);
  run->SetParameter("classes", parameters->GetClasses());
  run->SetParameter("correctBias", parameters->GetCorrectBias());
  run->SetParameter("denoise", parameters->GetDenoise());
  run->SetParameter("noCompartments", m_Wanted == Tissues && !parameters->GetUseCompartments());
  run->SetParameter("noContiguity", !parameters->GetUseContiguity());
  run->SetParameter("noProximity", !parameters->GetUseProximity());
  m_NamesFile = run->NewTemporaryFile(".ctbl");
  run->SetParameter("names", m_NamesFile);
  m_LabelMap.request(run, "labelMap", vtkSmartPointer<vtkMRMLLabelMapVolumeNode>::New());
  if (m_Wanted == Compartments)
    m_Compartments.request(run, "compartments", vtkSmartPointer<vtkMRMLLabelMapVolumeNode>::New());
}

void ClassificationTask::deliver(vtkMRMLTissueMapperNode* parameters)
{
  if (m_Wanted == Tissues && m_LabelMap.isRead()) this->deliverTissues(parameters);
  if (m_Wanted == Compartments && m_Compartments.isRead()) this->deliverCompartments(parameters);
}

void ClassificationTask::deliverCompartments(vtkMRMLTissueMapperNode* parameters)
{
  auto* compartments = vtkMRMLLabelMapVolumeNode::SafeDownCast(
    m_Compartments.deliver(parameters->GetLabelMapNode(Node::CompartmentsRole()), parameters->GetScene(),
                           vtkMRMLTr("vtkSlicerTissueMapperLogic", "compartments")));
  parameters->SetNode(Node::CompartmentsRole(), compartments);
  showTissueColors(compartments, compartmentTable());
}

/// Names and colours are taken from the file of names: the host reads those in the label map's file for segmentations
/// only.
void ClassificationTask::deliverTissues(vtkMRMLTissueMapperNode* parameters)
{
  const std::vector<vtkMRMLScalarVolumeNode*> images = parameters->GetImages();
  const std::string name = (images.empty() ? std::string() : images.front()->GetName() + std::string(" ")) +
                           vtkMRMLTr("vtkSlicerTissueMapperLogic", "tissues");
  auto* labelMap = vtkMRMLLabelMapVolumeNode::SafeDownCast(
    m_LabelMap.deliver(parameters->GetLabelMapNode(Node::LabelMapRole()), parameters->GetScene(), name));
  parameters->SetNode(Node::LabelMapRole(), labelMap);
  const TissueTable tissues = readTissueTable(m_NamesFile);
  showTissueColors(labelMap, tissues);
  const std::vector<Label> present = presentLabels(readTissueMap(labelMap));
  m_EmptyClasses.clear();
  for (const auto& [label, tissue] : tissues)
  {
    if (!std::binary_search(present.begin(), present.end(), label)) m_EmptyClasses.push_back(tissue.name);
  }
}

void ClassificationTask::forgetResults()
{
  m_LabelMap.forget();
  m_Compartments.forget();
}

} // namespace surgicalmesher
