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
    const auto copy = copyForRun(images[n]);
    run->AddTemporaryNode(copy);
    run->SetParameterNode(channelParameters[n], copy);
  }
  const std::string training = run->NewTemporaryFile(".mrk.json");
  writeLabelledMarkups({ labelledPoints(parameters->GetMarkupsNode(Node::TrainingRole())) }, training);
  run->SetParameter("training", training);
  run->SetParameter("classes", parameters->GetClasses());
  run->SetParameter("correctBias", parameters->GetCorrectBias());
  run->SetParameter("denoise", parameters->GetDenoise());
  run->SetParameter("noCompartments", !parameters->GetUseCompartments());
  run->SetParameter("noContiguity", !parameters->GetUseContiguity());
  m_NamesFile = run->NewTemporaryFile(".ctbl");
  run->SetParameter("names", m_NamesFile);
  m_LabelMap.request(run, "labelMap", vtkSmartPointer<vtkMRMLLabelMapVolumeNode>::New());
}

/// The file of the label map has names and colours as well, but the host reads them from segmentations only.
void ClassificationTask::deliver(vtkMRMLTissueMapperNode* parameters)
{
  if (!m_LabelMap.isRead()) return;
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

void ClassificationTask::forgetResults() { m_LabelMap.forget(); }

} // namespace surgicalmesher
