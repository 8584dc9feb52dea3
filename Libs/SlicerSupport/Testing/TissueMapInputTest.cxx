// SPDX-License-Identifier: Apache-2.0
// Label maps and segmentations as tissue maps: which voxel is which tissue, where it lies, what it is called.

#include "TissueMapInput.h"

#include "Errors.h"
#include "TissueColors.h"
#include "TissueMapIO.h"

#include <vtkBinaryLabelmapToClosedSurfaceConversionRule.h>
#include <vtkClosedSurfaceToBinaryLabelmapConversionRule.h>
#include <vtkMRMLColorTableNode.h>
#include <vtkMRMLCoreTestingMacros.h>
#include <vtkMRMLLabelMapVolumeDisplayNode.h>
#include <vtkMRMLLabelMapVolumeNode.h>
#include <vtkMRMLModelNode.h>
#include <vtkMRMLScene.h>
#include <vtkMRMLSegmentationNode.h>
#include <vtkMRMLTransformNode.h>
#include <vtkMRMLVolumeArchetypeStorageNode.h>
#include <vtkOrientedImageData.h>
#include <vtkSegment.h>
#include <vtkSegmentation.h>
#include <vtkSegmentationConverter.h>
#include <vtkSegmentationConverterFactory.h>

#include <vtkImageData.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSphereSource.h>
#include <vtkTransform.h>

#include <algorithm>
#include <cmath>

using namespace surgicalmesher;

namespace
{

constexpr int size[3] = { 5, 4, 3 };

vtkSmartPointer<vtkImageData> makeImage(int type = VTK_SHORT)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(const_cast<int*>(size));
  image->AllocateScalars(type, 1);
  image->GetPointData()->GetScalars()->Fill(0);
  return image;
}

/// Labels 1 and 3, no two slices alike.
vtkMRMLLabelMapVolumeNode* addLabelMap(vtkMRMLScene* scene)
{
  const vtkSmartPointer<vtkImageData> image = makeImage();
  image->SetScalarComponentFromDouble(1, 1, 1, 0, 1);
  image->SetScalarComponentFromDouble(2, 1, 1, 0, 1);
  image->SetScalarComponentFromDouble(3, 2, 0, 0, 3);
  image->SetScalarComponentFromDouble(0, 3, 2, 0, 3);
  auto* node = vtkMRMLLabelMapVolumeNode::SafeDownCast(scene->AddNewNodeByClass("vtkMRMLLabelMapVolumeNode", "map"));
  node->SetAndObserveImageData(image);
  return node;
}

/// Left-handed, oblique, of three different spacings.
vtkSmartPointer<vtkMatrix4x4> obliqueMatrix()
{
  vtkNew<vtkTransform> transform;
  transform->Translate(10, -20, 30);
  transform->RotateWXYZ(40, 1, 2, 3);
  transform->Scale(-0.5, 0.75, 2);
  auto matrix = vtkSmartPointer<vtkMatrix4x4>::New();
  matrix->DeepCopy(transform->GetMatrix());
  return matrix;
}

vtkMRMLTransformNode* addTransform(vtkMRMLScene* scene, vtkTransform* transform)
{
  auto* node = vtkMRMLTransformNode::SafeDownCast(scene->AddNewNodeByClass("vtkMRMLLinearTransformNode"));
  node->SetMatrixTransformToParent(transform->GetMatrix());
  return node;
}

/// A segment of the box from `first` to `last` voxel, in an image of just that extent.
void addSegment(vtkSegmentation* segmentation, const char* name, const int extent[6])
{
  vtkNew<vtkOrientedImageData> image;
  image->SetExtent(const_cast<int*>(extent));
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 1);
  image->GetPointData()->GetScalars()->Fill(1);
  image->SetImageToWorldMatrix(obliqueMatrix());
  vtkNew<vtkSegment> segment;
  segment->SetName(name);
  segment->SetColor(0.25, 0.5, 1);
  segment->AddRepresentation(vtkSegmentationConverter::GetSegmentationBinaryLabelmapRepresentationName(), image);
  segmentation->AddSegment(segment);
}

void setReferenceGeometry(vtkSegmentation* segmentation)
{
  vtkNew<vtkOrientedImageData> image;
  image->SetDimensions(const_cast<int*>(size));
  image->SetImageToWorldMatrix(obliqueMatrix());
  segmentation->SetConversionParameter(vtkSegmentationConverter::GetReferenceImageGeometryParameterName(),
                                       vtkSegmentationConverter::SerializeImageGeometry(image));
}

