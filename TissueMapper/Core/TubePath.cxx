// SPDX-License-Identifier: Apache-2.0
#include "TubePath.h"

#include "Errors.h"
#include "FluxField.h"
#include "ItkImage.h"
#include "MinimalPath.h"
#include "PathRefinement.h"
#include "Place.h"
#include "Sampling.h"

#include <itkGradientMagnitudeRecursiveGaussianImageFilter.h>
#include <itkSmoothingRecursiveGaussianImageFilter.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

namespace surgicalmesher
{

namespace
{

constexpr int radiusCount = 8;
constexpr int leastVoxels = 4;      // along each axis, for ITK's recursive Gaussians
constexpr float leastSpeed = 0.03f; // relative to the speed on the tube: lets the front cross gaps

/// A box of voxels, from `low` to `high` inclusive.
struct Box
{
  std::array<int, 3> low;
  std::array<int, 3> high;
};

/// Widens the box to leastVoxels along every axis on which the grid has as many.
void widen(const Grid& grid, Box& box)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    const int size = std::min(leastVoxels, grid.size[axis]);
    const int missing = std::max(0, size - (box.high[axis] - box.low[axis] + 1));
    box.low[axis] = std::clamp(box.low[axis] - missing / 2, 0, grid.size[axis] - size);
    box.high[axis] = std::max(box.high[axis], box.low[axis] + size - 1);
  }
}

Box boxAround(const Grid& grid, const std::vector<Vec3>& places, double margin)
{
  Box box{ grid.size, { 0, 0, 0 } };
  for (const Vec3& point : places)
  {
    const Vec3 p = grid.worldToGrid(point);
    for (int axis = 0; axis < 3; ++axis)
    {
      const double last = grid.size[axis] - 1;
      const double reach = margin / grid.spacing[axis];
      const double index = p[axis] / grid.spacing[axis];
      box.low[axis] = std::min(box.low[axis], int(std::clamp(std::floor(index - reach), 0.0, last)));
      box.high[axis] = std::max(box.high[axis], int(std::clamp(std::ceil(index + reach), 0.0, last)));
    }
  }
  widen(grid, box);
  return box;
}

ScalarImage cropped(const ScalarImage& image, const Box& box)
{
  ScalarImage crop;
  crop.grid = image.grid;
  for (int axis = 0; axis < 3; ++axis) crop.grid.size[axis] = box.high[axis] - box.low[axis] + 1;
  crop.grid.origin = image.grid.gridToWorld(voxelCentre(image.grid, box.low));
  crop.values.reserve(crop.grid.voxelCount());
  for (int k = box.low[2]; k <= box.high[2]; ++k)
  {
    for (int j = box.low[1]; j <= box.high[1]; ++j)
    {
      const auto row = image.values.begin() + std::ptrdiff_t(image.grid.index(box.low[0], j, k));
      crop.values.insert(crop.values.end(), row, row + crop.grid.size[0]);
    }
  }
  return crop;
}

std::vector<double> tubeRadii(const Grid& grid, const TubePathOptions& options)
{
  const double voxel = voxelLength(grid);
  const double smallest = options.minimumRadius > 0 ? options.minimumRadius : 0.5 * voxel;
  const double largest = options.maximumRadius > 0 ? options.maximumRadius : 3.5 * voxel;
  if (smallest > largest)
  {
    throw UsageError("radius: the smallest, " + std::to_string(smallest) + " mm, is above the largest, " +
                     std::to_string(largest) + " mm");
  }
  return radiiBetween(smallest, largest, radiusCount);
}

/// Clamps a radius to the range asked for, which the best fit may leave.
double withinAsked(double radius, const TubePathOptions& options)
{
  const double largest = options.maximumRadius > 0 ? options.maximumRadius : std::numeric_limits<double>::infinity();
  return std::clamp(radius, options.minimumRadius, largest);
}

