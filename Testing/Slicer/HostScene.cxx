// SPDX-License-Identifier: Apache-2.0
#include "HostScene.h"

#include "HostDifferences.h"

#include <qSlicerAbstractCoreModule.h>
#include <qSlicerApplication.h>
#include <qSlicerModuleManager.h>

#include <vtkMRMLColorTableNode.h>
#include <vtkMRMLDisplayNode.h>
#include <vtkMRMLLabelMapVolumeNode.h>
#include <vtkMRMLLinearTransformNode.h>
#include <vtkMRMLMarkupsNode.h>
#include <vtkMRMLScalarVolumeNode.h>
#include <vtkMRMLScene.h>
#include <vtkMRMLSegmentationNode.h>
#include <vtkMRMLSelectionNode.h>
#include <vtkMRMLStorableNode.h>
#include <vtkMRMLStorageNode.h>
#include <vtkSlicerApplicationLogic.h>
#include <vtkSlicerSegmentationsModuleLogic.h>
#include <vtkSlicerVolumesLogic.h>

#include <vtkCollection.h>
#include <vtkImageData.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkSmartPointer.h>
#include <vtkTransform.h>

#include <QDir>
#include <QFileInfo>

#include <cmath>

namespace surgicalmesher::test
{
namespace
{

/// Tumour, red, and brain, grey.
vtkMRMLColorTableNode* addTissueColors(vtkMRMLScene* scene)
{
  vtkNew<vtkMRMLColorTableNode> colors;
  colors->SetTypeToUser();
  colors->SetName("Tissues");
  colors->SetNumberOfColors(3);
  host::keepColorNames(colors.GetPointer());
  colors->SetColor(0, "background", 0, 0, 0, 0);
  colors->SetColor(1, "tumour", 0.9, 0.3, 0.25);
  colors->SetColor(2, "brain", 0.8, 0.8, 0.8);
  return vtkMRMLColorTableNode::SafeDownCast(scene->AddNode(colors));
}

/// By the host's own logic, which the application's dialogue uses as well.
vtkMRMLVolumeNode* loadAnyVolume(vtkMRMLScene* scene, const std::string& fileName, int options)
{
  qSlicerAbstractCoreModule* module = qSlicerApplication::application()->moduleManager()->module("Volumes");
  auto* logic = vtkSlicerVolumesLogic::SafeDownCast(module ? module->logic() : nullptr);
  const std::string name = QFileInfo(QString::fromStdString(fileName)).baseName().toStdString();
  return logic && scene == logic->GetMRMLScene() ? logic->AddArchetypeVolume(fileName.c_str(), name.c_str(), options)
                                                 : nullptr;
}

std::string ifExists(const QString& file) { return QFileInfo::exists(file) ? file.toStdString() : std::string(); }

std::string described(vtkMRMLNode* node)
{
  const std::string name = node->GetName() ? node->GetName() : "";
  return std::string(node->GetClassName()) + " " + name + " (" + node->GetID() + ")";
}

} // namespace

vtkMRMLLabelMapVolumeNode* addLabelMap(vtkMRMLScene* scene, const char* name, int voxelsPerSide, double spacing,
                                       const std::function<int(const Point&)>& labelAt)
{
  const double first = -0.5 * (voxelsPerSide - 1) * spacing;
  vtkNew<vtkImageData> image;
  image->SetDimensions(voxelsPerSide, voxelsPerSide, voxelsPerSide);
  image->AllocateScalars(VTK_SHORT, 1);
  auto* voxel = static_cast<short*>(image->GetScalarPointer());
  for (int k = 0; k < voxelsPerSide; ++k)
  {
    for (int j = 0; j < voxelsPerSide; ++j)
    {
      for (int i = 0; i < voxelsPerSide; ++i)
      {
        *voxel++ = static_cast<short>(labelAt({ first + i * spacing, first + j * spacing, first + k * spacing }));
      }
    }
  }
  // With its voxels before it enters the scene: a slice view that has to draw a label map without any may crash.
  vtkNew<vtkMRMLLabelMapVolumeNode> labelMap;
  labelMap->SetName(name);
  labelMap->SetSpacing(spacing, spacing, spacing);
  labelMap->SetOrigin(first, first, first);
  labelMap->SetAndObserveImageData(image);
  scene->AddNode(labelMap);
  labelMap->CreateDefaultDisplayNodes();
  return labelMap;
}

vtkMRMLLabelMapVolumeNode* addNestedBalls(vtkMRMLScene* scene, const char* name)
{
  const auto labelAt = [](const Point& p)
  {
    const double radius = std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
    return radius < 6 ? 1 : radius < 10 ? 2 : 0;
  };
  vtkMRMLLabelMapVolumeNode* labelMap = addLabelMap(scene, name, 26, 1, labelAt);
  labelMap->GetDisplayNode()->SetAndObserveColorNodeID(addTissueColors(scene)->GetID());
  return labelMap;
}

vtkMRMLSegmentationNode* addSegmentation(vtkMRMLScene* scene, vtkMRMLLabelMapVolumeNode* labelMap, const char* name)
{
  vtkMRMLSegmentationNode* segmentation = addEmptySegmentation(scene, name);
  vtkSlicerSegmentationsModuleLogic::ImportLabelmapToSegmentationNode(labelMap, segmentation);
  segmentation->SetReferenceImageGeometryParameterFromVolumeNode(labelMap);
  return segmentation;
}

vtkMRMLSegmentationNode* addEmptySegmentation(vtkMRMLScene* scene, const char* name)
{
  auto* segmentation = vtkMRMLSegmentationNode::SafeDownCast(scene->AddNewNodeByClass("vtkMRMLSegmentationNode", name));
  segmentation->CreateDefaultDisplayNodes();
  return segmentation;
}

vtkMRMLLabelMapVolumeNode* loadLabelMap(vtkMRMLScene* scene, const std::string& fileName)
{
  constexpr int LABEL_MAP = 1;
  return vtkMRMLLabelMapVolumeNode::SafeDownCast(loadAnyVolume(scene, fileName, LABEL_MAP));
}

vtkMRMLScalarVolumeNode* loadVolume(vtkMRMLScene* scene, const std::string& fileName)
{
  return vtkMRMLScalarVolumeNode::SafeDownCast(loadAnyVolume(scene, fileName, 0));
}

std::string savedByHost(vtkMRMLStorableNode* node, const std::string& fileName)
{
  vtkSmartPointer<vtkMRMLStorageNode> storage;
  storage.TakeReference(node->CreateDefaultStorageNode());
  storage->SetFileName(fileName.c_str());
  return storage->WriteData(node) ? fileName : std::string();
}

std::string jhuAtlasFile() { return ifExists("/usr/share/mricron/templates/jhu189.nii.gz"); }

std::string brainImageFile() { return ifExists("/usr/share/mricron/templates/ch2better.nii.gz"); }

std::string headImageFile() { return ifExists("/usr/share/mricron/templates/ch2.nii.gz"); }

vtkMRMLLabelMapVolumeNode* loadJhuAtlas(vtkMRMLScene* scene)
{
  vtkMRMLLabelMapVolumeNode* atlas = loadLabelMap(scene, jhuAtlasFile());
  if (!atlas) return nullptr;
  const double sform[16] = {
    -1, 0, 0, 78, 0, 1, 0, -112, 0, 0, 1, -50, 0, 0, 0, 1
  }; // the file's qform is the identity
  vtkNew<vtkMatrix4x4> voxelsToWorld;
  voxelsToWorld->DeepCopy(sform);
  atlas->SetIJKToRASMatrix(voxelsToWorld);
  return atlas;
}

void showInSliceViews(vtkMRMLVolumeNode* volume)
{
  vtkSlicerApplicationLogic* application = qSlicerApplication::application()->applicationLogic();
  vtkMRMLSelectionNode* selection = application->GetSelectionNode();
  if (volume->IsA("vtkMRMLLabelMapVolumeNode")) selection->SetActiveLabelVolumeID(volume->GetID());
  else selection->SetActiveVolumeID(volume->GetID());
  application->PropagateVolumeSelection();
}

vtkMRMLMarkupsNode* addMarkups(vtkMRMLScene* scene, const char* className, const std::vector<Point>& points)
{
  auto* markups = vtkMRMLMarkupsNode::SafeDownCast(scene->AddNewNodeByClass(className));
  markups->CreateDefaultDisplayNodes();
  for (const Point& p : points) markups->AddControlPoint(p[0], p[1], p[2]);
  return markups;
}

vtkMRMLTransformNode* addTransform(vtkMRMLScene* scene)
{
  vtkNew<vtkTransform> transform;
  transform->Translate(5, -3, 2);
  transform->RotateZ(30);
  auto* node = vtkMRMLLinearTransformNode::SafeDownCast(scene->AddNewNodeByClass("vtkMRMLLinearTransformNode"));
  node->SetMatrixTransformToParent(transform->GetMatrix());
  return node;
}

LeftoverCheck::LeftoverCheck(vtkMRMLScene* scene) : m_Scene(scene)
{
  for (int i = 0; i < scene->GetNumberOfNodes(); ++i) m_Before.insert(scene->GetNthNode(i)->GetID());
}

std::string LeftoverCheck::leftovers(const std::set<std::string>& expectedClasses) const
{
  std::string lines;
  for (int i = 0; i < m_Scene->GetNumberOfNodes(); ++i)
  {
    vtkMRMLNode* node = m_Scene->GetNthNode(i);
    if (!m_Before.count(node->GetID()) && !expectedClasses.count(node->GetClassName())) lines += described(node) + "\n";
  }
  return lines;
}

std::set<std::string> temporaryFiles()
{
  const QDir folder(qSlicerApplication::application()->applicationLogic()->GetTemporaryPath());
  std::set<std::string> names;
  for (const QString& name : folder.entryList(QDir::AllEntries | QDir::Hidden | QDir::NoDotAndDotDot))
  {
    names.insert(name.toStdString());
  }
  return names;
}

} // namespace surgicalmesher::test
