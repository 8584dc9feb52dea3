// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Vessels and nerves as paths between a few points: minimal paths through the flux of the image's gradient, drawn to
/// the axis of the tube, with its radius (Audette et al., MICCAI 2003 workshop paper, section 4).

#include "Progress.h"
#include "ScalarImage.h"

#include <vector>

namespace surgicalmesher
{

enum class Polarity
{
  Bright,   ///< the tube is brighter than what is around it
  Dark,     ///< or darker
  Automatic ///< whichever of the two the flux at the points says
};

/// What the front runs along.
enum class Potential
{
  Flux,     ///< flux of the gradient into spheres: axes of tubes
  Gradient, ///< magnitude of the gradient: edges, as minimal paths had it before flux
  Intensity ///< the smoothed image between its median and its value at the points
};

struct TubePathOptions
{
  double minimumRadius = 0; ///< of tubes, mm; 0: half a voxel
  double maximumRadius = 0; ///< of tubes, mm; 0: three and a half voxels
  Polarity polarity = Polarity::Automatic;
  Potential potential = Potential::Flux;
  double snapDistance = 2; ///< mm: how far a point may be moved to the tube; 0 leaves points where they are
  double margin = 30;      ///< mm: the path is sought in the box of its points, larger by this on each side
};

/// A tube along a polyline; world frame, mm.
struct TubePath
{
  std::vector<Vec3> points;  ///< about half a voxel apart
  std::vector<double> radii; ///< by point, mm
  std::vector<double> flux;  ///< by point: strongest flux of all radii, in the image's unit; positive on the tube
  bool isBright = true;
};

/// `places`: two or more, in the order in which the tube runs through them. No front enters `blocked` tubes. Throws
/// InputError for places outside the image, all in one place along the tube, where there is none at all, or where blocked
/// tubes leave no way from one to the next. The same bytes whatever the number of threads.
TubePath traceTube(const ScalarImage& image, const std::vector<Vec3>& places, const std::vector<TubePath>& blocked,
                   const TubePathOptions& options, const Progress& progress = {});

/// Bytes that traceTube() needs at its peak.
double tubePathMemory(const Grid& grid, const std::vector<Vec3>& places, const TubePathOptions& options);

} // namespace surgicalmesher
