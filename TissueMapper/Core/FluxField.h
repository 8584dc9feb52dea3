// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Flux of an image's gradient into spheres of several radii: large where a bright tube of a matching radius has its
/// axis.
///
/// With M(x, R) the mean of the image over the sphere of radius R around x, the outward flux of the gradient through
/// that sphere, over its area, is dM/dR (divergence theorem; Vasilevskiy and Siddiqi, IEEE TPAMI 24(12), 2002). In the
/// frequency domain that is a product with (cos kR - sin kR / kR) / R, exact up to the sampling frequency and the same
/// whatever the voxel's shape. The image is blurred a little first, the more the larger the sphere.

#include "Progress.h"
#include "ScalarImage.h"

#include <vector>

namespace surgicalmesher
{

struct FluxField
{
  Grid grid;                            ///< that of the image
  std::vector<double> radii;            ///< of tubes, mm, ascending
  std::vector<std::vector<float>> flux; ///< by radius and voxel: -R dM/dR for R = sphereRadius(), in the image's unit
};

/// Radius of the sphere whose flux tells of a tube: the square root of 2 times the tube's, mm.
double sphereRadius(double tubeRadius);

/// Deviation of the Gaussian that the image is blurred by before the flux into a sphere of this radius is taken, mm. It
/// makes the sphere a shell of some thickness, over which noise averages out.
double sphereBlur(double sphereRadius);

/// `count` radii from the smallest to the largest, each the same multiple of the one before.
std::vector<double> radiiBetween(double smallest, double largest, int count);

/// Bytes that computeFlux() needs at its peak for a grid of this size.
double fluxMemory(const std::array<int, 3>& size, std::size_t radii);

/// `radii` in mm. The same bytes whatever the number of threads.
FluxField computeFlux(const ScalarImage& image, const std::vector<double>& radii, const Progress& progress = {});

/// Some of a field's radii that follow each other, by number: from `begin` to before `end`.
struct RadiusRange
{
  std::size_t begin = 0;
  std::size_t end = 0;
};

/// Largest flux of these radii by voxel, at least 0; `sign` is 1 for bright tubes, -1 for dark ones.
std::vector<float> strongestFlux(const FluxField& field, int sign, const RadiusRange& range);

} // namespace surgicalmesher