vtkMRMLSegmentationNode* addSegmentation(vtkMRMLScene* scene)
{
  auto* node =
    vtkMRMLSegmentationNode::SafeDownCast(scene->AddNewNodeByClass("vtkMRMLSegmentationNode", "segmentation"));
  setReferenceGeometry(node->GetSegmentation());
  const int first[6] = { 0, 2, 0, 2, 0, 1 };
  const int second[6] = { 2, 4, 1, 3, 1, 2 }; // shares voxel (2, 1..2, 1) with the first
  addSegment(node->GetSegmentation(), "white matter", first);
  addSegment(node->GetSegmentation(), "tumour", second);
  return node;
}

bool isNear(const Vec3& a, const Vec3& b) { return norm(a - b) < 1e-6; }

bool areSame(const TissueMap& a, const TissueMap& b)
{
  bool isSame = a.labels == b.labels && a.grid.size == b.grid.size && isNear(a.grid.origin, b.grid.origin) &&
                isNear(a.grid.spacing, b.grid.spacing);
  for (int axis = 0; axis < 3; ++axis) isSame = isSame && isNear(a.grid.axes[axis], b.grid.axes[axis]);
  return isSame;
}

/// The label at a voxel of `matrix`, found by its place in the world.
Label labelAt(const TissueMap& map, vtkMatrix4x4* matrix, int i, int j, int k)
{
  const double voxel[4] = { double(i), double(j), double(k), 1 };
  double ras[4];
  matrix->MultiplyPoint(voxel, ras);
  const Vec3 p = map.grid.worldToGrid({ -ras[0], -ras[1], ras[2] });
  const auto index = [&](int axis) { return int(std::lround(p[axis] / map.grid.spacing[axis])); };
  return map.grid.contains(index(0), index(1), index(2)) ? map.labels[map.grid.index(index(0), index(1), index(2))]
                                                         : Label(9999);
}

//----------------------------------------------------------------------------
/// The host's own file of a label map and the map in memory are the same to the core.
int checkLabelMap(const std::string& folder)
{
  vtkNew<vtkMRMLScene> scene;
  vtkMRMLLabelMapVolumeNode* node = addLabelMap(scene);
  node->SetIJKToRASMatrix(obliqueMatrix());
  vtkNew<vtkMRMLVolumeArchetypeStorageNode> storage;
  const std::string file = folder + "/TissueMapInputTest.nrrd";
  storage->SetFileName(file.c_str());
  storage->SetScene(scene);
  CHECK_INT(storage->WriteData(node), 1);
  CHECK_BOOL(areSame(readTissueMap(node), readTissueMap(file)), true);

  // Under a transform, the world is the transformed one; the node itself stays as it was.
  vtkNew<vtkTransform> turn;
  turn->Translate(1, 2, 3);
  turn->RotateZ(20);
  node->SetAndObserveTransformNodeID(addTransform(scene, turn)->GetID());
  const vtkMTimeType time = tissueMapTime(node);
  const TissueMap moved = readTissueMap(node);
  const TissueMapNodes copies = makeTissueMapNodes(node);
  CHECK_BOOL(tissueMapTime(node) == time, true);
  CHECK_BOOL(areSame(readTissueMap(copies.labelMap), moved), true);
  vtkNew<vtkMatrix4x4> world;
  vtkMatrix4x4::Multiply4x4(turn->GetMatrix(), obliqueMatrix(), world);
  CHECK_INT(labelAt(moved, world, 3, 2, 0), 3);
  CHECK_INT(labelAt(moved, world, 2, 1, 1), 1);
  CHECK_INT(labelAt(moved, world, 4, 3, 2), 0);

  CHECK_POINTER(copies.labelMap->GetImageData(), node->GetImageData()); // shared, not copied
  CHECK_NULL(copies.labelMap->GetParentTransformNode());
  CHECK_BOOL(copies.labelMap->GetHideFromEditors() && !copies.labelMap->GetSaveWithScene(), true);
  CHECK_NULL(copies.colors); // the map has no names
  turn->Translate(5, 0, 0);
  node->GetParentTransformNode()->SetMatrixTransformToParent(turn->GetMatrix());
  CHECK_BOOL(tissueMapTime(node) > time, true);
  return EXIT_SUCCESS;
}

