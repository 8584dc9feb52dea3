// SPDX-License-Identifier: Apache-2.0
#include "ConstitutiveTags.h"

#include "Errors.h"

#include <algorithm>

namespace surgicalmesher
{
namespace
{

/// `atTarget` 0 stands for `atEntry`.
bool isInTube(const Vec3& x, const std::vector<Path>& paths, double atEntry, double atTarget)
{
  return std::any_of(paths.begin(), paths.end(),
                     [&](const Path& path)
                     { return distanceToTube(x, path, atEntry, atTarget > 0 ? atTarget : atEntry) <= 0; });
}

bool isNear(const Vec3& x, const ConstitutiveRule& rule)
{
  return distanceToPoints(x, rule.targets) <= rule.nonlinearDistance ||
         isInTube(x, rule.paths, rule.nonlinearDistance, rule.nonlinearDistanceAtTarget);
}

bool isHeldStill(const Vec3& x, const ConstitutiveRule& rule)
{
  if (rule.nullTargetRadius == 0 && rule.nullPathDistance == 0) return false;
  if (rule.nullTargetRadius > 0 && distanceToPoints(x, rule.targets) <= rule.nullTargetRadius) return false;
  return rule.nullPathDistance == 0 || !isInTube(x, rule.paths, rule.nullPathDistance, rule.nullPathDistanceAtTarget);
}

} // namespace

void checkConstitutiveRule(const ConstitutiveRule& rule)
{
  for (const double distance : { rule.nonlinearDistance, rule.nonlinearDistanceAtTarget, rule.nullTargetRadius,
                                 rule.nullPathDistance, rule.nullPathDistanceAtTarget })
  {
    if (!(std::isfinite(distance) && distance >= 0))
    {
      throw UsageError("a constitutive distance is negative or not finite, expected 0 mm or more");
    }
  }
  const bool hasPlace = !rule.targets.empty() || !rule.paths.empty();
  const bool hasDistance = rule.nonlinearDistance > 0 || rule.nullTargetRadius > 0 || rule.nullPathDistance > 0;
  if (rule.nonlinearDistance > 0 && !hasPlace) throw UsageError("a nonlinear distance is given, but no target or path");
  if (rule.nullTargetRadius > 0 && rule.targets.empty())
    throw UsageError("a null-displacement radius is given, but no target");
  if (rule.nullPathDistance > 0 && rule.paths.empty())
    throw UsageError("a null-displacement path distance is given, but no path");
  if (rule.nullPathDistanceAtTarget > 0 && rule.nullPathDistance == 0)
    throw UsageError("a null-displacement path distance at the target is given, but none at the entry");
  if (rule.nonlinearDistanceAtTarget > 0 && (rule.nonlinearDistance == 0 || rule.paths.empty()))
    throw UsageError("a nonlinear distance at the target is given, but no path or none at its entry");
  if (hasPlace && !hasDistance)
    throw UsageError("a target or path is given, but neither a nonlinear nor a null-displacement distance");
}

void tagByDistance(const TetMesh& mesh, const ConstitutiveRule& rule, std::vector<std::int32_t>& constitutive)
{
  checkConstitutiveRule(rule);
  for (std::size_t t = 0; t < constitutive.size(); ++t)
  {
    std::int32_t& tag = constitutive[t];
    if (tag == kNullDisplacement) continue;
    const auto& [a, b, c, d] = mesh.tetrahedra[t];
    const Vec3 centroid = 0.25 * (mesh.points[a] + mesh.points[b] + mesh.points[c] + mesh.points[d]);
    if (rule.nonlinearDistance > 0) tag = isNear(centroid, rule) ? kNonlinear : kLinear;
    if (isHeldStill(centroid, rule)) tag = kNullDisplacement;
  }
}

} // namespace surgicalmesher
