// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Loops over the voxel faces between different labels, including those between tissue and the outside of the map.

#include "Parallel.h"
#include "TissueMap.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace surgicalmesher
{

/// The face between a voxel and the next one up along `axis`; one of the two may lie outside the map.
struct VoxelFace
{
  std::array<int, 3> lower;
  int axis;

  std::array<int, 3> upper() const
  {
    std::array<int, 3> u = lower;
    ++u[axis];
    return u;
  }
  /// Centre of the face in the grid frame, mm.
  Vec3 centre(const Vec3& spacing) const
  {
    Vec3 c{ double(lower[0]), double(lower[1]), double(lower[2]) };
    c[axis] += 0.5;
    return { c.x * spacing.x, c.y * spacing.y, c.z * spacing.z };
  }
};

inline bool isInside(const Grid& grid, const std::array<int, 3>& voxel)
{
  return grid.contains(voxel[0], voxel[1], voxel[2]);
}

/// The voxel of the face that lies in the map: the lower one if both do.
inline std::array<int, 3> voxelInside(const Grid& grid, const VoxelFace& face)
{
  return isInside(grid, face.lower) ? face.lower : face.upper();
}

/// Calls f(face) for every face between two labels whose lower voxel is in slice k, in the order of these voxels; the
/// faces below the map belong to slice -1. Skips stretches of equal labels many voxels at a time.
template <class F>
void forEachBoundaryFace(const TissueMap& map, int k, F&& f)
{
  constexpr int together = 32; // voxels
  const auto [ni, nj, nk] = map.grid.size;
  const std::vector<Label> outside(std::size_t(ni), 0);
  const auto row = [&, nj = nj, nk = nk](int j, int slice)
  { return j < 0 || slice < 0 || j >= nj || slice >= nk ? outside.data() : &map.labels[map.grid.index(0, j, slice)]; };
  for (int j = -1; j < nj; ++j)
  {
    const Label *own = row(j, k), *alongJ = row(j + 1, k), *alongK = row(j, k + 1);
    const auto visit = [&, k](int i, Label alongI)
    {
      if (alongI != own[i]) f(VoxelFace{ { i, j, k }, 0 });
      if (alongJ[i] != own[i]) f(VoxelFace{ { i, j, k }, 1 });
      if (alongK[i] != own[i]) f(VoxelFace{ { i, j, k }, 2 });
    };
    if (own[0] != 0) f(VoxelFace{ { -1, j, k }, 0 });
    for (int begin = 0; begin < ni - 1; begin += together)
    {
      const int end = std::min(begin + together, ni - 1);
      unsigned differences = 0;
      for (int i = begin; i < end; ++i)
        differences |= unsigned(own[i] ^ own[i + 1]) | unsigned(own[i] ^ alongJ[i]) | unsigned(own[i] ^ alongK[i]);
      if (differences == 0) continue;
      for (int i = begin; i < end; ++i) visit(i, own[i + 1]);
    }
    visit(ni - 1, 0);
  }
}

/// Calls f(index), in order, for the voxels of row (j, k) with i in [first, last) that have a face neighbour of another
/// label. The face neighbours of all these voxels must lie in the map.
template <class F>
void forEachBoundaryVoxel(const TissueMap& map, int j, int k, int first, int last, F&& f)
{
  constexpr int together = 32; // voxels
  const std::ptrdiff_t nextRow = map.grid.size[0], nextSlice = nextRow * map.grid.size[1];
  const std::size_t row = map.grid.index(0, j, k);
  const auto differences = [&, own = map.labels.data() + row](int i)
  {
    const Label *const at = own + i, label = *at;
    return Label((label ^ at[-1]) | (label ^ at[1]) | (label ^ at[-nextRow]) | (label ^ at[nextRow]) |
                 (label ^ at[-nextSlice]) | (label ^ at[nextSlice]));
  };
  for (int begin = first; begin < last; begin += together)
  {
    const int end = std::min(begin + together, last);
    Label any = 0;
    for (int i = begin; i < end; ++i) any = Label(any | differences(i));
    if (any == 0) continue;
    for (int i = begin; i < end; ++i)
      if (differences(i) != 0) f(row + i);
  }
}

/// Returns the sum of sumOfSlice(k) over all slices k of forEachBoundaryFace(), from -1 on. The slices are evaluated in
/// parallel but added in order, so that the sum does not depend on the threads.
template <class T, class F>
T sumOverBoundarySlices(const TissueMap& map, F&& sumOfSlice)
{
  std::vector<T> sums(std::size_t(map.grid.size[2]) + 1);
  parallelForEach(sums.size(), [&](std::size_t n) { sums[n] = sumOfSlice(int(n) - 1); });
  T sum{};
  for (const T& part : sums) sum += part;
  return sum;
}

} // namespace surgicalmesher
