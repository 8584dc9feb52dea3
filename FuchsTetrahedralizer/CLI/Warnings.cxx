// SPDX-License-Identifier: Apache-2.0
#include "Warnings.h"

#include "Place.h"
#include "SurfacePreparation.h"
#include "Text.h"

#include <algorithm>

namespace surgicalmesher
{

std::vector<std::string> warningsOfPlaces(const ConstitutiveRule& rule, const SurfaceComplex& surface)
{
  const vtkBoundingBox box = boxAround(surface);
  const auto isOutside = [&](const Vec3& p) { return !box.ContainsPoint(p.x, p.y, p.z); };
  std::vector<std::string> warnings;
  for (const Vec3& target : rule.targets)
  {
    if (isOutside(target)) warnings.push_back("target " + place(target, 3) + " LPS lies outside the surface");
  }
  for (const Path& path : rule.paths)
  {
    if (std::all_of(path.begin(), path.end(), isOutside))
      warnings.push_back("the path from " + place(path.front(), 3) + " LPS lies outside the surface");
  }
  return warnings;
}

std::string warningOfLengths(const SurfaceComplex& surface, const SizingFunction& length)
{
  constexpr double most = 2; // gradation and thin tissues cause smaller deviations
  std::vector<double> ratios;
  for (const auto& corners : surface.triangles)
    for (int k = 0; k < 3; ++k)
    {
      const Vec3 &p = surface.points[corners[k]], &q = surface.points[corners[(k + 1) % 3]];
      ratios.push_back(norm(q - p) / length(0.5 * (p + q)));
    }
  if (ratios.empty()) return {};
  const auto middle = ratios.begin() + std::ptrdiff_t(ratios.size() / 2);
  std::nth_element(ratios.begin(), middle, ratios.end());
  if (*middle <= most && *middle >= 1 / most) return {};
  return "edges of the surface are " + text::rounded(*middle, 2) +
         " times as long as their target (median), and tetrahedra beside it follow them; was it made for other lengths?";
}

std::string warningOfStillness(const std::vector<std::int32_t>& constitutive)
{
  constexpr std::int32_t nullDisplacement = 2;
  const bool isStill = !constitutive.empty() && std::all_of(constitutive.begin(), constitutive.end(),
                                                            [](std::int32_t tag) { return tag == nullDisplacement; });
  return isStill ? "every tetrahedron is null displacement, so that nothing will move; are targets and paths in LPS mm?"
                 : std::string();
}

} // namespace surgicalmesher
