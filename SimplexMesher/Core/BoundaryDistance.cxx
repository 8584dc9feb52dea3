#include "BoundaryDistance.h"

#include <vtkSMPTools.h>

#include <algorithm>
#include <cmath>

namespace surgicalmesher
{

std::vector<double> boundaryDistances(const SurfaceComplex& surface, const TissueMap& map)
{
  constexpr int reach = 4; // voxels
  const Grid& g = map.grid;
  const auto labelAt = [&](int i, int j, int k) { return g.contains(i, j, k) ? map.labels[g.index(i, j, k)] : Label(0); };
  std::vector<Label> front(surface.points.size(), 0);
  for (std::size_t t = surface.triangles.size(); t-- > 0;)
    for (std::int32_t v : surface.triangles[t]) front[v] = surface.labels[t][1];
  std::vector<double> out(surface.points.size());
  vtkSMPTools::For(0, vtkIdType(out.size()), [&](vtkIdType begin, vtkIdType end) {
    for (vtkIdType v = begin; v < end; ++v)
    {
      const Vec3& p = surface.points[v];
      int c[3];
      for (int a = 0; a < 3; ++a) c[a] = int(std::lround(p[a] / g.spacing[a]));
      double best = reach * std::min({ g.spacing.x, g.spacing.y, g.spacing.z });
      best *= best;
      for (int k = c[2] - reach; k <= c[2] + reach; ++k)
        for (int j = c[1] - reach; j <= c[1] + reach; ++j)
          for (int i = c[0] - reach; i <= c[0] + reach; ++i)
            for (int a = 0; a < 3; ++a)
            {
              const int next[3] = { i + (a == 0), j + (a == 1), k + (a == 2) };
              if (labelAt(i, j, k) == labelAt(next[0], next[1], next[2])) continue;
              const int here[3] = { i, j, k };
              double d2 = 0;
              for (int b = 0; b < 3; ++b)
              {
                const double off = std::abs(p[b] - (b == a ? here[b] + 0.5 : here[b]) * g.spacing[b]);
                const double beyond = std::max(0.0, off - (b == a ? 0 : 0.5 * g.spacing[b]));
                d2 += beyond * beyond;
              }
              best = std::min(best, d2);
            }
      out[v] = (labelAt(c[0], c[1], c[2]) == front[v] ? 1 : -1) * std::sqrt(best);
    }
  });
  return out;
}

} // namespace surgicalmesher
