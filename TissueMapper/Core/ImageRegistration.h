// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Registration of two images of one head, such as MR to CT, by mutual information: first of the whole images, then of
/// the surroundings of a target (Audette et al., section 2.1: locally weighted registration).

#include "LinearMap.h"
#include "Progress.h"
#include "ScalarImage.h"

#include <optional>
#include <string>
#include <vector>

namespace surgicalmesher
{

/// What the initial poses align.
enum class RegistrationStart
{
  Centre,        ///< centroids of what is brighter than the background; axes as they are or turned by 180 degrees
  PrincipalAxes, ///< centroids and principal axes of what is brighter than the background
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
  std::vector<Vec3> fixedLandmarks; ///< world; three or more if `start` is Landmarks
  /// World of the moving image; in the order of `fixedLandmarks`.
  std::vector<Vec3> movingLandmarks;
  std::optional<Sphere> target; ///< in the fixed image's world; without one there is no local stage
  std::vector<bool> mask;       ///< voxels of the fixed image to sample; empty: all
};

struct Registration
{
  LinearMap global;               ///< from the fixed image's world to the moving image's: rotation, shift and one scale
  std::optional<LinearMap> local; ///< from and to the same worlds, with all twelve parameters
  double scale = 1;               ///< scale of `global`
  double startInformation = 0;    ///< of the best start on coarse images: mutual information (nats) times overlap
  double globalInformationBefore = 0; ///< mutual information (nats) of the whole images at that start, on the finest
  double globalInformation = 0;       ///< the same at `global`
  double targetInformationBefore = 0; ///< around the target, at `global`
  double targetInformation = 0;       ///< around the target, at `local`
  int agreeingStarts = 0;             ///< how many of the other starts converge to within 3 mm of the best pose
  int otherStarts = 0;

  const LinearMap& finest() const { return local ? *local : global; }
};

/// Maximises Mattes' mutual information (Mattes et al., SPIE 4322, 2001) by quasi-Newton steps over the seven
/// parameters of a similarity: from many starts on coarse images, then from the best result on finer ones. Around the
/// target it then maximises over all twelve parameters; the density of samples there is a Gaussian whose sigma is half
/// the target's radius. Throws InputError if the result is not reliable: too few other starts lead to the best pose, a
/// distant pose is as good, less than 20 % of the fixed image overlaps, or a stage moves too far from the one before or
/// changes the scale too much. The result is bitwise the same for any number of threads.
Registration registerImages(const ScalarImage& fixed, const ScalarImage& moving, const RegistrationOptions& options,
                            const Progress& progress = {});

/// Resamples the moving image to `grid` by linear interpolation. Voxels outside the moving image get its least value.
ScalarImage resampled(const ScalarImage& moving, const LinearMap& map, const Grid& grid);

} // namespace surgicalmesher
