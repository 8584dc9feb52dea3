// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Vessels and nerves traced between a few points: minimal paths through the flux of the image's gradient, refined to
/// the axis of the tube, with its radius (Audette et al., MICCAI 2003 workshop paper, section 4).

#include "Progress.h"
#include "ScalarImage.h"

#include <vector>

namespace surgicalmesher
{

enum class Polarity
{
  Bright,   ///< the tube is brighter than its surroundings
  Dark,     ///< the tube is darker than its surroundings
  Automatic ///< chosen by the flux at the given points
};

/// What the front runs along.
enum class Potential
{
  Flux,     ///< flux of the gradient into spheres: axes of tubes
  Gradient, ///< magnitude of the gradient: edges, the classical potential of minimal paths
  Intensity ///< the smoothed image, from its median to its value at the points
};

struct TubePathOptions
{
  double minimumRadius = 0; ///< of tubes, mm; 0: half a voxel length
  double maximumRadius = 0; ///< of tubes, mm; 0: three and a half voxel lengths
  Polarity polarity = Polarity::Automatic;
  Potential potential = Potential::Flux;
  double snapDistance = 2; ///< largest distance (mm) by which a point is moved to the tube; 0: points stay
  double margin = 30;      ///< enlargement (mm) on each side of the bounding box of the points, which limits the search
};

/// A tube along a polyline; world frame, mm.
struct TubePath
{
  std::vector<Vec3> points;  ///< about half a voxel apart
  std::vector<double> radii; ///< by point, mm
  std::vector<double> flux;  ///< by point: strongest flux of all radii, in the image's unit; positive on the tube
  bool isBright = true;
};

/// Traces a tube through `places` (world, mm), two or more in the order of the tube. The path enters no tube in
/// `blocked`. Throws InputError for places outside the image, places that coincide along the tube, a place where no
/// tube is found, if blocked tubes leave no way from one place to the next, and, unless the potential is Flux, for an
/// image of fewer than four voxels along an axis; UsageError if the smallest radius is above the largest. The result is
/// bitwise the same for any number of threads.
TubePath traceTube(const ScalarImage& image, const std::vector<Vec3>& places, const std::vector<TubePath>& blocked,
                   const TubePathOptions& options, const Progress& progress = {});

/// Peak memory of traceTube(), bytes.
double tubePathMemory(const Grid& grid, const std::vector<Vec3>& places, const TubePathOptions& options);

} // namespace surgicalmesher
