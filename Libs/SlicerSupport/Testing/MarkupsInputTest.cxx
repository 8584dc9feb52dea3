// SPDX-License-Identifier: Apache-2.0
// Points and paths of markups nodes, and what comes back of them from a file.

#include "MarkupsInput.h"

#include "TissueMapIO.h"

#include <vtkMRMLCoreTestingMacros.h>
#include <vtkMRMLMarkupsClosedCurveNode.h>
#include <vtkMRMLMarkupsCurveNode.h>
#include <vtkMRMLMarkupsDisplayNode.h>
#include <vtkMRMLMarkupsFiducialNode.h>
#include <vtkMRMLMarkupsLineNode.h>
#include <vtkMRMLScene.h>
#include <vtkMRMLSelectionNode.h>
#include <vtkMRMLTransformNode.h>

#include <vtkNew.h>
#include <vtkTransform.h>

#include <algorithm>
#include <array>

using namespace surgicalmesher;

namespace
{

void registerClasses(vtkMRMLScene* scene)
{
  scene->RegisterNodeClass(vtkNew<vtkMRMLMarkupsFiducialNode>());
  scene->RegisterNodeClass(vtkNew<vtkMRMLMarkupsLineNode>());
  scene->RegisterNodeClass(vtkNew<vtkMRMLMarkupsCurveNode>());
  scene->RegisterNodeClass(vtkNew<vtkMRMLMarkupsClosedCurveNode>());
  scene->RegisterNodeClass(vtkNew<vtkMRMLMarkupsDisplayNode>());
}

vtkMRMLMarkupsNode* addMarkups(vtkMRMLScene* scene, const char* className,
                               const std::vector<std::array<double, 3>>& points)
{
  auto* node = vtkMRMLMarkupsNode::SafeDownCast(scene->AddNewNodeByClass(className));
  for (const std::array<double, 3>& p : points) node->AddControlPoint(p[0], p[1], p[2]);
  return node;
}

const std::vector<std::array<double, 3>> corners{ { 0, 0, 0 }, { 30, 0, 0 }, { 30, 20, 0 }, { 0, 20, 10 } };

bool hasPointNear(const std::vector<Vec3>& path, const Vec3& p)
{
  return std::any_of(path.begin(), path.end(), [&](const Vec3& q) { return norm(p - q) < 1e-6; });
}

int checkPoints(vtkMRMLScene* scene)
{
  CHECK_INT(int(markupsPoints(nullptr).size()), 0);
  vtkMRMLMarkupsNode* node = addMarkups(scene, "vtkMRMLMarkupsFiducialNode", { { 1, 2, 3 }, { 4, 5, 6 }, { 7, 8, 9 } });
  node->UnsetNthControlPointPosition(1);
  std::vector<Vec3> points = markupsPoints(node);
  CHECK_INT(int(points.size()), 2); // those that are placed
  CHECK_BOOL((points[1] == Vec3{ -7, -8, 9 }), true);
  node->SetNthControlPointLabel(2, "third");
  CHECK_STD_STRING(labelledPoints(node).labels[1], "third");

  auto* transform = vtkMRMLTransformNode::SafeDownCast(scene->AddNewNodeByClass("vtkMRMLTransformNode"));
  vtkNew<vtkTransform> shift;
  shift->Translate(100, 0, 0);
  transform->SetMatrixTransformToParent(shift->GetMatrix());
  node->SetAndObserveTransformNodeID(transform->GetID());
  CHECK_BOOL(norm(markupsPoints(node)[0] - Vec3{ -101, -2, 3 }) < 1e-12, true);
  return EXIT_SUCCESS;
}

int checkPaths(vtkMRMLScene* scene)
{
  CHECK_INT(int(markupsPath(addMarkups(scene, "vtkMRMLMarkupsCurveNode", { { 1, 2, 3 } })).size()), 0);
  CHECK_INT(int(markupsPath(addMarkups(scene, "vtkMRMLMarkupsLineNode", { corners[0], corners[1] })).size()), 2);
  auto* curve = vtkMRMLMarkupsCurveNode::SafeDownCast(addMarkups(scene, "vtkMRMLMarkupsCurveNode", corners));
  const std::vector<Vec3> smooth = markupsPath(curve);
  CHECK_BOOL(smooth.size() > 20, true);
  for (const Vec3& p : markupsPoints(curve)) CHECK_BOOL(hasPointNear(smooth, p), true);
  CHECK_BOOL((smooth.front() == Vec3{ 0, 0, 0 }), true); // from entry to target
  curve->SetCurveTypeToLinear();
  CHECK_BOOL(markupsPath(curve) == markupsPoints(curve), true);

  vtkMRMLMarkupsNode* closed = addMarkups(scene, "vtkMRMLMarkupsClosedCurveNode", corners);
  const std::vector<Vec3> loop = markupsPath(closed);
  CHECK_BOOL(norm(loop.front() - loop.back()) < 1e-9, true);
  CHECK_BOOL(loop.size() > 20, true);
  return EXIT_SUCCESS;
}

int checkFile()
{
  const std::vector<std::vector<Vec3>> lists{ { { 0.1, -1.0 / 3, 1e-9 }, { 1e6, 2, 3 } }, { { 4, 5, 6.0000001 } } };
  const std::string file = std::string(SURGICALMESHER_TEST_FOLDER) + "/MarkupsInputTest.mrk.json";
  writeMarkups(lists, file);
  CHECK_BOOL(readMarkups(file) == lists, true); // to the last bit
  Markup named;
  named.points = lists[0];
  named.labels = { "a \"b\" \\", "ö" };
  writeLabelledMarkups({ named }, file);
  CHECK_BOOL(readLabelledMarkups(file)[0].points == lists[0], true);
  CHECK_STD_STRING(readLabelledMarkups(file)[0].labels[0], "a \"b\" \\");
  CHECK_STD_STRING(readLabelledMarkups(file)[0].labels[1], "ö");
  return EXIT_SUCCESS;
}

} // namespace

int MarkupsInputTest(int, char*[])
{
  vtkNew<vtkMRMLScene> scene;
  registerClasses(scene);
  scene->AddNode(vtkNew<vtkMRMLSelectionNode>()); // which lines measure themselves by
  CHECK_EXIT_SUCCESS(checkPoints(scene));
  CHECK_EXIT_SUCCESS(checkPaths(scene));
  CHECK_EXIT_SUCCESS(checkFile());
  return EXIT_SUCCESS;
}
