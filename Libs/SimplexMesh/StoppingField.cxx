// SPDX-License-Identifier: Apache-2.0
#include "StoppingField.h"

#include "Parallel.h"

#include <algorithm>
#include <limits>

namespace surgicalmesher
{

namespace
{

/// Smooths along an axis with weights 1 : 4 : 1; the values at the ends are repeated.
void smoothAlong(int axis, const Grid& grid, std::vector<float>& values)
{
  const std::array<std::size_t, 3> stride{ 1, std::size_t(grid.size[0]), std::size_t(grid.size[0]) * grid.size[1] };
  const int b = axis == 0 ? 1 : 0, c = axis == 2 ? 1 : 2, count = grid.size[axis];
  parallelFor(std::size_t(grid.size[c]),
              [&](std::size_t k)
              {
                for (int j = 0; j < grid.size[b]; ++j)
                {
                  float* row = &values[k * stride[c] + j * stride[b]];
                  float before = row[0];
                  for (int i = 0; i < count; ++i)
                  {
                    float& here = row[i * stride[axis]];
                    const float after = i + 1 < count ? row[(i + 1) * stride[axis]] : here;
                    const float mean = (before + 4 * here + after) / 6;
                    before = here;
                    here = mean;
                  }
                }
              });
}

/// Performs one axis of a squared Euclidean distance transform that is limited to `most` mm.
void spreadAlong(int axis, const Grid& grid, double most, std::vector<float>& squared)
{
  const std::array<std::size_t, 3> stride{ 1, std::size_t(grid.size[0]), std::size_t(grid.size[0]) * grid.size[1] };
  const int b = axis == 0 ? 1 : 0, c = axis == 2 ? 1 : 2, count = grid.size[axis];
  const int window = int(std::ceil(most / grid.spacing[axis]));
  std::vector<float> ways;
  for (int w = 0; w <= window; ++w) ways.push_back(float(w * w * grid.spacing[axis] * grid.spacing[axis]));
  parallelFor(std::size_t(grid.size[c]),
              [&](std::size_t k)
              {
                std::vector<float> line(count + 2 * window, 1e30f);
                for (int j = 0; j < grid.size[b]; ++j)
                {
                  float* row = &squared[k * stride[c] + j * stride[b]];
                  bool isFar = true;
                  for (int i = 0; i < count; ++i) isFar &= (line[i + window] = row[i * stride[axis]]) > 1e29f;
                  if (isFar) continue;
                  for (int i = 0; i < count; ++i)
                  {
                    float least = line[i + window];
                    for (int w = 1; w <= window; ++w)
                      least = std::min(least, std::min(line[i + window - w], line[i + window + w]) + ways[w]);
                    row[i * stride[axis]] = least;
                  }
                }
              });
}

} // namespace

StoppingField::StoppingField(const TissueMap& map, const std::set<Label>& stops, double mostClearance)
  : m_Grid(map.grid), m_Share(map.labels.size()), m_Reach(2 * map.grid.smallestSpacing())
{
  std::vector<char> isStop(labelCount, false);
  for (const Label label : stops) isStop[label] = true;
  for (std::size_t n = 0; n < m_Share.size(); ++n) m_Share[n] = isStop[map.labels[n]];
  const double half = m_Reach / 4;
  m_Clearance.resize(m_Share.size());
  for (std::size_t n = 0; n < m_Share.size(); ++n) m_Clearance[n] = m_Share[n] > 0 ? 0 : 1e30f;
  for (int axis = 0; axis < 3; ++axis) spreadAlong(axis, m_Grid, mostClearance + half, m_Clearance);
  for (float& c : m_Clearance) c = float(std::min(std::sqrt(double(c)) - half, mostClearance));
  for (int axis = 0; axis < 3; ++axis) smoothAlong(axis, m_Grid, m_Share);
}

double StoppingField::clearance(const Vec3& p) const { return interpolated(m_Clearance, p); }

double StoppingField::interpolated(const std::vector<float>& values, const Vec3& p) const
{
  std::array<int, 3> low, high;
  Vec3 u;
  for (int a = 0; a < 3; ++a)
  {
    const double x = std::clamp(p[a] / m_Grid.spacing[a], 0., double(m_Grid.size[a] - 1));
    low[a] = int(x);
    high[a] = std::min(low[a] + 1, m_Grid.size[a] - 1);
    u[a] = x - low[a];
  }
  const auto along = [&](int j, int k)
  {
    const double from = values[m_Grid.index(low[0], j, k)], to = values[m_Grid.index(high[0], j, k)];
    return from + u.x * (to - from);
  };
  const auto plane = [&](int k)
  {
    const double from = along(low[1], k);
    return from + u.y * (along(high[1], k) - from);
  };
  const double from = plane(low[2]);
  return from + u.z * (plane(high[2]) - from);
}

bool StoppingField::stops(const Vec3& p) const
{
  for (int a = 0; a < 3; ++a)
    if (p[a] < -0.5 * m_Grid.spacing[a] || p[a] > (m_Grid.size[a] - 0.5) * m_Grid.spacing[a]) return true;
  return share(p) >= 0.5;
}

double StoppingField::wayToTissue(const Vec3& p, const Vec3& n) const
{
  constexpr int samples = 8; // in steps of a quarter of a voxel
  const double step = m_Reach / samples;
  double before = share(p) - 0.5;
  const double sign = before < 0 ? 1 : -1;
  for (int i = 1; i <= samples; ++i)
  {
    const double here = share(p + sign * i * step * n) - 0.5;
    if ((here < 0) != (before < 0)) return sign * step * (i - here / (here - before));
    before = here;
  }
  return sign * m_Reach;
}

double StoppingField::wayToEnd(const Vec3& p, const Vec3& n) const
{
  double way = std::numeric_limits<double>::infinity();
  for (int a = 0; a < 3; ++a)
  {
    const double low = -0.5 * m_Grid.spacing[a] - p[a], high = (m_Grid.size[a] - 0.5) * m_Grid.spacing[a] - p[a];
    if (n[a] != 0) way = std::min(way, n[a] > 0 ? high / n[a] : low / n[a]);
  }
  return way;
}

} // namespace surgicalmesher