/// Returns the position with the highest value within `snapDistance` of p, with a penalty on distance; p itself if
/// snapDistance is 0.
Vec3 snapped(const Grid& grid, const std::vector<float>& ridge, const Vec3& p, double snapDistance)
{
  if (!(snapDistance > 0)) return p;
  constexpr int steps = 8;
  Vec3 best = p;
  double highest = -1;
  for (int k = -steps; k <= steps; ++k)
  {
    for (int j = -steps; j <= steps; ++j)
    {
      for (int i = -steps; i <= steps; ++i)
      {
        const Vec3 offset = (snapDistance / steps) * Vec3{ double(i), double(j), double(k) };
        const double share = squaredNorm(offset) / (snapDistance * snapDistance);
        if (share > 1 || !isInVolume(grid, p + offset)) continue;
        const double value = linearValue(grid, ridge, p + offset) * (1 - 0.5 * share);
        if (value > highest)
        {
          highest = value;
          best = p + offset;
        }
      }
    }
  }
  return best;
}

template <typename Filter>
std::vector<float> filtered(const ScalarImage& image, double sigma)
{
  const auto filter = Filter::New();
  filter->SetInput(asItkImage<ItkImage>(inGridFrame(image.grid), image.values));
  filter->SetSigma(sigma);
  filter->Update();
  return valuesOf(*filter->GetOutput());
}

/// Potential for Gradient and Intensity, at least 0, by voxel.
std::vector<float> ridgeOf(const ScalarImage& image, int sign, Potential potential)
{
  const double sigma = 0.7 * voxelLength(image.grid);
  if (potential == Potential::Gradient)
    return filtered<itk::GradientMagnitudeRecursiveGaussianImageFilter<ItkImage, ItkImage>>(image, sigma);
  std::vector<float> values =
    filtered<itk::SmoothingRecursiveGaussianImageFilter<ItkImage, ItkImage>>(image, 0.7 * voxelLength(image.grid));
  std::vector<float> sorted = values;
  std::nth_element(sorted.begin(), sorted.begin() + std::ptrdiff_t(sorted.size() / 2), sorted.end());
  const float median = sorted[sorted.size() / 2];
  for (float& value : values) value = std::max(0.f, sign * (value - median));
  return values;
}

/// Returns 1 for a bright tube, -1 for a dark one; if automatic, by the flux at the places.
int signOf(const FluxField& field, const std::vector<Vec3>& places, const TubePathOptions& options)
{
  if (options.polarity != Polarity::Automatic) return options.polarity == Polarity::Bright ? 1 : -1;
  double sum = 0;
  for (const Vec3& point : places)
  {
    double strongest[2] = { 0, 0 };
    for (const std::vector<float>& flux : field.flux)
    {
      const double here = linearValue(field.grid, flux, point);
      strongest[0] = std::max(strongest[0], here);
      strongest[1] = std::max(strongest[1], -here);
    }
    sum += strongest[0] - strongest[1];
  }
  return sum >= 0 ? 1 : -1;
}

void markBall(const Grid& grid, const Vec3& centre, double radius, std::vector<bool>& isIn)
{
  std::array<int, 3> low, high;
  for (int axis = 0; axis < 3; ++axis)
  {
    low[axis] = std::max(0, int(std::ceil((centre[axis] - radius) / grid.spacing[axis])));
    high[axis] = std::min(grid.size[axis] - 1, int(std::floor((centre[axis] + radius) / grid.spacing[axis])));
  }
  for (int k = low[2]; k <= high[2]; ++k)
    for (int j = low[1]; j <= high[1]; ++j)
      for (int i = low[0]; i <= high[0]; ++i)
      {
        if (norm(voxelCentre(grid, { i, j, k }) - centre) <= radius) isIn[grid.index(i, j, k)] = true;
      }
}

