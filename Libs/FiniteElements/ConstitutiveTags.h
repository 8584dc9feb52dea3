// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Constitutive classes by distance from the surgery: where tissue deforms most it is worth a nonlinear law, farther
/// away a linear one, and farthest it is held still (Audette et al., Computer Aided Surgery 12(1), 2007).

#include "Distance.h"
#include "TetMesh.h"

#include <vector>

namespace surgicalmesher
{

/// Constitutive classes, as MeshFile::constitutive has them.
constexpr std::int32_t kLinear = 0, kNonlinear = 1, kNullDisplacement = 2;

struct ConstitutiveRule : Focus
{
  double nonlinearDistance = 0; ///< mm from a target or path; 0: classes stay as they are
  /// mm; the distance from paths goes linearly with arc length from nonlinearDistance at the entry to this at the target
  /// end; 0: it is the same all along.
  double nonlinearDistanceAtTarget = 0;
  // Null displacement, with the meaning that NullDisplacementOptions gives to the same names.
  double nullTargetRadius = 0;
  double nullPathDistance = 0;
  double nullPathDistanceAtTarget = 0;
};

/// Throws UsageError if a distance is negative or not finite, or has no target or path to be measured from, or a target
/// or path has no distance to go with it.
void checkConstitutiveRule(const ConstitutiveRule& rule);

/// Changes the classes (0 linear, 1 nonlinear, 2 null displacement) of tetrahedra by where their centroids lie:
/// nonlinear up to the nonlinear distance from the nearest target or path and linear beyond; null displacement where a
/// centroid is both beyond the radius of every target and outside the tube around every path. What is null displacement
/// already stays so. Tetrahedra and rule in the same frame; throws as checkConstitutiveRule does.
void tagByDistance(const TetMesh& mesh, const ConstitutiveRule& rule, std::vector<std::int32_t>& constitutive);

} // namespace surgicalmesher
