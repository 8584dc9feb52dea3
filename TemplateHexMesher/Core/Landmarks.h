// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Pairs of landmarks, and what a spline of them needs.

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

/// Pairs by name, in the order of `source`. Throws InputError for a name that stands twice in a file, or in one alone.
LandmarkPairs pairedByName(const NamedPoints& source, const NamedPoints& target);

/// The similarity (rotation, one scale, translation) that takes source to target best in the sense of least squares.
Eigen::Affine3d similarityOf(const LandmarkPairs& pairs);

/// Throws InputError, naming both files, for fewer than four pairs; for points of which two coincide, or that lie in a
/// line or a plane (either side: thinner than a hundredth of its size); for landmarks that a mirror image fits twice as
/// well; and for sides whose sizes differ by more than a factor of four, as they do in different units.
void requireUsable(const LandmarkPairs& pairs, const std::string& sourceFile, const std::string& targetFile);

/// Throws InputError, naming both files, for a landmark farther from the box around `mesh` than half its diagonal: it is
/// another mesh's, or in another frame.
void requireNear(const NamedPoints& landmarks, const Points& mesh, const std::string& meshFile);

} // namespace surgicalmesher