/// Voxels whose centre lies in one of the tubes.
std::vector<bool> voxelsIn(const Grid& grid, const std::vector<TubePath>& tubes)
{
  std::vector<bool> isIn(grid.voxelCount(), false);
  for (const TubePath& tube : tubes)
  {
    for (std::size_t n = 1; n < tube.points.size(); ++n)
    {
      const Vec3 edge = tube.points[n] - tube.points[n - 1];
      const int parts = std::max(1, int(std::ceil(norm(edge) / (0.25 * voxelLength(grid)))));
      for (int m = 0; m <= parts; ++m)
      {
        const double t = double(m) / parts;
        markBall(grid, grid.worldToGrid(tube.points[n - 1] + t * edge), (1 - t) * tube.radii[n - 1] + t * tube.radii[n],
                 isIn);
      }
    }
  }
  return isIn;
}

/// Speed of the front: the ridge relative to its mean at two positions, at most 1, plus leastSpeed; 0 in blocked
/// voxels.
std::vector<float> speedBetween(const Grid& grid, const std::vector<float>& ridge, const std::vector<bool>& isBlocked,
                                const Vec3& first, const Vec3& second)
{
  const double reference = 0.5 * (linearValue(grid, ridge, first) + linearValue(grid, ridge, second));
  std::vector<float> speed(ridge.size());
  for (std::size_t n = 0; n < ridge.size(); ++n)
    speed[n] = isBlocked[n] ? 0.f : leastSpeed + std::min(1.f, float(ridge[n] / reference));
  return speed;
}

void requirePlaces(const ScalarImage& image, const std::vector<Vec3>& places)
{
  if (places.size() < 2) throw InputError("a path needs two points or more, found " + std::to_string(places.size()));
  for (const Vec3& point : places)
  {
    if (!isInVolume(image.grid, image.grid.worldToGrid(point)))
      throw InputError("point " + place(point) + " LPS lies outside the image, expected a place in it");
  }
}

/// The field that the front and the refinement follow; grid frame.
struct Ridge
{
  const Grid& grid;
  std::vector<float> values;             ///< by voxel, at least 0
  std::function<double(const Vec3&)> at; ///< between voxels
};

/// Ridge of the strongest flux over a range of radii. Between voxels, the maximum of interpolated fluxes is used: it is
/// smoother than the interpolated maximum.
Ridge fluxRidge(const FluxField& field, int sign, const RadiusRange& range)
{
  const auto at = [&field, sign, range](const Vec3& p)
  {
    double strongest = 0;
    for (std::size_t r = range.begin; r < range.end; ++r)
      strongest = std::max(strongest, sign * cubicValue(field.grid, field.flux[r], p));
    return strongest;
  };
  return { field.grid, strongestFlux(field, sign, range), at };
}

/// Rejects points that coincide along the tube, such as points side by side across it.
void requireLength(const Grid& grid, const std::vector<Vec3>& path)
{
  if (polylineLength(path) > 0.01 * voxelLength(grid)) return;
  throw InputError("the points lie in one place along the tube, at " + place(grid.gridToWorld(path.front())) +
                   " LPS, expected two or more apart");
}

/// Returns the axis of the tube that runs through the places, in steps of half a voxel length.
std::vector<Vec3> axisThrough(const Ridge& ridge, const std::vector<bool>& isBlocked, const std::vector<Vec3>& places,
                              const char* polarity, const TubePathOptions& options, const Progress& progress)
{
  const Grid& grid = ridge.grid;
  std::vector<Vec3> knots;
  for (const Vec3& given : places)
  {
    knots.push_back(snapped(grid, ridge.values, given, options.snapDistance));
    if (linearValue(grid, ridge.values, knots.back()) > 0) continue;
    throw InputError("point " + place(grid.gridToWorld(given)) + " LPS lies on no " + polarity +
                     " tube of the radii sought, expected a place on one, or other radii");
  }
  std::vector<Vec3> path{ knots.front() };
  for (std::size_t n = 1; n < knots.size(); ++n)
  {
    report(progress, double(n - 1) / double(knots.size()), "minimal path");
    const std::vector<float> speed = speedBetween(grid, ridge.values, isBlocked, knots[n - 1], knots[n]);
    const std::vector<Vec3> part = minimalPath(grid, speed, knots[n - 1], knots[n]);
    path.insert(path.end(), part.begin() + 1, part.end());
  }
  report(progress, 0.9, "refinement");
  path = refinedPath(grid, ridge.at, path);
  path = fittedToEnds(path, places.front(), places.back());
  requireLength(grid, path);
  return resampled(path, 0.5 * voxelLength(grid));
}

