// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Flux of an image's gradient into spheres of several radii. The flux is large on the axis of a bright tube whose
/// radius matches the sphere's.
///
/// With M(x, R) the mean of the image over the sphere of radius R around x, the outward flux of the gradient through
/// that sphere, divided by the sphere's area, is dM/dR (divergence theorem; Vasilevskiy and Siddiqi, IEEE TPAMI 24(12),
/// 2002). In the frequency domain dM/dR is a product with (cos kR - sin kR / kR) / R, which is exact up to the sampling
/// frequency and independent of the voxel's shape. The image is first blurred by sphereBlur(), which grows with the
/// sphere.

#include "Progress.h"
#include "ScalarImage.h"

#include <vector>

namespace surgicalmesher
{

struct FluxField
{
  Grid grid;                            ///< that of the image
  std::vector<double> radii;            ///< tube radii, mm, ascending
  std::vector<std::vector<float>> flux; ///< by radius and voxel: -R dM/dR for R = sphereRadius(), in the image's unit
};

/// Radius (mm) of the sphere used to detect a tube: sqrt(2) times the radius of the tube.
double sphereRadius(double tubeRadius);

/// Standard deviation (mm) of the Gaussian blur applied to the image before the flux into a sphere of this radius is
/// computed. The blur gives the sphere a shell of finite thickness, over which noise averages out.
double sphereBlur(double sphereRadius);

/// Returns `count` radii in geometric progression from the smallest to the largest.
std::vector<double> radiiBetween(double smallest, double largest, int count);

/// Peak memory of computeFlux(), bytes.
double fluxMemory(const std::array<int, 3>& size, std::size_t radii);

/// Computes the flux of all radii (mm). The result is bitwise the same for any number of threads.
FluxField computeFlux(const ScalarImage& image, const std::vector<double>& radii, const Progress& progress = {});

/// A contiguous range of a field's radii, by index: from `begin` up to but not including `end`.
struct RadiusRange
{
  std::size_t begin = 0;
  std::size_t end = 0;
};

/// Returns the largest flux over a range of radii at each voxel, at least 0; `sign` is 1 for bright tubes, -1 for dark
/// ones.
std::vector<float> strongestFlux(const FluxField& field, int sign, const RadiusRange& range);

} // namespace surgicalmesher
