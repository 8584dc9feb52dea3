// SPDX-License-Identifier: Apache-2.0
// limitGradation: branch and bound over a pyramid of minima. A block of voxels is skipped if even its least length, at
// the distance of its nearest voxel, would not lower the minimum found so far.

#include "Gradation.h"
#include "Parallel.h"

#include <algorithm>
#include <cmath>

namespace surgicalmesher
{

namespace
{

/// Level n of the pyramid: the least length in each block of side 2^n voxels.
struct Level
{
  std::array<int, 3> size;
  std::vector<float> minima;

  float at(int i, int j, int k) const { return minima[(std::size_t(k) * size[1] + j) * size[0] + i]; }
};

Level coarser(const Level& fine)
{
  Level coarse;
  for (int axis = 0; axis < 3; ++axis) coarse.size[axis] = (fine.size[axis] + 1) / 2;
  coarse.minima.assign(std::size_t(coarse.size[0]) * coarse.size[1] * coarse.size[2], HUGE_VALF);
  std::size_t n = 0;
  for (int k = 0; k < fine.size[2]; ++k)
  {
    for (int j = 0; j < fine.size[1]; ++j)
    {
      float* row = coarse.minima.data() + (std::size_t(k / 2) * coarse.size[1] + j / 2) * coarse.size[0];
      for (int i = 0; i < fine.size[0]; ++i) row[i / 2] = std::min(row[i / 2], fine.minima[n++]);
    }
  }
  return coarse;
}

class ConeEnvelope
{
public:
  ConeEnvelope(const ScaleField& scale, double slope) : m_Grid(scale.grid), m_Slope(slope)
  {
    m_Levels.push_back({ scale.grid.size, scale.lengths });
    while (*std::max_element(m_Levels.back().size.begin(), m_Levels.back().size.end()) > 1)
    {
      m_Levels.push_back(coarser(m_Levels.back()));
    }
  }

  using Voxel = std::array<int, 3>;

  /// Returns the minimum over voxels y of L(y) + slope |x - y|. `source` is a guess of the minimising y on input and
  /// that y on output; a good guess, such as a neighbour's source, saves most of the search.
  double at(const Voxel& x, Voxel& source) const
  {
    Search search{ x, source, cone(x, source) };
    if (cone(x, x) < search.best) search = { x, x, cone(x, x) };
    visit(search, int(m_Levels.size()) - 1, { 0, 0, 0 });
    source = search.source;
    return search.best;
  }

private:
  struct Search
  {
    Voxel x;
    Voxel source;
    double best;
  };

  double cone(const Voxel& x, const Voxel& y) const
  {
    return m_Levels[0].at(y[0], y[1], y[2]) + m_Slope * distance(x, 0, y);
  }

  double distance(const Voxel& x, int level, const Voxel& block) const
  {
    double squared = 0;
    for (int axis = 0; axis < 3; ++axis)
    {
      const int first = block[axis] << level;
      const int last = std::min(((block[axis] + 1) << level) - 1, m_Grid.size[axis] - 1);
      const double gap = std::max({ first - x[axis], x[axis] - last, 0 }) * m_Grid.spacing[axis];
      squared += gap * gap;
    }
    return std::sqrt(squared);
  }

  void visit(Search& search, int level, const Voxel& block) const
  {
    const double least = m_Levels[level].at(block[0], block[1], block[2]);
    if (least >= search.best) return;
    const double bound = least + m_Slope * distance(search.x, level, block);
    if (bound >= search.best) return;
    if (level == 0)
    {
      search.source = block;
      search.best = bound;
      return;
    }
    int nearest = 0; // of the eight children, the one nearest to x
    for (int axis = 0; axis < 3; ++axis) nearest |= (search.x[axis] >> (level - 1)) > 2 * block[axis] ? 1 << axis : 0;
    const std::array<int, 3>& size = m_Levels[level - 1].size;
    for (int n = 0; n < 8; ++n)
    {
      const int half = n ^ nearest;
      const Voxel child{ 2 * block[0] + (half & 1), 2 * block[1] + (half >> 1 & 1), 2 * block[2] + (half >> 2) };
      if (child[0] < size[0] && child[1] < size[1] && child[2] < size[2]) visit(search, level - 1, child);
    }
  }

  Grid m_Grid;
  double m_Slope;
  std::vector<Level> m_Levels;
};

} // namespace

void limitGradation(ScaleField& scale, double slope)
{
  const ConeEnvelope envelope(scale, slope);
  const Grid& grid = scale.grid;
  parallelFor(grid.size[2],
              [&](int k)
              {
                for (int j = 0; j < grid.size[1]; ++j)
                {
                  std::array<int, 3> source{ 0, j, k };
                  for (int i = 0; i < grid.size[0]; ++i)
                  {
                    scale.lengths[grid.index(i, j, k)] = float(envelope.at({ i, j, k }, source));
                  }
                }
              });
}

} // namespace surgicalmesher
