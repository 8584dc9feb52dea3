// SPDX-License-Identifier: Apache-2.0
#include "LandmarkLists.h"

#include "Errors.h"
#include "MarkupsInput.h"
#include "ThinPlateSpline.h"

#include <vtkMRMLMarkupsNode.h>

#include <algorithm>
#include <cmath>

namespace surgicalmesher
{
namespace
{

std::vector<std::string> namesIn(vtkMRMLMarkupsNode* list) { return labelledPoints(list).labels; }

bool has(const std::vector<std::string>& names, const std::string& name)
{
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// Returns the first name of `there` that `here` lacks, or else the first of L1, L2, ... that neither has.
std::string nextName(const std::vector<std::string>& here, const std::vector<std::string>& there)
{
  for (const std::string& name : there)
  {
    if (!has(here, name)) return name;
  }
  for (int n = 1;; ++n)
  {
    const std::string name = "L" + std::to_string(n);
    if (!has(here, name)) return name;
  }
}

std::map<std::string, double> leftOutByName(vtkMRMLMarkupsNode* onTemplate, vtkMRMLMarkupsNode* onTarget)
{
  const LandmarkPairs pairs = commonPairs(onTemplate, onTarget);
  std::map<std::string, double> errors;
  try
  {
    requireUsable(pairs, "template", "patient");
  }
  catch (const Error&)
  {
    return errors; // too few pairs yet
  }
  const std::vector<double> found = leftOutErrors(pairs.source, pairs.target);
  for (std::size_t i = 0; i < found.size(); ++i)
  {
    if (std::isfinite(found[i])) errors[pairs.names[i]] = found[i];
  }
  return errors;
}

double valueOr(const std::map<std::string, double>& values, const std::string& name, double otherwise)
{
  const auto found = values.find(name);
  return found == values.end() ? otherwise : found->second;
}

} // namespace

NamedPoints namedPoints(vtkMRMLMarkupsNode* list)
{
  const Markup markup = labelledPoints(list);
  NamedPoints result{ list && list->GetName() ? list->GetName() : "landmarks", markup.labels,
                      Points(3, Eigen::Index(markup.points.size())) };
  for (std::size_t i = 0; i < markup.points.size(); ++i)
    result.points.col(Eigen::Index(i)) = Eigen::Vector3d(markup.points[i].x, markup.points[i].y, markup.points[i].z);
  return result;
}

LandmarkPairs commonPairs(vtkMRMLMarkupsNode* onTemplate, vtkMRMLMarkupsNode* onTarget)
{
  const NamedPoints source = namedPoints(onTemplate), target = namedPoints(onTarget);
  std::vector<Eigen::Index> inSource, inTarget;
  LandmarkPairs pairs;
  for (std::size_t i = 0; i < source.names.size(); ++i)
  {
    const std::string& name = source.names[i];
    const auto count = [&name](const NamedPoints& list)
    { return std::count(list.names.begin(), list.names.end(), name); };
    if (count(source) != 1 || count(target) != 1) continue;
    pairs.names.push_back(name);
    inSource.push_back(Eigen::Index(i));
    inTarget.push_back(std::find(target.names.begin(), target.names.end(), name) - target.names.begin());
  }
  pairs.source = source.points(Eigen::all, inSource);
  pairs.target = target.points(Eigen::all, inTarget);
  return pairs;
}

std::vector<LandmarkRow> landmarkRows(vtkMRMLMarkupsNode* onTemplate, vtkMRMLMarkupsNode* onTarget,
                                      const std::map<std::string, double>& fitted)
{
  const std::vector<std::string> inTemplate = namesIn(onTemplate), inTarget = namesIn(onTarget);
  const std::map<std::string, double> leftOut = leftOutByName(onTemplate, onTarget);
  std::vector<LandmarkRow> rows;
  for (const std::string& name : inTemplate)
    rows.push_back({ name, true, has(inTarget, name), valueOr(leftOut, name, -1), valueOr(fitted, name, -1) });
  for (const std::string& name : inTarget)
  {
    if (!has(inTemplate, name)) rows.push_back({ name, false, true, -1, -1 });
  }
  return rows;
}

bool isTurnOfTarget(vtkMRMLMarkupsNode* onTemplate, vtkMRMLMarkupsNode* onTarget)
{
  const std::vector<std::string> inTemplate = namesIn(onTemplate), inTarget = namesIn(onTarget);
  return std::any_of(inTemplate.begin(), inTemplate.end(),
                     [&](const std::string& name) { return !has(inTarget, name); });
}

void nameNextLandmarks(vtkMRMLMarkupsNode* onTemplate, vtkMRMLMarkupsNode* onTarget)
{
  const std::vector<std::string> inTemplate = namesIn(onTemplate), inTarget = namesIn(onTarget);
  if (onTemplate) labelNewPoints(onTemplate, nextName(inTemplate, inTarget));
  if (onTarget) labelNewPoints(onTarget, nextName(inTarget, inTemplate));
}

void removeLandmark(const std::string& name, vtkMRMLMarkupsNode* onTemplate, vtkMRMLMarkupsNode* onTarget)
{
  for (vtkMRMLMarkupsNode* list : { onTemplate, onTarget })
  {
    for (int n = list ? list->GetNumberOfControlPoints() - 1 : -1; n >= 0; --n)
    {
      const bool isPlaced = list->GetNthControlPointPositionStatus(n) == vtkMRMLMarkupsNode::PositionDefined;
      if (isPlaced && list->GetNthControlPointLabel(n) == name) list->RemoveNthControlPoint(n);
    }
  }
}

} // namespace surgicalmesher
