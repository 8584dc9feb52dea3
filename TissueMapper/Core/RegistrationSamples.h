// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Input of the registration: both images at one resolution, and random sample points of the fixed one.

#include "Grid.h"
#include "LinearMap.h"
#include "MutualInformation.h"
#include "ScalarImage.h"

#include <vector>

namespace surgicalmesher
{

/// Clamps the image to its quantiles of 0.2 % and 99.8 %: extreme values would leave few histogram bins to the tissues.
/// Throws InputError if these quantiles are equal, or if an axis has fewer than eight voxels; `which` names the image
/// in the message.
ItkImage::Pointer withoutExtremes(const ScalarImage& image, const char* which);

/// Blurs and subsamples the image to voxels of about `spacing` (mm). Returns the image itself if its largest voxel edge
/// is at least `spacing`.
ItkImage::Pointer coarser(const ItkImage::Pointer& image, double spacing);

/// Returns `count` random points (world), uniform in the box of the fixed image's voxel centres, where the mask is set;
/// an empty mask is set everywhere. The points are the same on any machine. Throws InputError if hardly any point
/// qualifies.
std::vector<Vec3> samplesEverywhere(const Grid& grid, const std::vector<bool>& mask, int count);

/// The same, with the density of a Gaussian of this standard deviation (mm) around a point of the world.
std::vector<Vec3> samplesAround(const Grid& grid, const std::vector<bool>& mask, const Vec3& centre, double deviation,
                                int count);

/// Centroid and spread of points; the spread is the lever of rotations and stretches.
struct Extent
{
  Vec3 centre;
  double radius = 0; ///< root mean square distance to the centroid, mm
};

Extent extentOf(const std::vector<Vec3>& points);

/// Root mean square distance (mm) between the images of points under two maps, for points distributed as `extent` says.
double distanceBetween(const LinearMap& a, const LinearMap& b, const Extent& extent);

/// Images and samples at one resolution.
struct Level
{
  ItkImage::Pointer fixed;
  ItkImage::Pointer moving;
  MutualInformation::Samples::Pointer samples;

  MutualInformation information(const Vec3& centre) const { return { fixed, moving, samples, centre }; }
};

/// Returns both images in voxels of about `spacing` (mm), with the samples.
Level levelOf(const ItkImage::Pointer& fixed, const ItkImage::Pointer& moving, double spacing,
              const std::vector<Vec3>& samples);

} // namespace surgicalmesher