/// Returns the range of radii around those of the path where it is nearest to the places: the plausible radii of a tube
/// that runs from one place to the next.
RadiusRange radiiNearPlaces(const FluxField& field, const std::vector<Vec3>& path, const std::vector<double>& radii,
                            const std::vector<Vec3>& places)
{
  constexpr double reach = 1.6; // of a radius, up and down
  double least = field.radii.back(), largest = field.radii.front();
  for (const Vec3& p : places)
  {
    const auto nearer = [&](const Vec3& a, const Vec3& b) { return squaredNorm(a - p) < squaredNorm(b - p); };
    const double here = radii[std::size_t(std::min_element(path.begin(), path.end(), nearer) - path.begin())];
    least = std::min(least, here);
    largest = std::max(largest, here);
  }
  const auto begin = std::lower_bound(field.radii.begin(), field.radii.end() - 1, least / reach);
  const auto end = std::upper_bound(begin + 1, field.radii.end(), largest * reach);
  return { std::size_t(begin - field.radii.begin()), std::size_t(end - field.radii.begin()) };
}

} // namespace

double tubePathMemory(const Grid& grid, const std::vector<Vec3>& places, const TubePathOptions& options)
{
  const Box box = boxAround(grid, places, options.margin);
  std::array<int, 3> size;
  for (int axis = 0; axis < 3; ++axis) size[axis] = box.high[axis] - box.low[axis] + 1;
  const double voxels = double(size[0]) * size[1] * size[2];
  return 50e6 + fluxMemory(size, radiusCount) + 4 * voxels;
}

TubePath traceTube(const ScalarImage& image, const std::vector<Vec3>& places, const std::vector<TubePath>& blocked,
                   const TubePathOptions& options, const Progress& progress)
{
  requirePlaces(image, places);
  if (options.potential != Potential::Flux) requireVoxels(image.grid, leastVoxels, "to follow gradient or intensity");
  const ScalarImage crop = cropped(image, boxAround(image.grid, places, options.margin));
  const Grid& grid = crop.grid;
  const FluxField field = computeFlux(crop, tubeRadii(grid, options), subProgress(progress, 0, 0.6));
  std::vector<Vec3> given;
  for (const Vec3& point : places) given.push_back(grid.worldToGrid(point));
  const int sign = signOf(field, given, options);
  const std::vector<bool> isBlocked = voxelsIn(grid, blocked);
  const auto axis = [&](const Ridge& ridge, double from, double to)
  {
    return axisThrough(ridge, isBlocked, given, sign > 0 ? "bright" : "dark", options, subProgress(progress, from, to));
  };
  const RadiusRange all{ 0, field.radii.size() };
  std::vector<Vec3> path;
  if (options.potential == Potential::Flux)
  {
    path = axis(fluxRidge(field, sign, all), 0.6, 0.8);
    const RadiusRange near = radiiNearPlaces(field, path, radiiAlong(field, sign, path), given);
    path = axis(fluxRidge(field, sign, near), 0.8, 1);
  }
  else
  {
    const std::vector<float> values = ridgeOf(crop, sign, options.potential);
    path = axis({ grid, values, [&](const Vec3& p) { return cubicValue(grid, values, p); } }, 0.6, 1);
  }
  TubePath tube;
  tube.isBright = sign > 0;
  tube.radii = radiiAlong(field, sign, path);
  for (double& radius : tube.radii) radius = withinAsked(radius, options);
  const std::vector<float> strongest = strongestFlux(field, sign, all);
  for (const Vec3& p : path)
  {
    tube.points.push_back(grid.gridToWorld(p));
    tube.flux.push_back(linearValue(grid, strongest, p));
  }
  return tube;
}

} // namespace surgicalmesher
