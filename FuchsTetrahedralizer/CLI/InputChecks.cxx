// SPDX-License-Identifier: Apache-2.0
#include "InputChecks.h"

#include "Errors.h"

#include <algorithm>
#include <cmath>
#include <locale>
#include <sstream>

namespace surgicalmesher
{

namespace
{

constexpr double kTetrahedronVolume = 0.11785; ///< of a regular one with edge 1
constexpr double kBytesPerTetrahedron = 700;   ///< spheres of 10^4 to 10^5 take 570 and 40 MB; the rest is margin

std::string rounded(double value)
{
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text.precision(3);
  text << value;
  return text.str();
}

struct Bounds
{
  Vec3 low, high;
};

Bounds boundsOf(const std::vector<Vec3>& points)
{
  Bounds bounds{ points.front(), points.front() };
  for (const Vec3& p : points)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      bounds.low[axis] = std::min(bounds.low[axis], p[axis]);
      bounds.high[axis] = std::max(bounds.high[axis], p[axis]);
    }
  }
  return bounds;
}

/// Enclosed by all tissues together: faces between two of them cancel out.
double enclosedVolume(const SurfaceComplex& surface)
{
  double volume = 0;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
  {
    const auto& [a, b, c] = surface.triangles[t];
    const int sign = (surface.labels[t][0] != 0) - (surface.labels[t][1] != 0);
    volume += sign * dot(surface.points[a], cross(surface.points[b], surface.points[c])) / 6;
  }
  return std::abs(volume);
}

std::string textOf(const Vec3& p)
{
  return "(" + rounded(p.x) + ", " + rounded(p.y) + ", " + rounded(p.z) + ") mm LPS";
}

} // namespace

void requireMillimetres(const SurfaceComplex& surface, const SizingFunction& edgeLength, const std::string& name)
{
  if (surface.points.empty()) return;
  const Bounds bounds = boundsOf(surface.points);
  const double diagonal = norm(bounds.high - bounds.low), length = edgeLength(0.5 * (bounds.low + bounds.high));
  if (diagonal >= length) return;
  throw InputError(name + ": the whole surface is " + rounded(diagonal) + " mm across, shorter than one edge of " +
                   rounded(length) + " mm; expected millimetres" +
                   (diagonal < 2 ? ", found what look like metres" : ""));
}

double estimateTetrahedra(const SurfaceComplex& surface, const SizingFunction& edgeLength)
{
  if (surface.points.empty()) return 0;
  constexpr int samples = 24;
  const Bounds bounds = boundsOf(surface.points);
  double perVolume = 0;
  for (int n = 0; n < samples * samples * samples; ++n)
  {
    const std::array<int, 3> at{ n % samples, n / samples % samples, n / (samples * samples) };
    Vec3 p;
    for (int axis = 0; axis < 3; ++axis)
      p[axis] = bounds.low[axis] + (at[axis] + 0.5) / samples * (bounds.high[axis] - bounds.low[axis]);
    perVolume += 1 / (kTetrahedronVolume * std::pow(edgeLength(p), 3));
  }
  return enclosedVolume(surface) * perVolume / (samples * samples * samples);
}

void requireMemoryFor(double tetrahedra, const std::optional<std::uint64_t>& available, const std::string& name)
{
  const double needed = tetrahedra * kBytesPerTetrahedron;
  if (!available || needed <= double(*available)) return;
  throw InputError(name + ": at these edge lengths it takes about " + rounded(tetrahedra / 1e6) +
                   " million tetrahedra and " + rounded(needed / 1e9) + " GB of memory, found " +
                   rounded(double(*available) / 1e9) + " GB available, expected longer edges");
}

std::vector<std::string> warningsOfPlaces(const ConstitutiveRule& rule, const SurfaceComplex& surface)
{
  const Bounds bounds = boundsOf(surface.points);
  const auto isOutside = [&](const Vec3& p)
  {
    bool outside = false;
    for (int axis = 0; axis < 3; ++axis) outside = outside || p[axis] < bounds.low[axis] || p[axis] > bounds.high[axis];
    return outside;
  };
  std::vector<std::string> warnings;
  for (const Vec3& target : rule.targets)
  {
    if (isOutside(target)) warnings.push_back("target " + textOf(target) + " lies outside the surface");
  }
  for (const Path& path : rule.paths)
  {
    if (std::all_of(path.begin(), path.end(), isOutside))
      warnings.push_back("the path from " + textOf(path.front()) + " lies outside the surface");
  }
  return warnings;
}

std::string warningOfStillness(const std::vector<std::int32_t>& constitutive)
{
  constexpr std::int32_t nullDisplacement = 2;
  const bool isStill = !constitutive.empty() && std::all_of(constitutive.begin(), constitutive.end(),
                                                            [](std::int32_t tag) { return tag == nullDisplacement; });
  return isStill ? "every tetrahedron is null displacement, so that nothing will move; are targets and paths in LPS mm?"
                 : std::string();
}

std::string warningOfMaterials(const FiniteElementOptions& options, const std::set<Label>& present,
                               const TissueTable& names, const std::string& file)
{
  std::string missing;
  int count = 0;
  for (const Label label : present)
  {
    if (options.materials.count(label) > 0) continue;
    const auto found = names.find(label);
    const bool isNamed = found != names.end() && !found->second.name.empty();
    missing += (missing.empty() ? "" : ", ") + (isNamed ? found->second.name : "tissue " + std::to_string(label));
    ++count;
  }
  if (count == 0) return {};
  return file + ": no row for " + std::to_string(count) + " of " + std::to_string(present.size()) +
         " tissues, which get the default of soft tissue, 3 kPa: " + missing;
}

} // namespace surgicalmesher
