// SPDX-License-Identifier: Apache-2.0
#include "HeadCompartments.h"

#include "Errors.h"
#include "ExtraTrees.h"
#include "GeodesicFront.h"
#include "ItkImage.h"
#include "Sampling.h"

#include <itkGradientMagnitudeRecursiveGaussianImageFilter.h>
#include <itkSignedMaurerDistanceMapImageFilter.h>
#include <itkSmoothingRecursiveGaussianImageFilter.h>
#include <vtkSMPTools.h>

#include <algorithm>
#include <cmath>
#include <queue>

namespace surgicalmesher
{

namespace
{

using Mask = itk::Image<unsigned char, 3>;

template <typename Filter>
std::vector<float> filtered(const ItkImage::Pointer& image, double sigma)
{
  const auto filter = Filter::New();
  filter->SetInput(image);
  filter->SetSigma(sigma);
  filter->Update();
  return valuesOf(*filter->GetOutput());
}

std::vector<float> blurred(const ItkImage::Pointer& image, double sigma)
{
  return filtered<itk::SmoothingRecursiveGaussianImageFilter<ItkImage, ItkImage>>(image, sigma);
}

/// Morphological closing by a ball. `outward` is the distance to the mask. Voxels beyond the image count as dilated.
std::vector<bool> closed(const Grid& grid, const std::vector<bool>& mask, const std::vector<float>& outward,
                         float radius)
{
  std::vector<bool> rest(mask.size());
  for (std::size_t n = 0; n < mask.size(); ++n) rest[n] = outward[n] > radius;
  const std::vector<float> inward = distanceTo(grid, rest);
  std::vector<bool> result(mask.size());
  for (std::size_t n = 0; n < mask.size(); ++n) result[n] = mask[n] || inward[n] > radius;
  return result;
}

/// Calls visit(neighbour index) for the voxels that share a face with voxel n.
template <typename Visit>
void forFaceNeighbours(const Grid& grid, std::size_t n, Visit visit)
{
  const std::size_t row = std::size_t(grid.size[0]);
  const std::size_t layer = row * grid.size[1];
  const std::size_t i = n % row;
  const std::size_t j = n / row % grid.size[1];
  const std::size_t k = n / layer;
  if (i > 0) visit(n - 1);
  if (i + 1 < row) visit(n + 1);
  if (j > 0) visit(n - row);
  if (j + 1 < std::size_t(grid.size[1])) visit(n + row);
  if (k > 0) visit(n - layer);
  if (k + 1 < std::size_t(grid.size[2])) visit(n + layer);
}

/// Assigns voxels to the side from whose seeds they are reached through the widest passages: 1 outside, -1 inside, 0
/// not reached.
std::vector<signed char> widestWays(const Grid& grid, const std::vector<float>& width, const CompartmentSeeds& seeds)
{
  struct Front
  {
    float width;
    std::size_t voxel;
    signed char side;
    bool operator<(const Front& other) const
    {
      return width != other.width ? width < other.width : voxel > other.voxel;
    }
  };
  std::vector<signed char> side(grid.voxelCount(), 0);
  std::priority_queue<Front> queue;
  const auto start = [&](const std::vector<std::array<int, 3>>& voxels, signed char which)
  {
    for (const std::array<int, 3>& v : voxels)
    {
      const std::size_t n = grid.index(v[0], v[1], v[2]);
      queue.push({ width[n], n, which });
    }
  };
  start(seeds.outside, 1);
  start(seeds.inside, -1);
  while (!queue.empty())
  {
    const Front front = queue.top();
    queue.pop();
    if (side[front.voxel] != 0) continue;
    side[front.voxel] = front.side;
    forFaceNeighbours(grid, front.voxel,
                      [&](std::size_t n)
                      {
                        if (side[n] == 0 && width[n] > 0)
                          queue.push({ std::min(width[n], front.width), n, front.side });
                      });
  }
  return side;
}

/// Features of the extremely randomised trees, by feature and voxel.
struct Features
{
  std::vector<std::vector<float>> values;
  void at(std::size_t voxel, float* row) const
  {
    for (std::size_t f = 0; f < values.size(); ++f) row[f] = values[f][voxel];
  }
};

/// A CT that accompanies MR images adds no features of its own: the bone mask holds what it contributes.
Features featuresOf(const HeadImages& images, const std::vector<bool>& isBone, const std::vector<float>& boneDistance,
                    const std::vector<float>& depth)
{
  Features features;
  for (std::size_t c = 0; c < images.channels.size(); ++c)
  {
    if (int(c) == images.ct && !images.isCtAlone()) continue;
    features.values.push_back(images.channels[c].values);
    const auto itkImage = asItkImage<ItkImage>(images.grid(), images.channels[c].values);
    for (const double sigma : { 1.0, 2.0, 4.0, 8.0 }) features.values.push_back(blurred(itkImage, sigma));
    features.values.push_back(
      filtered<itk::GradientMagnitudeRecursiveGaussianImageFilter<ItkImage, ItkImage>>(itkImage, 1.0));
  }
  const auto bone = asItkImage<ItkImage>(images.grid(), isBone);
  for (const double sigma : { 2.0, 4.0, 8.0, 16.0 }) features.values.push_back(blurred(bone, sigma));
  features.values.push_back(boneDistance);
  features.values.push_back(depth);
  return features;
}

/// Returns the probability of lying outside the skull for each voxel of soft tissue; 1 elsewhere.
std::vector<float> outsideProbability(const Grid& grid, const Features& features, const std::vector<bool>& isSoft,
                                      const CompartmentSeeds& seeds)
{
  constexpr int treeCount = 200;
  FeatureRows samples;
  std::vector<bool> isOutside;
  for (const bool outside : { true, false })
  {
    for (const std::array<int, 3>& v : outside ? seeds.outside : seeds.inside)
    {
      samples.emplace_back(features.values.size());
      features.at(grid.index(v[0], v[1], v[2]), samples.back().data());
      isOutside.push_back(outside);
    }
  }
  const ExtraTrees trees(samples, isOutside, treeCount);
  std::vector<float> probability(grid.voxelCount(), 1);
  vtkSMPTools::For(0, vtkIdType(probability.size()), 2048,
                   [&](vtkIdType begin, vtkIdType end)
                   {
                     const std::size_t width = features.values.size();
                     std::vector<vtkIdType> voxels;
                     for (vtkIdType n = begin; n < end; ++n)
                       if (isSoft[n]) voxels.push_back(n);
                     std::vector<float> rows(voxels.size() * width), found(voxels.size());
                     for (std::size_t v = 0; v < voxels.size(); ++v)
                       features.at(std::size_t(voxels[v]), &rows[v * width]);
                     trees.probabilities(rows.data(), voxels.size(), found.data());
                     for (std::size_t v = 0; v < voxels.size(); ++v) probability[std::size_t(voxels[v])] = found[v];
                   });
  return probability;
}

/// Minimises the integral of weight |grad u| + force u over 0 <= u <= 1, per voxel, by the primal-dual method with
/// primal and dual steps of 1 / sqrt(12). `force` is positive where u should be 0.
std::vector<float> continuousCut(const Grid& grid, const std::vector<float>& weight, const std::vector<float>& force,
                                 std::vector<float> u, int iterations, const Progress& progress)
{
  const std::size_t count = grid.voxelCount();
  const std::array<std::size_t, 3> stride{ 1, std::size_t(grid.size[0]), std::size_t(grid.size[0]) * grid.size[1] };
  const float step = 1 / std::sqrt(12.f);
  std::array<std::vector<float>, 3> dual;
  for (std::vector<float>& component : dual) component.assign(count, 0);
  std::vector<float> extrapolated = u;
  const auto forRows = [&](const auto& doRow)
  {
    vtkSMPTools::For(0, vtkIdType(grid.size[1]) * grid.size[2], 32,
                     [&](vtkIdType begin, vtkIdType end)
                     {
                       for (vtkIdType row = begin; row < end; ++row)
                         doRow(int(row % grid.size[1]), int(row / grid.size[1]), std::size_t(row) * grid.size[0]);
                     });
  };
  const auto ascend = [&](int j, int k, std::size_t start)
  {
    for (int i = 0; i < grid.size[0]; ++i)
    {
      const std::size_t n = start + i;
      const std::array<bool, 3> hasNext{ i + 1 < grid.size[0], j + 1 < grid.size[1], k + 1 < grid.size[2] };
      float square = 0;
      for (int axis = 0; axis < 3; ++axis)
      {
        const float slope = hasNext[axis] ? extrapolated[n + stride[axis]] - extrapolated[n] : 0;
        dual[axis][n] += step * slope;
        square += dual[axis][n] * dual[axis][n];
      }
      const float length = std::sqrt(square);
      if (length <= weight[n]) continue;
      for (int axis = 0; axis < 3; ++axis) dual[axis][n] *= weight[n] / length;
    }
  };
  const auto descend = [&](int j, int k, std::size_t start)
  {
    for (int i = 0; i < grid.size[0]; ++i)
    {
      const std::size_t n = start + i;
      const std::array<int, 3> at{ i, j, k };
      float divergence = 0;
      for (int axis = 0; axis < 3; ++axis)
      {
        if (at[axis] + 1 < grid.size[axis]) divergence += dual[axis][n];
        if (at[axis] > 0) divergence -= dual[axis][n - stride[axis]];
      }
      const float next = std::clamp(u[n] + step * (divergence - force[n]), 0.f, 1.f);
      extrapolated[n] = 2 * next - u[n];
      u[n] = next;
    }
  };
  for (int iteration = 0; iteration < iterations; ++iteration)
  {
    report(progress, double(iteration) / iterations, "compartments");
    forRows(ascend);
    forRows(descend);
  }
  return u;
}

/// Returns the voxels that a ball reaches from the image's sides and upper end, and those up to 6 mm further along
/// passages too narrow for the ball. `distance` is the distance to the mask before it was closed to `head`.
std::vector<bool> outsideOf(const Grid& grid, const std::vector<bool>& head, const std::vector<float>& distance)
{
  constexpr float ballRadius = 3;
  std::vector<bool> isReached(head.size(), false);
  std::vector<std::size_t> stack;
  const auto enter = [&](std::size_t n)
  {
    if (head[n] || isReached[n]) return;
    isReached[n] = true;
    stack.push_back(n);
  };
  for (int k = 0; k < grid.size[2]; ++k)
    for (int j = 0; j < grid.size[1]; ++j)
      for (int i = 0; i < grid.size[0]; ++i)
      {
        const bool isSide = i == 0 || j == 0 || i + 1 == grid.size[0] || j + 1 == grid.size[1] || k + 1 == grid.size[2];
        if (isSide) enter(grid.index(i, j, k));
      }
  while (!stack.empty())
  {
    const std::size_t n = stack.back();
    stack.pop_back();
    const auto enterWide = [&](std::size_t m)
    {
      if (distance[m] > ballRadius) enter(m);
    };
    forFaceNeighbours(grid, n, enterWide);
  }
  std::vector<std::size_t> rim;
  std::vector<bool> isOpen(head.size());
  for (std::size_t n = 0; n < head.size(); ++n)
  {
    isOpen[n] = !head[n] && !isReached[n];
    bool isRim = false;
    if (isReached[n]) forFaceNeighbours(grid, n, [&](std::size_t m) { isRim = isRim || !isReached[m]; });
    if (isRim) rim.push_back(n);
  }
  for (const std::size_t n : rim) isOpen[n] = true;
  const std::vector<bool> around = reachedFrom(grid, rim, isOpen, 2 * ballRadius);
  for (std::size_t n = 0; n < head.size(); ++n) isReached[n] = isReached[n] || around[n];
  return isReached;
}

/// Assigns to the orbits the extracranial voxels that a ball reaches from the seeds.
void findOrbits(const Grid& grid, const std::vector<float>& boneDistance, const std::vector<std::array<int, 3>>& seeds,
                std::vector<Compartment>& compartments)
{
  constexpr float frontRadius = 1, reach = 15; // mm
  std::vector<bool> isOpen(compartments.size());
  for (std::size_t n = 0; n < isOpen.size(); ++n)
    isOpen[n] = compartments[n] == Compartment::Extracranial && boneDistance[n] > frontRadius;
  std::vector<std::size_t> starts;
  for (const std::array<int, 3>& v : seeds)
  {
    const std::size_t n = grid.index(v[0], v[1], v[2]);
    if (compartments[n] != Compartment::Extracranial) continue;
    isOpen[n] = true; // seeds may lie next to bone
    starts.push_back(n);
  }
  if (starts.empty())
    throw InputError("no training point of a class within the orbits lies in soft tissue outside the skull");
  const std::vector<float> distance = distanceTo(grid, reachedFrom(grid, starts, isOpen, reach));
  for (std::size_t n = 0; n < compartments.size(); ++n)
    if (compartments[n] == Compartment::Extracranial && distance[n] < 1.01f * frontRadius)
      compartments[n] = Compartment::Intraorbital;
}

} // namespace

std::vector<float> distanceTo(const Grid& grid, const std::vector<bool>& mask)
{
  using Filter = itk::SignedMaurerDistanceMapImageFilter<Mask, ItkImage>;
  if (std::find(mask.begin(), mask.end(), true) == mask.end()) return std::vector<float>(mask.size(), 1e6f);
  const auto filter = Filter::New();
  filter->SetInput(asItkImage<Mask>(grid, mask));
  filter->SetSquaredDistance(false);
  filter->SetUseImageSpacing(true);
  filter->Update();
  std::vector<float> distances = valuesOf(*filter->GetOutput());
  for (float& distance : distances) distance = std::max(0.f, distance);
  return distances;
}

std::vector<bool> headMask(const HeadImages& images, float threshold)
{
  constexpr float air = -500; // HU
  const Grid& grid = images.grid();
  const bool isCt = images.ct >= 0;
  const ScalarImage& shown = images.channels[isCt ? std::size_t(images.ct) : 0];
  const std::vector<float> values = isCt ? blurred(asItkImage<ItkImage>(grid, shown.values), 0.5) : shown.values;
  std::vector<bool> bright(values.size());
  for (std::size_t n = 0; n < bright.size(); ++n) bright[n] = values[n] > (isCt ? air : threshold);
  const std::vector<float> outward = distanceTo(grid, bright);
  std::vector<bool> head = outsideOf(grid, closed(grid, bright, outward, 2), outward);
  head.flip();
  if (isCt)
    for (std::size_t n = 0; n < head.size(); ++n) head[n] = head[n] && bright[n];
  return head;
}

HeadSigns headSigns(const HeadImages& images, const BoneContrast& bone, const BoneContrast& structural)
{
  const bool isCt = images.ct >= 0;
  const std::vector<float>& shown = images.channels[isCt ? std::size_t(images.ct) : 0].values;
  const std::vector<float>& values = images.structural().values;
  HeadSigns signs;
  signs.head = headMask(images, bone.threshold);
  for (std::size_t n = 0; n < shown.size(); ++n)
  {
    signs.bone.push_back(signs.head[n] && (isCt ? shown[n] > bone.threshold : shown[n] <= bone.threshold));
    const float share = (values[n] - structural.boneMedian) / (structural.softMedian - structural.boneMedian);
    signs.softness.push_back(std::clamp(share, 0.05f, 1.f));
  }
  return signs;
}

std::vector<Compartment> findCompartments(const HeadImages& images, const HeadSigns& signs,
                                          const CompartmentSeeds& known, const Progress& progress)
{
  const Grid& grid = images.grid();
  CompartmentSeeds seeds = known;
  seeds.outside.insert(seeds.outside.end(), seeds.orbital.begin(), seeds.orbital.end());
  report(progress, 0, "head and bone");
  const std::vector<bool>&head = signs.head, &isBone = signs.bone;
  std::vector<bool> isSoft(head.size()), isBackground(head.size());
  for (std::size_t n = 0; n < head.size(); ++n)
  {
    isBackground[n] = !head[n];
    isSoft[n] = head[n] && !isBone[n];
  }
  const std::vector<float> boneDistance = distanceTo(grid, isBone);
  const std::vector<float> depth = distanceTo(grid, isBackground);
  report(progress, 0.15, "compartments");
  std::vector<float> outside;
  {
    const Features features = featuresOf(images, isBone, boneDistance, depth);
    report(progress, 0.3, "compartments");
    outside = outsideProbability(grid, features, isSoft, seeds);
  }
  report(progress, 0.55, "compartments");
  std::vector<float> width(head.size(), 0);
  for (std::size_t n = 0; n < head.size(); ++n) width[n] = isSoft[n] ? std::min(boneDistance[n], depth[n]) : 0;
  const std::vector<signed char> flood = widestWays(grid, width, seeds);

  constexpr float least = 0.02f; // bound of the probability, away from 0 and 1
  std::vector<float> force(head.size()), start(head.size());
  for (std::size_t n = 0; n < head.size(); ++n)
  {
    const float p = std::clamp(outside[n], least, 1 - least);
    force[n] = isSoft[n] ? 0.1f * (std::log(p / (1 - p)) + 0.5f * float(flood[n])) : 5.f;
    start[n] = force[n] < 0 ? 1.f : 0.f;
  }
  const std::vector<float> inside =
    continuousCut(grid, signs.softness, force, std::move(start), 150, subProgress(progress, 0.6, 1));
  std::vector<Compartment> compartments(head.size(), Compartment::Background);
  for (std::size_t n = 0; n < head.size(); ++n)
  {
    if (isBone[n]) compartments[n] = Compartment::Bone;
    else if (isSoft[n]) compartments[n] = inside[n] > 0.5f ? Compartment::Intracranial : Compartment::Extracranial;
  }
  if (!seeds.orbital.empty()) findOrbits(grid, boneDistance, seeds.orbital, compartments);
  return compartments;
}

} // namespace surgicalmesher
