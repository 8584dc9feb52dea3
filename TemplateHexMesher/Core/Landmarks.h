// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Landmark pairs, and the checks that a spline through them needs.

#include "ElementMesh.h"

#include <Eigen/Geometry>

#include <string>
#include <vector>

namespace surgicalmesher
{

struct NamedPoints
{
  std::string file; ///< for messages
  std::vector<std::string> names;
  Points points;
};

struct LandmarkPairs
{
  std::vector<std::string> names;
  Points source, target; ///< a column per name
};

/// Pairs landmarks by name, in the order of `source`. Throws InputError if a name occurs twice in one list, or in one
/// list only.
LandmarkPairs pairedByName(const NamedPoints& source, const NamedPoints& target);

/// Returns the similarity (rotation, one scale, translation) that best maps source to target in the least-squares
/// sense.
Eigen::Affine3d similarityOf(const LandmarkPairs& pairs);

/// Throws InputError with both file names for fewer than four pairs; for coincident points; for points that lie in a
/// line or a plane (on either side: thinner than a hundredth of their size); for landmarks that a mirror image fits at
/// least twice as well; and for sizes that differ by more than a factor of four, as if the units differed.
void requireUsable(const LandmarkPairs& pairs, const std::string& sourceFile, const std::string& targetFile);

/// Throws InputError with both file names for a landmark whose distance from the bounding box of `mesh` exceeds half of
/// the box's diagonal: it belongs to another mesh, or to another frame.
void requireNear(const NamedPoints& landmarks, const Points& mesh, const std::string& meshFile);

} // namespace surgicalmesher
