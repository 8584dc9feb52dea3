// SPDX-License-Identifier: Apache-2.0
#include "NodeChoices.h"

#include "Errors.h"
#include "Text.h"
#include "TissueMapIO.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <set>

namespace surgicalmesher
{
namespace
{

constexpr double kTolerance = 1e-6; ///< mm

std::optional<std::vector<double>> numbersIn(const std::vector<std::string>& words)
{
  std::vector<double> numbers;
  for (const std::string& word : words)
  {
    double number = 0;
    if (!text::parseNumber(word, number)) return {};
    numbers.push_back(number);
  }
  return numbers;
}

std::optional<NodeChoice> findChoice(const std::string& text)
{
  const std::size_t colon = text.rfind(':');
  if (colon == std::string::npos) return {};
  NodeChoice choice;
  choice.name = text::trimmed(text.substr(0, colon));
  std::vector<std::string> words = text::splitWords(text.substr(colon + 1));
  if (choice.name.empty() || words.empty()) return {};
  const std::string shape = words.front();
  words.erase(words.begin());
  const auto found = numbersIn(words);
  if (!found || found->size() != (shape == "sphere" ? 4 : 6)) return {};
  const std::vector<double>& n = *found;
  choice.a = { n[0], n[1], n[2] };
  if (shape == "sphere")
  {
    choice.shape = NodeShape::Sphere;
    choice.radius = n[3];
    if (choice.radius <= 0) return {};
    return choice;
  }
  choice.b = { n[3], n[4], n[5] };
  choice.shape = shape == "box" ? NodeShape::Box : NodeShape::HalfSpace;
  if (shape == "box" || (shape == "plane" && norm(choice.b) > 0)) return choice;
  return {};
}

/// Throws InputError for a point farther from the mesh than the mesh is large: it belongs to another mesh or has other
/// units.
std::int32_t nearestNode(const NodeChoice& choice, const std::vector<Vec3>& points)
{
  const Vec3& place = choice.a;
  const auto nearest =
    std::min_element(points.begin(), points.end(),
                     [&](const Vec3& p, const Vec3& q) { return squaredNorm(p - place) < squaredNorm(q - place); });
  Vec3 low = points[0], high = points[0];
  for (const Vec3& p : points)
    for (int axis = 0; axis < 3; ++axis)
      low[axis] = std::min(low[axis], p[axis]), high[axis] = std::max(high[axis], p[axis]);
  const double distance = norm(*nearest - place);
  if (distance <= norm(high - low)) return static_cast<std::int32_t>(nearest - points.begin());
  throw InputError("--nodeMarkups " + choice.name + ": a point " + text::rounded(distance, 4) +
                   " mm from the mesh, which is " + text::rounded(norm(high - low), 4) +
                   " mm large, expected points at its nodes");
}

bool isWithin(const NodeChoice& choice, const Vec3& p)
{
  if (choice.shape == NodeShape::Sphere) return norm(p - choice.a) <= choice.radius + kTolerance;
  if (choice.shape == NodeShape::TurnedBox)
  {
    for (int i = 0; i < 3; ++i)
      if (std::abs(dot(p - choice.a, choice.axes[i])) > choice.size[i] / 2 + kTolerance) return false;
    return true;
  }
  if (choice.shape == NodeShape::HalfSpace) return dot(p - choice.a, choice.b) >= -kTolerance * norm(choice.b);
  for (int axis = 0; axis < 3; ++axis)
  {
    const auto [low, high] = std::minmax({ choice.a[axis], choice.b[axis] });
    if (p[axis] < low - kTolerance || p[axis] > high + kTolerance) return false;
  }
  return true;
}

} // namespace

std::vector<NodeChoice> nodeChoices(const std::vector<std::string>& texts)
{
  std::vector<NodeChoice> choices;
  for (const std::string& text : texts)
  {
    const std::optional<NodeChoice> choice = findChoice(text);
    if (!choice)
      throw UsageError("--nodeSet: \"" + text +
                       "\" found, NAME: box X Y Z X Y Z, NAME: sphere X Y Z RADIUS or NAME: plane X Y Z NX NY NZ "
                       "expected (markups are for --nodeMarkups)");
    choices.push_back(*choice);
  }
  return choices;
}

std::vector<NodeChoice> nodeChoicesOfMarkups(const std::string& file)
{
  const std::string name = std::filesystem::path(file).stem().stem().string(); // .mrk.json
  std::vector<NodeChoice> choices;
  for (const Markup& markup : readLabelledMarkups(file))
  {
    NodeChoice choice;
    choice.name = name;
    if (markup.region)
    {
      const bool isPlane = markup.type == "Plane";
      choice.shape = isPlane ? NodeShape::HalfSpace : NodeShape::TurnedBox;
      choice.a = markup.region->center;
      choice.b = markup.region->axes[2];
      choice.axes = markup.region->axes;
      choice.size = markup.region->size;
      choices.push_back(choice);
      continue;
    }
    if (markup.type != "Fiducial" && !markup.type.empty())
      throw InputError(file + ": a markup of type \"" + markup.type + "\" found, points, a plane or an ROI expected");
    choice.shape = NodeShape::NearestNode;
    for (const Vec3& point : markup.points)
    {
      choice.a = point;
      choices.push_back(choice);
    }
  }
  return choices;
}

std::vector<NodeChoice> nodeChoices(const std::vector<std::string>& texts, const std::vector<std::string>& markups)
{
  std::vector<NodeChoice> choices = nodeChoices(texts);
  for (const std::string& file : markups)
  {
    for (const NodeChoice& choice : nodeChoicesOfMarkups(file)) choices.push_back(choice);
  }
  return choices;
}

std::map<std::string, std::vector<std::int32_t>> chosenNodes(const std::vector<NodeChoice>& choices,
                                                             const std::vector<Vec3>& points)
{
  std::map<std::string, std::set<std::int32_t>> members;
  for (const NodeChoice& choice : choices)
  {
    std::set<std::int32_t>& some = members[choice.name];
    if (choice.shape == NodeShape::NearestNode)
    {
      some.insert(nearestNode(choice, points));
      continue;
    }
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      if (isWithin(choice, points[i])) some.insert(static_cast<std::int32_t>(i));
    }
  }
  std::map<std::string, std::vector<std::int32_t>> result;
  for (const auto& [name, ids] : members)
  {
    if (ids.empty()) throw InputError("--nodeSet " + name + ": no point of the mesh is there, at least one expected");
    result[name].assign(ids.begin(), ids.end());
  }
  return result;
}

} // namespace surgicalmesher
