// SPDX-License-Identifier: Apache-2.0
#include "EnclosedVoxels.h"

#include <algorithm>
#include <cmath>

namespace surgicalmesher
{

namespace
{

// Offset of the rows, in voxels, so that no row meets a point or edge of the surface and no crossing counts twice.
constexpr double offRowJ = 1.1e-7, offRowK = 1.7e-7;

struct Crossing
{
  std::size_t row;
  double x; ///< mm
};

/// Returns twice the signed area of the row and edge ab, seen along the rows; bitwise identical for both triangles at
/// ab.
double side(const Vec3& row, const Vec3& a, const Vec3& b)
{
  const bool swapped = b.y != a.y ? b.y < a.y : b.z < a.z;
  const Vec3 &p = swapped ? b : a, &q = swapped ? a : b;
  const double area = (q.y - p.y) * (row.z - p.z) - (q.z - p.z) * (row.y - p.y);
  return swapped ? -area : area;
}

void addCrossings(const std::array<Vec3, 3>& c, const Grid& grid, std::vector<Crossing>& crossings)
{
  const auto range = [&](int axis)
  {
    const auto [low, high] = std::minmax({ c[0][axis], c[1][axis], c[2][axis] });
    return std::array{ std::max(0, int(std::ceil(low / grid.spacing[axis] - 1e-3))),
                       std::min(grid.size[axis] - 1, int(std::floor(high / grid.spacing[axis] + 1e-3))) };
  };
  const auto [fromJ, toJ] = range(1);
  const auto [fromK, toK] = range(2);
  for (int k = fromK; k <= toK; ++k)
    for (int j = fromJ; j <= toJ; ++j)
    {
      const Vec3 row{ 0, (j + offRowJ) * grid.spacing.y, (k + offRowK) * grid.spacing.z };
      const std::array<double, 3> w{ side(row, c[1], c[2]), side(row, c[2], c[0]), side(row, c[0], c[1]) };
      const bool inside = (w[0] > 0 && w[1] > 0 && w[2] > 0) || (w[0] < 0 && w[1] < 0 && w[2] < 0);
      if (!inside) continue;
      const double x = (w[0] * c[0].x + w[1] * c[1].x + w[2] * c[2].x) / (w[0] + w[1] + w[2]);
      crossings.push_back({ grid.index(0, j, k), x });
    }
}

} // namespace

std::vector<std::size_t> enclosedVoxels(const SurfaceComplex& surface, Label tissue, const Grid& grid)
{
  std::vector<Crossing> crossings;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
  {
    if (surface.labels[t][0] != tissue && surface.labels[t][1] != tissue) continue;
    const auto& [a, b, c] = surface.triangles[t];
    addCrossings({ surface.points[a], surface.points[b], surface.points[c] }, grid, crossings);
  }
  std::sort(crossings.begin(), crossings.end(),
            [](const Crossing& p, const Crossing& q) { return p.row != q.row ? p.row < q.row : p.x < q.x; });
  std::vector<std::size_t> voxels;
  for (std::size_t n = 0; n + 1 < crossings.size(); n += 2)
  {
    const int from = std::max(0, int(std::ceil(crossings[n].x / grid.spacing.x))),
              to = std::min(grid.size[0] - 1, int(std::floor(crossings[n + 1].x / grid.spacing.x)));
    for (int i = from; i <= to; ++i) voxels.push_back(crossings[n].row + i);
  }
  return voxels;
}

} // namespace surgicalmesher