int checkNames()
{
  vtkNew<vtkMRMLScene> scene;
  vtkMRMLLabelMapVolumeNode* node = addLabelMap(scene);
  auto* colors = vtkMRMLColorTableNode::SafeDownCast(scene->AddNewNodeByClass("vtkMRMLColorTableNode"));
  const TissueTable table{ { Label(1), Tissue{ "white matter", { 0.1, 0.2, 0.3 } } },
                           { Label(3), Tissue{ "tumour", { 1, 0, 0.2 } } } };
  fillColorTable(table, colors);
  vtkMRMLNode* display = scene->AddNewNodeByClass("vtkMRMLLabelMapVolumeDisplayNode");
  node->SetAndObserveDisplayNodeID(display->GetID());
  node->GetDisplayNode()->SetAndObserveColorNodeID(colors->GetID());
  const TissueTable found = tissueTable(node);
  CHECK_INT(int(found.size()), 2); // 2 is no tissue, and 0 never one
  CHECK_STD_STRING(found.at(1).name, "white matter");
  CHECK_DOUBLE_TOLERANCE(found.at(3).color[2], 0.2, 1e-9);
  const TissueMapNodes copies = makeTissueMapNodes(node);
  CHECK_STRING(copies.colors->GetColorName(3), "tumour");
  CHECK_BOOL(copies.colors->GetSaveWithScene(), false);
  return EXIT_SUCCESS;
}

int checkSegmentation()
{
  vtkNew<vtkMRMLScene> scene;
  vtkMRMLSegmentationNode* node = addSegmentation(scene);
  CHECK_BOOL(checkTissueMap(node) == TissueMapProblem::None, true);
  const vtkMTimeType time = tissueMapTime(node);
  const TissueMap map = readTissueMap(node);
  CHECK_INT(int(map.labels.size()), size[0] * size[1] * size[2]); // the reference geometry, not the segments' extent
  const vtkSmartPointer<vtkMatrix4x4> matrix = obliqueMatrix();
  CHECK_INT(labelAt(map, matrix, 0, 0, 0), 1);
  CHECK_INT(labelAt(map, matrix, 2, 0, 1), 1);
  CHECK_INT(labelAt(map, matrix, 2, 1, 1), 2); // the later segment wins
  CHECK_INT(labelAt(map, matrix, 4, 3, 2), 2);
  CHECK_INT(labelAt(map, matrix, 0, 3, 2), 0);
  CHECK_STD_STRING(map.table.at(2).name, "tumour");
  CHECK_DOUBLE(map.table.at(1).color[0], 0.25);
  const TissueMapNodes copies = makeTissueMapNodes(node);
  CHECK_BOOL(areSame(readTissueMap(copies.labelMap), map), true);
  CHECK_STRING(copies.colors->GetColorName(1), "white matter");
  CHECK_BOOL(tissueMapTime(node) == time, true);

  node->GetSegmentation()->SetSegmentIndex(node->GetSegmentation()->GetNthSegmentID(1), 0);
  CHECK_INT(labelAt(readTissueMap(node), matrix, 2, 1, 1), 2); // now the other one is the later
  CHECK_INT(labelAt(readTissueMap(node), matrix, 4, 3, 2), 1);
  CHECK_BOOL(tissueMapTime(node) > time, true);
  return EXIT_SUCCESS;
}

/// Segments are surfaces from now on. Slicer 5.0 calls the representation that is edited the master.
template <class Segmentation>
auto useSurfaces(Segmentation* segmentation, int) -> decltype(segmentation->SetSourceRepresentationName(""), void())
{
  segmentation->SetSourceRepresentationName(vtkSegmentationConverter::GetSegmentationClosedSurfaceRepresentationName());
}

template <class Segmentation>
void useSurfaces(Segmentation* segmentation, long)
{
  segmentation->SetMasterRepresentationName(vtkSegmentationConverter::GetSegmentationClosedSurfaceRepresentationName());
}

