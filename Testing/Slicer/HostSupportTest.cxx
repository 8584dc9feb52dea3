// SPDX-License-Identifier: Apache-2.0
/// What the modules' tests rely on: that the helpers make what they say, and that the comparisons can fail.

#include "HostApplication.h"
#include "HostScene.h"
#include "MeshComparison.h"

#include <vtkMRMLCoreTestingMacros.h>
#include <vtkMRMLLabelMapVolumeNode.h>
#include <vtkMRMLMarkupsNode.h>
#include <vtkMRMLModelNode.h>
#include <vtkMRMLModelStorageNode.h>
#include <vtkMRMLScene.h>
#include <vtkMRMLSegmentationNode.h>
#include <vtkSegment.h>
#include <vtkSegmentation.h>

#include <vtkDoubleArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSphereSource.h>
#include <vtkStringArray.h>
#include <vtkXMLPolyDataWriter.h>

#include <QDebug>

#include <algorithm>
#include <cmath>

using namespace surgicalmesher::test;

namespace
{

/// A sphere with an array of its own, in a file of the modules' kind.
vtkSmartPointer<vtkPolyData> writtenSphere(const std::string& file)
{
  vtkNew<vtkSphereSource> source;
  source->Update();
  vtkSmartPointer<vtkPolyData> sphere = source->GetOutput();
  sphere->GetPointData()->Initialize();
  vtkNew<vtkDoubleArray> heights;
  heights->SetName("Height");
  for (vtkIdType i = 0; i < sphere->GetNumberOfPoints(); ++i) heights->InsertNextValue(sphere->GetPoint(i)[2]);
  sphere->GetPointData()->AddArray(heights);
  vtkNew<vtkStringArray> space;
  space->SetName("SPACE");
  space->InsertNextValue("LPS");
  sphere->GetFieldData()->AddArray(space);
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetFileName(file.c_str());
  writer->SetInputData(sphere);
  writer->Write();
  return sphere;
}

vtkMRMLModelNode* loadModel(vtkMRMLScene* scene, const std::string& file)
{
  auto* model = vtkMRMLModelNode::SafeDownCast(scene->AddNewNodeByClass("vtkMRMLModelNode"));
  vtkNew<vtkMRMLModelStorageNode> storage;
  storage->SetFileName(file.c_str());
  storage->ReadData(model);
  return model;
}

int checkComparison(HostApplication& host)
{
  const std::string file = newFolder("HostSupportTest") + "/sphere.vtp";
  const vtkSmartPointer<vtkPolyData> sphere = writtenSphere(file);
  vtkMRMLModelNode* model = loadModel(host.scene(), file);
  CHECK_STD_STRING(differenceOf(file, model), "");
  CHECK_BOOL(differenceOf(file, nullptr).empty(), false);
  CHECK_BOOL(sameBytes(file, file), true);
  CHECK_BOOL(sameBytes(file, file + ".missing"), false);

  vtkNew<vtkPolyData> other;
  other->DeepCopy(sphere);
  CHECK_STD_STRING(differenceOf(sphere, other), "");
  other->GetPointData()->GetArray("Height")->SetComponent(3, 0, 7.0);
  CHECK_STD_STRING(differenceOf(sphere, other), "point array Height another");
  other->GetPointData()->RemoveArray("Height");
  CHECK_STD_STRING(differenceOf(sphere, other), "point array Height in one only");
  other->GetPoints()->SetPoint(5, 0, 0, 0);
  CHECK_STD_STRING(differenceOf(sphere, other), "point 5 elsewhere");
  return EXIT_SUCCESS;
}

int checkNodes(HostApplication& host)
{
  const LeftoverCheck check(host.scene());
  CHECK_STD_STRING(check.leftovers(), "");
  vtkMRMLLabelMapVolumeNode* balls = addNestedBalls(host.scene());
  CHECK_BOOL(check.leftovers().empty(), false);
  // The volume of the inner ball, 4/3 pi 6^3 mm3, to the accuracy of its voxels.
  const auto* voxels = static_cast<short*>(balls->GetImageData()->GetScalarPointer());
  const auto inner = std::count(voxels, voxels + balls->GetImageData()->GetNumberOfPoints(), short(1));
  CHECK_BOOL(std::abs(inner - 905) < 45, true);

  vtkMRMLSegmentationNode* segmentation = addSegmentation(host.scene(), balls);
  CHECK_INT(segmentation->GetSegmentation()->GetNumberOfSegments(), 2);
  CHECK_STD_STRING(segmentation->GetSegmentation()->GetNthSegment(0)->GetName(), "tumour");
  CHECK_INT(addEmptySegmentation(host.scene())->GetSegmentation()->GetNumberOfSegments(), 0);

  vtkMRMLMarkupsNode* points = addMarkups(host.scene(), "vtkMRMLMarkupsFiducialNode", { { 1, 2, 3 }, { 0, 0, 0 } });
  CHECK_INT(points->GetNumberOfControlPoints(), 2);
  CHECK_BOOL(addTransform(host.scene()) != nullptr, true);
  return EXIT_SUCCESS;
}

int checkLog(HostApplication& host)
{
  CHECK_STD_STRING(host.complaints(), "");
  qWarning() << "a complaint of this test";
  CHECK_BOOL(host.complaints().find("a complaint of this test") != std::string::npos, true);
  CHECK_STD_STRING(host.complaints(), "");
  return EXIT_SUCCESS;
}

} // namespace

int HostSupportTest(int, char*[])
{
  HostApplication host;
  CHECK_EXIT_SUCCESS(checkComparison(host));
  CHECK_EXIT_SUCCESS(checkNodes(host));
  CHECK_EXIT_SUCCESS(checkLog(host));
  CHECK_BOOL(host.waitUntil([] { return false; }, 0.1), false);
  return EXIT_SUCCESS;
}
