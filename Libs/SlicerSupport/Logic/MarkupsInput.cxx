// SPDX-License-Identifier: Apache-2.0
#include "MarkupsInput.h"

#include "Errors.h"
#include "Text.h"

#include <vtkMRMLMarkupsCurveNode.h>
#include <vtkMRMLMarkupsNode.h>

#include <vtkPoints.h>

#include <algorithm>
#include <fstream>
#include <locale>

namespace surgicalmesher
{

namespace
{

Vec3 fromRAS(const double p[3]) { return { -p[0], -p[1], p[2] }; }

/// Returns a JSON string literal.
std::string jsonString(const std::string& words)
{
  std::string result = "\"";
  for (const char c : text::legible(words))
  {
    if (c == '"' || c == '\\') result += '\\';
    result += c;
  }
  return result + '"';
}

bool isSmooth(vtkMRMLMarkupsNode* node)
{
  auto* curve = vtkMRMLMarkupsCurveNode::SafeDownCast(node);
  return curve && curve->GetCurveType() != curve->GetCurveTypeFromString("linear");
}

} // namespace

std::vector<Vec3> markupsPoints(vtkMRMLMarkupsNode* node) { return labelledPoints(node).points; }

Markup labelledPoints(vtkMRMLMarkupsNode* node)
{
  Markup markup;
  for (int n = 0; node && n < node->GetNumberOfControlPoints(); ++n)
  {
    if (node->GetNthControlPointPositionStatus(n) != vtkMRMLMarkupsNode::PositionDefined) continue;
    double p[3];
    node->GetNthControlPointPositionWorld(n, p);
    markup.points.push_back(fromRAS(p));
    markup.labels.push_back(node->GetNthControlPointLabel(n));
  }
  return markup;
}

/// Slicer labels new points by a format in which "%" is special; a point that is being placed already has its label.
void labelNewPoints(vtkMRMLMarkupsNode* node, const std::string& label)
{
  std::string format = text::legible(text::trimmed(label));
  format.erase(std::remove(format.begin(), format.end(), '%'), format.end());
  node->SetControlPointLabelFormat(format);
  for (int n = 0; n < node->GetNumberOfControlPoints(); ++n)
  {
    const bool isBeingPlaced = node->GetNthControlPointPositionStatus(n) == vtkMRMLMarkupsNode::PositionPreview;
    if (isBeingPlaced && node->GetNthControlPointLabel(n) != format) node->SetNthControlPointLabel(n, format);
  }
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
  std::vector<Markup> unlabelled;
  for (const std::vector<Vec3>& points : markups) unlabelled.emplace_back().points = points;
  writeLabelledMarkups(unlabelled, file);
}

void writeLabelledMarkups(const std::vector<Markup>& markups, const std::string& file)
{
  std::ofstream stream(file);
  stream.imbue(std::locale::classic());
  stream.precision(17);
  stream << "{\"markups\": [";
  const char* betweenLists = "";
  for (const Markup& markup : markups)
  {
    stream << betweenLists << "\n{\"type\": \"Fiducial\", \"coordinateSystem\": \"LPS\", \"controlPoints\": [";
    const char* betweenPoints = "";
    for (std::size_t n = 0; n < markup.points.size(); ++n)
    {
      const Vec3& p = markup.points[n];
      stream << betweenPoints << "\n{";
      if (n < markup.labels.size()) stream << "\"label\": " << jsonString(markup.labels[n]) << ", ";
      stream << "\"position\": [" << p.x << ", " << p.y << ", " << p.z << "]}";
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
