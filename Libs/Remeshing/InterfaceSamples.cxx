// SPDX-License-Identifier: Apache-2.0
#include "InterfaceSamples.h"

#include <algorithm>

namespace surgicalmesher
{

namespace
{

/// Returns the triangle cut into n^2 congruent ones.
std::vector<std::array<Vec3, 3>> subdivided(const std::array<Vec3, 3>& p, int n)
{
  std::vector<std::array<Vec3, 3>> result;
  const Vec3 u = (p[1] - p[0]) / n, v = (p[2] - p[0]) / n;
  for (int i = 0; i < n; ++i)
    for (int j = 0; i + j < n; ++j)
    {
      const Vec3 q = p[0] + i * u + j * v;
      result.push_back({ q, q + u, q + v });
      if (i + j + 1 < n) result.push_back({ q + u + v, q + v, q + u });
    }
  return result;
}

} // namespace

void addInterfaceSamples(BackgroundMesh& background, double tolerance)
{
  const TetMesh& mesh = background.mesh;
  background.neighbours = faceAdjacency(mesh).across;
  for (std::int32_t t = 0; t < std::int32_t(mesh.tetrahedra.size()); ++t)
    for (std::int32_t i = 0; i < 4; ++i)
    {
      const std::int32_t n = background.neighbours[t][i];
      if (n < 0 || mesh.labels[n] >= mesh.labels[t]) continue;
      std::array<Vec3, 3> p;
      double length = 0;
      for (int k = 0; k < 3; ++k)
      {
        const std::int32_t v = mesh.tetrahedra[t][(i + 1 + k) & 3];
        p[k] = mesh.points[v];
        length += background.lengths[v] / 3;
      }
      const double longest = std::max({ norm(p[1] - p[0]), norm(p[2] - p[1]), norm(p[0] - p[2]) });
      const int parts = std::clamp(int(longest / (2 * length)) + 1, 1, 16);
      for (const auto& q : subdivided(p, parts))
        for (int k = 0; k < 3; ++k)
          background.samples.push_back(
            { { (4 * q[k] + q[(k + 1) % 3] + q[(k + 2) % 3]) / 6, float(tolerance * length) }, t, i });
    }
}

} // namespace surgicalmesher
