// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Registration of two images of one head, such as MR onto CT, by mutual information: of all, and then of what lies
/// around a target (Audette et al., section 2.1: locally weighted registration).

#include "LinearMap.h"
#include "Progress.h"
#include "ScalarImage.h"

#include <optional>
#include <string>
#include <vector>

namespace surgicalmesher
{

/// What the first guesses lay on each other.
enum class RegistrationStart
{
  Centre,        ///< centres of what is brighter than the background, frames as they are or turned by 180 degrees
  PrincipalAxes, ///< the principal axes of the same
  Landmarks      ///< landmarks, by least squares
};

struct Sphere
{
  Vec3 centre;
  double radius = 0; ///< mm
};

struct RegistrationOptions
{
  RegistrationStart start = RegistrationStart::Centre;
  std::vector<Vec3> fixedLandmarks; ///< world; three or more if the start is by landmarks
  std::vector<Vec3> movingLandmarks;
  std::optional<Sphere> target; ///< in the fixed image's world; without one there is no local stage
  std::vector<bool> mask;       ///< voxels of the fixed image that count; empty: all
};

struct Registration
{
  LinearMap global;               ///< from the fixed image's world to the moving one's: rotation and one scale
  std::optional<LinearMap> local; ///< the same, linear
  double scale = 1;               ///< of `global`
  double startInformation = 0;    ///< mutual information (nats) of all at the best start
  double globalInformation = 0;
  double targetInformationBefore = 0; ///< of what lies around the target, by the global map
  double targetInformation = 0;       ///< by the local map
  int agreeingStarts = 0;             ///< of the other starts, how many led within 3 mm of the best
  int otherStarts = 0;

  const LinearMap& finest() const { return local ? *local : global; }
};

/// Mattes' mutual information (Mattes et al., SPIE 4322, 2001) is maximised by quasi-Newton steps from many starts on
/// coarse images, then from the best of them on finer ones, with seven parameters. Around the target it is maximised
/// again with twelve; there, places count by a Gaussian whose sigma is half the radius, in the form of the density
/// of the samples. Throws InputError when hardly any other start leads to the best pose, when another place is as good,
/// and when hardly anything overlaps: then no pose is better than a wrong one. The same bytes whatever the number of
/// threads.
Registration registerImages(const ScalarImage& fixed, const ScalarImage& moving, const RegistrationOptions& options,
                            const Progress& progress = {});

/// The moving image at the voxels of `grid`, by linear interpolation; its least value where it does not reach.
ScalarImage resampled(const ScalarImage& moving, const LinearMap& map, const Grid& grid);

} // namespace surgicalmesher
