// SPDX-License-Identifier: Apache-2.0
#include "IntensityImage.h"

#include "BoundaryFaces.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace surgicalmesher
{

namespace
{

constexpr std::size_t kFewestLabels = 32; ///< fewest values of an intensity image
constexpr double kUnlikeNeighbours = 0.5; ///< share among all pairs; maps of many small tissues reach a third
constexpr double kSmallSteps = 0.5;       ///< share among unlike pairs; neighbouring tissues may differ by any amount

/// Counts of pairs of face-adjacent tissue voxels.
struct Neighbours
{
  std::size_t pairs = 0, unlike = 0, smallSteps = 0;

  Neighbours& operator+=(const Neighbours& more)
  {
    pairs += more.pairs;
    unlike += more.unlike;
    smallSteps += more.smallSteps;
    return *this;
  }
};

std::size_t countPairs(const Label* some, const Label* others, std::size_t count)
{
  std::size_t pairs = 0;
  for (std::size_t n = 0; n < count; ++n) pairs += std::size_t((some[n] != 0) & (others[n] != 0));
  return pairs;
}

/// Number of pairs of face-adjacent tissue voxels whose first voxel is in slice k.
std::size_t countPairs(const TissueMap& map, int k)
{
  if (k < 0) return 0;
  const auto [ni, nj, nk] = map.grid.size;
  const Label* slice = &map.labels[map.grid.index(0, 0, k)];
  const std::size_t row = std::size_t(ni), area = row * std::size_t(nj);
  std::size_t pairs = countPairs(slice, slice + row, area - row);
  if (k + 1 < nk) pairs += countPairs(slice, slice + area, area);
  for (std::size_t j = 0; j < std::size_t(nj); ++j) pairs += countPairs(slice + j * row, slice + j * row + 1, row - 1);
  return pairs;
}

/// Counts pairs; in large maps only in some slices, since only their shares matter.
Neighbours countNeighbours(const TissueMap& map, int smallStep)
{
  constexpr std::size_t many = 1 << 24; // voxels
  const int step = 1 + int(map.labels.size() / many);
  return sumOverBoundarySlices<Neighbours>(map,
                                           [&](int k)
                                           {
                                             Neighbours count;
                                             if (k % step != 0) return count;
                                             count.pairs = countPairs(map, k);
                                             forEachBoundaryFace(map, k,
                                                                 [&](const VoxelFace& face)
                                                                 {
                                                                   const int own = labelAt(map, face.lower),
                                                                             other = labelAt(map, face.upper());
                                                                   if (own == 0 || other == 0) return;
                                                                   ++count.unlike;
                                                                   count.smallSteps +=
                                                                     std::abs(own - other) <= smallStep;
                                                                 });
                                             return count;
                                           });
}

} // namespace

std::string likenessToIntensities(const TissueMap& map)
{
  const std::vector<Label> labels = presentLabels(map);
  if (labels.size() < kFewestLabels) return {};
  const int smallStep = std::max(1, (int(labels.back()) - int(labels.front())) / 10);
  const Neighbours count = countNeighbours(map, smallStep);
  const double unlike = count.pairs ? double(count.unlike) / double(count.pairs) : 0;
  if (unlike < kUnlikeNeighbours || double(count.smallSteps) < kSmallSteps * double(count.unlike)) return {};
  return "looks like an image of intensities, such as a T1 scan, instead of a label map: it has " +
         std::to_string(labels.size()) + " values, and " + std::to_string(std::lround(100 * unlike)) +
         " % of neighbouring voxels differ, mostly by little; expected one value for each tissue";
}

} // namespace surgicalmesher
