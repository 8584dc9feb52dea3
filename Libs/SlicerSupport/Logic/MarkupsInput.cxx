// SPDX-License-Identifier: Apache-2.0
#include "MarkupsInput.h"

#include "Errors.h"

#include <vtkMRMLMarkupsCurveNode.h>
#include <vtkMRMLMarkupsNode.h>

#include <vtkPoints.h>

#include <fstream>
#include <locale>

namespace surgicalmesher
{

namespace
{

Vec3 fromRAS(const double p[3]) { return { -p[0], -p[1], p[2] }; }

bool isSmooth(vtkMRMLMarkupsNode* node)
{
  auto* curve = vtkMRMLMarkupsCurveNode::SafeDownCast(node);
  return curve && curve->GetCurveType() != curve->GetCurveTypeFromString("linear");
}

} // namespace

std::vector<Vec3> markupsPoints(vtkMRMLMarkupsNode* node)
{
  std::vector<Vec3> points;
  for (int n = 0; node && n < node->GetNumberOfControlPoints(); ++n)
  {
    if (node->GetNthControlPointPositionStatus(n) != vtkMRMLMarkupsNode::PositionDefined) continue;
    double p[3];
    node->GetNthControlPointPositionWorld(n, p);
    points.push_back(fromRAS(p));
  }
  return points;
}

std::vector<Vec3> markupsPath(vtkMRMLMarkupsNode* node)
{
  std::vector<Vec3> path = markupsPoints(node);
  if (path.size() < 2) return {};
  vtkPoints* drawn = isSmooth(node) ? node->GetCurvePointsWorld() : nullptr;
  if (drawn && drawn->GetNumberOfPoints() > 1)
  {
    path.clear();
    for (vtkIdType n = 0; n < drawn->GetNumberOfPoints(); ++n) path.push_back(fromRAS(drawn->GetPoint(n)));
  }
  if (node->GetCurveClosed() && !(path.front() == path.back())) path.push_back(path.front());
  return path;
}

void writeMarkups(const std::vector<std::vector<Vec3>>& markups, const std::string& file)
{
  std::ofstream stream(file);
  stream.imbue(std::locale::classic());
  stream.precision(17);
  stream << "{\"markups\": [";
  const char* betweenLists = "";
  for (const std::vector<Vec3>& points : markups)
  {
    stream << betweenLists << "\n{\"type\": \"Fiducial\", \"coordinateSystem\": \"LPS\", \"controlPoints\": [";
    const char* betweenPoints = "";
    for (const Vec3& p : points)
    {
      stream << betweenPoints << "\n{\"position\": [" << p.x << ", " << p.y << ", " << p.z << "]}";
      betweenPoints = ",";
    }
    stream << "]}";
    betweenLists = ",";
  }
  stream << "]}\n";
  stream.close();
  if (!stream) throw InputError(file + ": cannot be written");
}

} // namespace surgicalmesher
