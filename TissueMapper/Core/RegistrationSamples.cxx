// SPDX-License-Identifier: Apache-2.0
#include "RegistrationSamples.h"

#include "Errors.h"
#include "Sampling.h"

#include <itkMath.h>
#include <itkShrinkImageFilter.h>
#include <itkSmoothingRecursiveGaussianImageFilter.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

namespace surgicalmesher
{

namespace
{

/// Random numbers that are the same on any machine, which the distributions of the standard library do not guarantee.
class Random
{
public:
  double uniform() { return (double(m_Engine()) + 0.5) / 4294967296.0; }
  double normal()
  {
    const double radius = std::sqrt(-2 * std::log(uniform()));
    return radius * std::cos(2 * itk::Math::pi * uniform());
  }

private:
  std::mt19937 m_Engine{ 20 };
};

/// Whether a point (grid frame) qualifies as a sample: it lies in the box of the voxel centres, where interpolation is
/// possible, and in the mask.
bool counts(const Grid& grid, const std::vector<bool>& mask, const Vec3& inGrid)
{
  const Vec3 index = toIndex(grid, inGrid);
  for (int axis = 0; axis < 3; ++axis)
  {
    if (!(index[axis] >= 0 && index[axis] <= grid.size[axis] - 1)) return false;
  }
  const std::array<int, 3> v = nearestVoxel(grid, inGrid);
  return mask.empty() || mask[grid.index(v[0], v[1], v[2])];
}

/// Calls draw(random) until `count` of the points qualify. Throws InputError if fewer than about one in a thousand
/// does.
template <typename Draw>
std::vector<Vec3> drawSamples(const Grid& grid, const std::vector<bool>& mask, int count, const char* where, Draw draw)
{
  std::vector<Vec3> samples;
  Random random;
  for (long tries = 0; int(samples.size()) < count; ++tries)
  {
    const Vec3 inGrid = draw(random);
    if (counts(grid, mask, inGrid)) samples.push_back(grid.gridToWorld(inGrid));
    if (tries > 1000L * count) throw InputError(std::string("hardly a voxel of the fixed image lies ") + where);
  }
  return samples;
}

} // namespace

ItkImage::Pointer withoutExtremes(const ScalarImage& image, const char* which)
{
  std::vector<float> some;
  const std::size_t stride = std::max<std::size_t>(1, image.values.size() / 500000);
  for (std::size_t n = 0; n < image.values.size(); n += stride) some.push_back(image.values[n]);
  const auto quantile = [&](double share)
  {
    const auto place = some.begin() + std::ptrdiff_t(share * double(some.size() - 1));
    std::nth_element(some.begin(), place, some.end());
    return *place;
  };
  const float low = quantile(0.002);
  const float high = quantile(0.998);
  if (!(low < high)) throw InputError(std::string("the ") + which + " image has one value nearly everywhere");
  for (const int size : image.grid.size)
  {
    if (size < 8) throw InputError(std::string("the ") + which + " image has fewer than eight voxels along an axis");
  }
  std::vector<float> values = image.values;
  for (float& value : values) value = std::clamp(value, low, high);
  return asItkImage<ItkImage>(image.grid, values);
}

ItkImage::Pointer coarser(const ItkImage::Pointer& image, double spacing)
{
  using Blur = itk::SmoothingRecursiveGaussianImageFilter<ItkImage, ItkImage>;
  using Shrink = itk::ShrinkImageFilter<ItkImage, ItkImage>;
  const auto shrink = Shrink::New();
  double largest = 0;
  for (unsigned axis = 0; axis < 3; ++axis)
  {
    const double own = image->GetSpacing()[axis];
    const int most = int(image->GetBufferedRegion().GetSize(axis)) / 4;
    shrink->SetShrinkFactor(axis, unsigned(std::clamp(int(spacing / own + 0.1), 1, most)));
    largest = std::max(largest, own);
  }
  if (largest >= spacing) return image;
  const auto blur = Blur::New();
  blur->SetInput(image);
  blur->SetSigma(0.6 * spacing);
  shrink->SetInput(blur->GetOutput());
  shrink->Update();
  const ItkImage::Pointer result = shrink->GetOutput();
  result->DisconnectPipeline();
  return result;
}

std::vector<Vec3> samplesEverywhere(const Grid& grid, const std::vector<bool>& mask, int count)
{
  return drawSamples(grid, mask, count, "in the mask",
                     [&](Random& random)
                     {
                       Vec3 p;
                       for (int axis = 0; axis < 3; ++axis)
                         p[axis] = random.uniform() * (grid.size[axis] - 1) * grid.spacing[axis];
                       return p;
                     });
}

std::vector<Vec3> samplesAround(const Grid& grid, const std::vector<bool>& mask, const Vec3& centre, double deviation,
                                int count)
{
  const Vec3 inGrid = grid.worldToGrid(centre);
  return drawSamples(grid, mask, count, "around the target",
                     [&](Random& random)
                     {
                       Vec3 p = inGrid;
                       for (int axis = 0; axis < 3; ++axis) p[axis] += deviation * random.normal();
                       return p;
                     });
}

Extent extentOf(const std::vector<Vec3>& points)
{
  Extent extent;
  for (const Vec3& p : points) extent.centre += p / double(points.size());
  for (const Vec3& p : points) extent.radius += squaredNorm(p - extent.centre) / double(points.size());
  extent.radius = std::sqrt(extent.radius);
  return extent;
}

double distanceBetween(const LinearMap& a, const LinearMap& b, const Extent& extent)
{
  double sum = squaredNorm(a(extent.centre) - b(extent.centre));
  for (int row = 0; row < 3; ++row) sum += squaredNorm(a.rows[row] - b.rows[row]) * extent.radius * extent.radius / 3;
  return std::sqrt(sum);
}

Level levelOf(const ItkImage::Pointer& fixed, const ItkImage::Pointer& moving, double spacing,
              const std::vector<Vec3>& samples)
{
  Level level{ coarser(fixed, spacing), coarser(moving, spacing), MutualInformation::Samples::New() };
  for (std::size_t n = 0; n < samples.size(); ++n)
  {
    MutualInformation::Samples::PointType point;
    for (int axis = 0; axis < 3; ++axis) point[axis] = float(samples[n][axis]);
    level.samples->SetPoint(n, point);
  }
  return level;
}

} // namespace surgicalmesher
