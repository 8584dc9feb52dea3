// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A head without symmetry, as CT and MR see it, in any pose.

#include "LinearMap.h"
#include "ScalarImage.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <random>

namespace surgicalmesher::test
{

/// As large as a head; the figures below are two thirds of it. 0 air, 1 soft tissue, 2 bone, 3 brain, 4 fluid, 5 fat; p in mm.
inline int phantomTissue(const Vec3& world)
{
  const Vec3 p = world / 1.5;
  const auto ellipsoid = [&](const Vec3& centre, const Vec3& half)
  {
    const Vec3 d{ (p.x - centre.x) / half.x, (p.y - centre.y) / half.y, (p.z - centre.z) / half.z };
    return squaredNorm(d) < 1;
  };
  if (ellipsoid({ 4, -58, -22 }, { 7, 14, 10 })) return 1; // a nose
  if (!ellipsoid({}, { 48, 60, 52 })) return 0;
  if (!ellipsoid({}, { 43, 55, 47 })) return p.z < -20 ? 5 : 1;
  if (ellipsoid({ 10, -34, -26 }, { 9, 12, 10 })) return 0;                                          // a sinus
  if (ellipsoid({ -18, -44, -6 }, { 8, 8, 8 }) || ellipsoid({ 20, -43, -6 }, { 8, 8, 8 })) return 4; // eyes
  const double overBase = p.z + 22 + 0.35 * p.y;
  if (overBase < 0) return overBase > -5 ? 2 : 1;
  if (!ellipsoid({ 0, 3, 4 }, { 38, 48, 40 })) return 2;
  if (ellipsoid({ -12, 6, 10 }, { 6, 20, 9 }) || ellipsoid({ 14, 14, -6 }, { 5, 8, 14 })) return 4;
  return 3;
}

constexpr std::array<float, 6> ctBrightness{ -1000, 50, 900, 35, 8, -90 };
constexpr std::array<float, 6> mrBrightness{ 4, 80, 15, 120, 40, 160 };
constexpr Vec3 phantomTarget{ 8, -35, -30 }; ///< beside the sinus
constexpr double phantomScale = 1.03;

/// From the world of an image in this pose to the phantom's: a turn of 13 degrees about z and of 6 about x, a scale of
/// 1.03 and a shift.
inline LinearMap poseOff()
{
  const double a = 13 * 3.14159265358979 / 180;
  const double b = 6 * 3.14159265358979 / 180;
  LinearMap map;
  map.rows = { Vec3{ std::cos(a), -std::sin(a), 0 },
               Vec3{ std::sin(a) * std::cos(b), std::cos(a) * std::cos(b), -std::sin(b) },
               Vec3{ std::sin(a) * std::sin(b), std::cos(a) * std::sin(b), std::cos(b) } };
  for (Vec3& row : map.rows) row = phantomScale * row;
  map.offset = { 14, -10, 18 };
  return map;
}

/// Voxels of 3.75 mm, each the mean of eight points.
inline ScalarImage registrationPhantom(const std::function<Vec3(const Vec3&)>& toPhantom,
                                       const std::array<float, 6>& brightness)
{
  ScalarImage image;
  image.grid.size = { 56, 62, 58 };
  image.grid.spacing = { 3.75, 3.75, 3.75 };
  image.grid.origin = { -105, -120, -108 };
  std::mt19937 random(5);
  std::normal_distribution<float> normal(0, 0.02f * (brightness[2] - brightness[0]));
  for (int k = 0; k < image.grid.size[2]; ++k)
    for (int j = 0; j < image.grid.size[1]; ++j)
      for (int i = 0; i < image.grid.size[0]; ++i)
      {
        float sum = 0;
        for (int part = 0; part < 8; ++part)
        {
          const Vec3 offset{ (part & 1) - 0.5, (part >> 1 & 1) - 0.5, (part >> 2 & 1) - 0.5 };
          const Vec3 p = image.grid.gridToWorld(image.grid.position(i, j, k) + 1.875 * offset);
          sum += brightness[std::size_t(phantomTissue(toPhantom(p)))] / 8;
        }
        image.values.push_back(sum + normal(random));
      }
  return image;
}

/// Largest distance (mm) between where `map` brings points within `radius` of the target and where poseOff() has them.
inline double worstError(const LinearMap& map, double radius)
{
  double worst = 0;
  const LinearMap pose = poseOff();
  for (int corner = 0; corner < 8; ++corner)
  {
    const Vec3 side{ corner & 1 ? 1.0 : -1.0, corner & 2 ? 1.0 : -1.0, corner & 4 ? 1.0 : -1.0 };
    const Vec3 p = phantomTarget + radius / std::sqrt(3.0) * side;
    worst = std::max(worst, norm(pose(map(p)) - p));
  }
  return worst;
}

} // namespace surgicalmesher::test
