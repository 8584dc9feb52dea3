// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Random label maps for tests that must hold for every map.

#include "VoxelMesh.h"

#include <random>

namespace surgicalmesher::test
{

/// Whether the voxels of a 2x2x2 block in `mask` (bit i + 2 j + 4 k) are joined through faces.
inline bool faceConnected(unsigned mask)
{
  unsigned reached = mask & (~mask + 1);
  for (unsigned last = 0; reached != last;)
  {
    last = reached;
    for (unsigned c = 0; c < 8; ++c)
    {
      for (unsigned step : { 1u, 2u, 4u })
      {
        if (last >> c & 1) reached |= mask & 1u << (c ^ step);
      }
    }
  }
  return reached == mask;
}

/// Whether every label of the map, background included, is joined through faces within every 2x2x2 block, and so are
/// the others there.
inline bool wellComposed(const TissueMap& map)
{
  const Grid& grid = map.grid;
  for (int k = -1; k < grid.size[2]; ++k)
  {
    for (int j = -1; j < grid.size[1]; ++j)
    {
      for (int i = -1; i < grid.size[0]; ++i)
      {
        std::array<int, 8> block;
        for (int c = 0; c < 8; ++c)
        {
          block[c] = labelAt(map, { i + (c & 1), j + (c >> 1 & 1), k + (c >> 2) });
        }
        for (int label : block)
        {
          unsigned mask = 0;
          for (int c = 0; c < 8; ++c) mask |= unsigned(block[c] == label) << c;
          if (!faceConnected(mask) || !faceConnected(mask ^ 255u)) return false;
        }
      }
    }
  }
  return true;
}

/// A well-composed map painted with random boxes of labels 0..`labels`; a box that would spoil it is left out.
inline TissueMap randomWellComposedMap(std::mt19937& random, const std::array<int, 3>& size, int labels, int boxes = 60)
{
  TissueMap map = paintedMap(size, [](int, int, int) { return 0; });
  for (int n = 0; n < boxes; ++n)
  {
    const std::vector<Label> before = map.labels;
    std::array<int, 3> low, high;
    for (int a = 0; a < 3; ++a)
    {
      low[a] = int(random() % size[a]);
      high[a] = std::min(size[a], low[a] + 1 + int(random() % 3));
    }
    const auto label = Label(random() % (labels + 1));
    for (int k = low[2]; k < high[2]; ++k)
    {
      for (int j = low[1]; j < high[1]; ++j)
      {
        for (int i = low[0]; i < high[0]; ++i) map.labels[map.grid.index(i, j, k)] = label;
      }
    }
    if (!wellComposed(map)) map.labels = before;
  }
  return map;
}

} // namespace surgicalmesher::test
