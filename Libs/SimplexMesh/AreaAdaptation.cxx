// SPDX-License-Identifier: Apache-2.0
#include "AreaAdaptation.h"

#include "SimplexDeformation.h"

#include <algorithm>

namespace surgicalmesher
{

namespace
{

struct FaceArea
{
  double ratio; ///< area over target area
  std::int32_t face;
};

std::vector<FaceArea> areasWhere(const SimplexOperators& mesh, const TargetArea& target,
                                 const std::function<bool(double)>& holds)
{
  std::vector<FaceArea> faces;
  for (std::int32_t a = 0; a < std::int32_t(mesh.points().size()); ++a)
  {
    if (!mesh.alive(a)) continue;
    const double ratio = mesh.area(a) / target(mesh.points()[a]);
    if (holds(ratio)) faces.push_back({ ratio, a });
  }
  return faces;
}

/// Fuses face a with the neighbour of the highest merit among those with which its area stays below `largest`.
bool fuseFace(SimplexOperators& mesh, std::int32_t a, double largest)
{
  std::vector<std::pair<double, std::int32_t>> choices;
  for (std::int32_t b : mesh.faceNeighbours(a))
    if (mesh.area(a) + mesh.area(b) <= largest) choices.emplace_back(-mesh.fusion(a, b), b);
  std::sort(choices.begin(), choices.end());
  return std::any_of(choices.begin(), choices.end(),
                     [&](const auto& choice) { return choice.first < 0 && mesh.fuse(a, choice.second); });
}

} // namespace

AreaCounts adaptAreas(SimplexOperators& mesh, const TargetArea& target, double tolerance)
{
  AreaCounts counts;
  std::vector<FaceArea> small = areasWhere(mesh, target, [&](double ratio) { return ratio < 1 - tolerance; });
  std::stable_sort(small.begin(), small.end(), [](const auto& x, const auto& y) { return x.ratio < y.ratio; });
  for (const auto& [ratio, a] : small)
  {
    if (!mesh.alive(a)) continue;
    const double wanted = target(mesh.points()[a]);
    if (mesh.area(a) < (1 - tolerance) * wanted) counts.t1 += fuseFace(mesh, a, (1 + tolerance) * wanted);
  }
  std::vector<FaceArea> large = areasWhere(mesh, target, [&](double ratio) { return ratio > 1 + tolerance; });
  std::stable_sort(large.begin(), large.end(), [](const auto& x, const auto& y) { return x.ratio > y.ratio; });
  for (const auto& [ratio, a] : large)
    if (mesh.area(a) > (1 + tolerance) * target(mesh.points()[a])) counts.t2 += mesh.cut(a);
  counts.t7 = swapEdges(mesh);
  return counts;
}

double shareWithinTolerance(const SimplexOperators& mesh, const TargetArea& target, double tolerance)
{
  const std::size_t within =
    areasWhere(mesh, target, [&](double ratio) { return std::abs(ratio - 1) <= tolerance; }).size();
  return double(within) / double(std::max<std::size_t>(1, mesh.faceCount()));
}

} // namespace surgicalmesher