/// A segmentation of surfaces alone is converted on the way, and stays as it is.
int checkSurfaceSegmentation()
{
  vtkNew<vtkMRMLScene> scene;
  auto* node = vtkMRMLSegmentationNode::SafeDownCast(scene->AddNewNodeByClass("vtkMRMLSegmentationNode"));
  const char* surfaces = vtkSegmentationConverter::GetSegmentationClosedSurfaceRepresentationName();
  vtkNew<vtkSphereSource> ball;
  ball->SetCenter(10, -20, 30);
  ball->SetRadius(0.9);
  ball->Update();
  vtkNew<vtkSegment> segment;
  segment->SetName("ball");
  segment->AddRepresentation(surfaces, ball->GetOutput());
  useSurfaces(node->GetSegmentation(), 0);
  node->GetSegmentation()->AddSegment(segment);
  CHECK_BOOL(checkTissueMap(node) == TissueMapProblem::NoReferenceGeometry, true);
  setReferenceGeometry(node->GetSegmentation());
  CHECK_BOOL(checkTissueMap(node) == TissueMapProblem::None, true);
  const TissueMap map = readTissueMap(node);
  CHECK_INT(labelAt(map, obliqueMatrix(), 0, 0, 0), 1);
  CHECK_INT(labelAt(map, obliqueMatrix(), 4, 3, 2), 0);
  CHECK_BOOL(node->GetSegmentation()->ContainsRepresentation(
               vtkSegmentationConverter::GetSegmentationBinaryLabelmapRepresentationName()),
             false);
  return EXIT_SUCCESS;
}

int checkProblems()
{
  vtkNew<vtkMRMLScene> scene;
  CHECK_BOOL(checkTissueMap(nullptr) == TissueMapProblem::NothingChosen, true);
  CHECK_BOOL(checkTissueMap(scene->AddNewNodeByClass("vtkMRMLModelNode")) == TissueMapProblem::NotATissueMap, true);
  auto* segmentation = vtkMRMLSegmentationNode::SafeDownCast(scene->AddNewNodeByClass("vtkMRMLSegmentationNode"));
  CHECK_BOOL(checkTissueMap(segmentation) == TissueMapProblem::NoSegment, true);
  segmentation->GetSegmentation()->AddEmptySegment("empty");
  CHECK_BOOL(checkTissueMap(segmentation) == TissueMapProblem::OnlyBackground, true);
  CHECK_BOOL(makeTissueMapNodes(segmentation).problem == TissueMapProblem::OnlyBackground, true);

  vtkMRMLLabelMapVolumeNode* map = addLabelMap(scene);
  vtkNew<vtkTransform> shear;
  const double elements[16] = { 1, 0.5, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1 };
  shear->SetMatrix(elements);
  map->SetAndObserveTransformNodeID(addTransform(scene, shear)->GetID());
  CHECK_BOOL(checkTissueMap(map) == TissueMapProblem::ShearingTransform, true);
  map->SetAndObserveTransformNodeID(nullptr);
  map->GetImageData()->SetScalarComponentFromDouble(0, 0, 0, 0, -1);
  map->GetImageData()->GetPointData()->GetScalars()->Modified();
  CHECK_BOOL(checkTissueMap(map) == TissueMapProblem::NegativeLabels, true);
  map->SetAndObserveImageData(makeImage());
  CHECK_BOOL(checkTissueMap(map) == TissueMapProblem::OnlyBackground, true);
  const vtkSmartPointer<vtkImageData> fractions = makeImage(VTK_FLOAT);
  fractions->SetScalarComponentFromDouble(1, 1, 1, 0, 1.5);
  map->SetAndObserveImageData(fractions);
  bool isRefused = false;
  try
  {
    readTissueMap(map);
  }
  catch (const InputError&)
  {
    isRefused = true;
  }
  CHECK_BOOL(isRefused, true);
  map->SetAndObserveImageData(nullptr);
  CHECK_BOOL(checkTissueMap(map) == TissueMapProblem::NoVoxels, true);
  CHECK_NULL(makeTissueMapNodes(map).labelMap);
  return EXIT_SUCCESS;
}

} // namespace

int TissueMapInputTest(int, char*[])
{
  // As the host's Segmentations module does.
  vtkSegmentationConverterFactory* factory = vtkSegmentationConverterFactory::GetInstance();
  factory->RegisterConverterRule(vtkNew<vtkBinaryLabelmapToClosedSurfaceConversionRule>());
  factory->RegisterConverterRule(vtkNew<vtkClosedSurfaceToBinaryLabelmapConversionRule>());
  CHECK_EXIT_SUCCESS(checkLabelMap(SURGICALMESHER_TEST_FOLDER));
  CHECK_EXIT_SUCCESS(checkNames());
  CHECK_EXIT_SUCCESS(checkSegmentation());
  CHECK_EXIT_SUCCESS(checkSurfaceSegmentation());
  CHECK_EXIT_SUCCESS(checkProblems());
  return EXIT_SUCCESS;
}
