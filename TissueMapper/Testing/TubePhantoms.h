// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Images of tubes whose axes are known, built from nothing: the mean over every voxel of tubes on a background, with
/// noise.

#include "PathRefinement.h"
#include "Sampling.h"
#include "TubePath.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <vector>

namespace surgicalmesher::test
{

/// A rotation and a shift, so that no draw lies on the grid as another does.
struct Placement
{
  std::array<Vec3, 3> axes{ Vec3{ 1, 0, 0 }, Vec3{ 0, 1, 0 }, Vec3{ 0, 0, 1 } };
  Vec3 shift;
  Vec3 operator()(const Vec3& p) const { return shift + p.x * axes[0] + p.y * axes[1] + p.z * axes[2]; }
};

inline Placement randomPlacement(std::mt19937& random)
{
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> part(-0.5, 0.5);
  Placement placement;
  Vec3 a{ normal(random), normal(random), normal(random) };
  const Vec3 b{ normal(random), normal(random), normal(random) };
  a = a / norm(a);
  Vec3 c = cross(a, b);
  c = c / norm(c);
  placement.axes = { a, cross(c, a), c };
  placement.shift = { part(random), part(random), part(random) };
  return placement;
}

/// A tube with points 0.1 mm apart and its contrast at each.
struct PhantomTube
{
  std::vector<Vec3> axis;
  double radius = 1;
  std::vector<double> contrast;
};

/// curve(s) for s in [-overhang, length + overhang], s close to arc length.
inline PhantomTube tubeAlong(const std::function<Vec3(double)>& curve, double length, double radius,
                             double overhang = 4)
{
  PhantomTube tube;
  tube.radius = radius;
  for (double s = -overhang; s <= length + overhang; s += 0.1) tube.axis.push_back(curve(s));
  tube.contrast.assign(tube.axis.size(), 1);
  return tube;
}

inline Vec3 helixPoint(double s, double bendRadius)
{
  const double a = 0.8 * bendRadius; // with pitch b = a / 2 the curvature is a / (a^2 + b^2) = 1 / bendRadius
  const double b = 0.5 * a;
  const double angle = s / std::sqrt(a * a + b * b);
  return { a * std::cos(angle) - a * 0.5, a * std::sin(angle) - a * 0.5, b * angle - b };
}

/// Grid of cubic voxels around points, at least `margin` mm beyond them.
inline Grid gridAround(const std::vector<PhantomTube>& tubes, double margin, const Vec3& spacing = { 1, 1, 1 })
{
  Vec3 low{ 1e9, 1e9, 1e9 };
  Vec3 high{ -1e9, -1e9, -1e9 };
  for (const PhantomTube& tube : tubes)
  {
    for (const Vec3& p : tube.axis)
    {
      for (int axis = 0; axis < 3; ++axis)
      {
        low[axis] = std::min(low[axis], p[axis]);
        high[axis] = std::max(high[axis], p[axis]);
      }
    }
  }
  Grid grid;
  grid.spacing = spacing;
  for (int axis = 0; axis < 3; ++axis)
  {
    grid.origin[axis] = std::floor(low[axis] - margin);
    grid.size[axis] = int(std::ceil((high[axis] + margin - grid.origin[axis]) / spacing[axis])) + 1;
  }
  return grid;
}

/// The mean of the tubes over every voxel, by `parts`^3 samples in each; where two overlap the larger contrast counts.
inline ScalarImage drawTubes(const Grid& grid, const std::vector<PhantomTube>& tubes, int parts = 5)
{
  const std::array<std::size_t, 3> fine{ std::size_t(grid.size[0]) * parts, std::size_t(grid.size[1]) * parts,
                                         std::size_t(grid.size[2]) * parts };
  std::vector<unsigned char> sample(fine[0] * fine[1] * fine[2], 0);
  const Vec3 spacing = grid.spacing / parts;
  for (const PhantomTube& tube : tubes)
  {
    for (std::size_t n = 0; n < tube.axis.size(); ++n)
    {
      const unsigned char value = (unsigned char)(std::lround(250 * tube.contrast[n]));
      const Vec3 p = grid.worldToGrid(tube.axis[n]) + 0.5 * grid.spacing - 0.5 * spacing; // sample 0 lies at 0
      std::array<int, 3> low, high;
      for (int axis = 0; axis < 3; ++axis)
      {
        low[axis] = std::max(0, int(std::ceil((p[axis] - tube.radius) / spacing[axis])));
        high[axis] = std::min(int(fine[axis]) - 1, int(std::floor((p[axis] + tube.radius) / spacing[axis])));
      }
      for (int k = low[2]; k <= high[2]; ++k)
        for (int j = low[1]; j <= high[1]; ++j)
          for (int i = low[0]; i <= high[0]; ++i)
          {
            const Vec3 d = Vec3{ i * spacing.x, j * spacing.y, k * spacing.z } - p;
            if (squaredNorm(d) > tube.radius * tube.radius) continue;
            unsigned char& old = sample[(std::size_t(k) * fine[1] + j) * fine[0] + i];
            old = std::max(old, value);
          }
    }
  }
  ScalarImage image{ grid, std::vector<float>(grid.voxelCount(), 0) };
  const float share = 1.f / (250.f * parts * parts * parts);
  for (std::size_t k = 0; k < fine[2]; ++k)
    for (std::size_t j = 0; j < fine[1]; ++j)
      for (std::size_t i = 0; i < fine[0]; ++i)
      {
        const unsigned char value = sample[(k * fine[1] + j) * fine[0] + i];
        if (value) image.values[grid.index(int(i / parts), int(j / parts), int(k / parts))] += share * value;
      }
  return image;
}

inline void addNoise(ScalarImage& image, double deviation, std::mt19937& random)
{
  std::normal_distribution<float> noise(0, float(deviation));
  for (float& value : image.values) value += noise(random);
}

/// Distances of each point of `from` to the polyline `to`: their mean and the largest.
inline std::array<double, 2> distancesTo(const std::vector<Vec3>& from, const std::vector<Vec3>& to)
{
  double sum = 0;
  double largest = 0;
  for (const Vec3& p : from)
  {
    double best = std::numeric_limits<double>::infinity();
    for (std::size_t n = 1; n < to.size(); ++n)
    {
      const Vec3 edge = to[n] - to[n - 1];
      const double square = squaredNorm(edge);
      const double t = square > 0 ? std::clamp(dot(p - to[n - 1], edge) / square, 0.0, 1.0) : 0;
      best = std::min(best, squaredNorm(p - to[n - 1] - t * edge));
    }
    sum += std::sqrt(best);
    largest = std::max(largest, std::sqrt(best));
  }
  return { sum / double(from.size()), largest };
}

struct PathError
{
  double mean = 0;    ///< mm, the larger of both ways
  double largest = 0; ///< mm
};

/// Both ways between a path and the true axis between its two places.
inline PathError pathError(const std::vector<Vec3>& path, const std::vector<Vec3>& truth)
{
  const std::array<double, 2> there = distancesTo(resampled(path, 0.2), truth);
  const std::array<double, 2> back = distancesTo(resampled(truth, 0.2), path);
  return { std::max(there[0], back[0]), std::max(there[1], back[1]) };
}

/// A scene of one tube to find, with whatever else is in it.
struct TubeScene
{
  std::vector<PhantomTube> tubes; ///< the first is the one sought
  std::vector<Vec3> truth;        ///< its axis between the first and the last place
  std::vector<Vec3> places;
};

inline TubeScene sceneOf(std::vector<PhantomTube> tubes, double overhang = 4)
{
  TubeScene scene;
  scene.tubes = std::move(tubes);
  const std::vector<Vec3>& axis = scene.tubes.front().axis;
  const std::size_t cut = std::size_t(std::lround(overhang / 0.1));
  scene.truth.assign(axis.begin() + std::ptrdiff_t(cut), axis.end() - std::ptrdiff_t(cut));
  scene.places = { scene.truth.front(), scene.truth.back() };
  return scene;
}

inline void addGap(PhantomTube& tube, double centre, double length, double contrast)
{
  const double middle = centre * double(tube.axis.size());
  for (std::size_t n = 0; n < tube.axis.size(); ++n)
  {
    if (std::abs(double(n) - middle) < 0.5 * length / 0.1) tube.contrast[n] = contrast;
  }
}

inline TubeScene helixScene(const Placement& place, double radius, double gapLength = 0)
{
  PhantomTube tube = tubeAlong([&](double s) { return place(helixPoint(s, 20)); }, 45, radius);
  if (gapLength > 0) addGap(tube, 0.5, gapLength, 0.3);
  return sceneOf({ tube });
}

/// Two straight tubes whose axes meet at 60 degrees.
inline TubeScene crossingScene(const Placement& place, double radius)
{
  const double pi = 3.14159265358979323846;
  const auto line = [&](double angle)
  {
    return tubeAlong(
      [&place, angle](double s) {
        return place((s - 20) * Vec3{ std::cos(angle), std::sin(angle), 0 });
      },
      40, radius);
  };
  return sceneOf({ line(0), line(pi / 3) });
}

/// Two arcs of bend radius 20 that curve away from each other, one voxel between their walls where they are nearest;
/// with a gap in the sought one at that place if asked for.
inline TubeScene kissingScene(const Placement& place, double radius, double gapLength = 0)
{
  const auto arc = [&](double side)
  {
    return tubeAlong(
      [&place, side, radius](double s)
      {
        const double angle = (s - 20) / 20;
        return place({ side * (radius + 0.5 + 20 * (1 - std::cos(angle))), 20 * std::sin(angle), 0 });
      },
      40, radius);
  };
  PhantomTube sought = arc(1);
  if (gapLength > 0) addGap(sought, 0.5, gapLength, 0.3);
  return sceneOf({ sought, arc(-1) });
}

/// A coil of this bend radius, its places half a turn apart.
inline TubeScene coilScene(const Placement& place, double radius, double bendRadius)
{
  const double pi = 3.14159265358979323846;
  const double a = 0.8 * bendRadius;
  const double perHalfTurn = pi * a * std::sqrt(1.25);
  TubeScene scene =
    sceneOf({ tubeAlong([&](double s) { return place(helixPoint(s, bendRadius)); }, 4 * perHalfTurn, radius) });
  scene.places.clear();
  for (int n = 0; n <= 4; ++n) scene.places.push_back(place(helixPoint(n * perHalfTurn, bendRadius)));
  return scene;
}

} // namespace surgicalmesher::test
