// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Constitutive classes by distance from the surgery: a nonlinear law where tissue deforms most, a linear one farther
/// away, and null displacement farthest away (Audette et al., Computer Aided Surgery 12(1), 2007).

#include "Distance.h"
#include "TetMesh.h"

#include <vector>

namespace surgicalmesher
{

/// Constitutive classes, as stored in MeshFile::constitutive.
constexpr std::int32_t kLinear = 0, kNonlinear = 1, kNullDisplacement = 2;

struct ConstitutiveRule : Focus
{
  double nonlinearDistance = 0; ///< mm from a target or path; 0: classes are unchanged
  /// Nonlinear distance at the target end of paths, mm; along a path, the distance varies linearly with arc length from
  /// nonlinearDistance at the entry to this value. 0: constant along the path.
  double nonlinearDistanceAtTarget = 0;
  // Null displacement; the members have the same meaning as in NullDisplacementOptions.
  double nullTargetRadius = 0;
  double nullPathDistance = 0;
  double nullPathDistanceAtTarget = 0;
};

/// Throws UsageError if a distance is negative or not finite, if there is no target or path to measure a distance from,
/// or if there is a target or path but no distance.
void checkConstitutiveRule(const ConstitutiveRule& rule);

/// Sets the classes (0 linear, 1 nonlinear, 2 null displacement) of tetrahedra by the positions of their centroids:
/// nonlinear up to the nonlinear distance from the nearest target or path, linear beyond; null displacement where a
/// centroid is both beyond the radius of every target and outside the tube around every path. Tetrahedra of class 2
/// keep it. Tetrahedra and rule must be in the same frame. Throws as checkConstitutiveRule does.
void tagByDistance(const TetMesh& mesh, const ConstitutiveRule& rule, std::vector<std::int32_t>& constitutive);

} // namespace surgicalmesher
