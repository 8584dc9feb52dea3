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

std::string warningOfLengths(const SurfaceFile& surface, const SizingFunction& length)
{
  constexpr double most = 2; // lengths that followed single tissues are shorter than the scale, but only there
  std::vector<double> ratios;
  for (std::size_t p = 0; p < surface.targetEdgeLength.size(); ++p)
    ratios.push_back(surface.targetEdgeLength[p] / length(surface.surface.points[p]));
  if (ratios.empty()) return {};
  const auto median = ratios.begin() + std::ptrdiff_t(ratios.size() / 2);
  std::nth_element(ratios.begin(), median, ratios.end());
  if (*median <= most && *median >= 1 / most) return {};
  return "the surface was made for edges " + text::rounded(*median, 2) +
         " times as long as those asked for here (median), and keeps them; expected the scale or edge length that it "
         "was made with";
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
