// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What registration compares: the two images at one coarseness, and random places of the fixed one.

#include "Grid.h"
#include "LinearMap.h"
#include "MutualInformation.h"
#include "ScalarImage.h"

#include <vector>

namespace surgicalmesher
{

/// The image without its extremes, which would leave the tissues few of the histogram's bins. Throws InputError for one
/// of a single value or of fewer than eight voxels along an axis; `which` names it.
ItkImage::Pointer withoutExtremes(const ScalarImage& image, const char* which);

/// The image in voxels of about `spacing` (mm), blurred as they ask; itself if its own are as large.
ItkImage::Pointer coarser(const ItkImage::Pointer& image, double spacing);

/// `count` random places (world) between the fixed image's voxels where the mask, if it isn't empty, is set; the same
/// on any machine. Throws InputError if hardly a place counts.
std::vector<Vec3> samplesEverywhere(const Grid& grid, const std::vector<bool>& mask, int count);

/// The same, as dense as a Gaussian of this deviation (mm) around a place of the world.
std::vector<Vec3> samplesAround(const Grid& grid, const std::vector<bool>& mask, const Vec3& centre, double deviation,
                                int count);

/// Where the samples are, and how far they scatter: what a turn or a stretch moves them by.
struct Extent
{
  Vec3 centre;
  double radius = 0; ///< root mean square distance, mm
};

Extent extentOf(const std::vector<Vec3>& points);

/// Root mean square distance between what two maps make of points that scatter as the extent says, mm.
double distanceBetween(const LinearMap& a, const LinearMap& b, const Extent& extent);

/// Images and samples at one coarseness.
struct Level
{
  ItkImage::Pointer fixed;
  ItkImage::Pointer moving;
  MutualInformation::Samples::Pointer samples;

  MutualInformation information(const Vec3& centre) const { return { fixed, moving, samples, centre }; }
};

/// Both images in voxels of about `spacing` (mm), with samples there.
Level levelOf(const ItkImage::Pointer& fixed, const ItkImage::Pointer& moving, double spacing,
              const std::vector<Vec3>& samples);

} // namespace surgicalmesher
