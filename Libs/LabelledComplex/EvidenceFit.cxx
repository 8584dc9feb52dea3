#include "EvidenceFit.h"

#include <algorithm>
#include <cmath>

namespace surgicalmesher
{

Vec3 Fit::times(const Vec3& x) const
{
  return { m[0] * x.x + m[1] * x.y + m[2] * x.z, m[1] * x.x + m[3] * x.y + m[4] * x.z,
           m[2] * x.x + m[4] * x.y + m[5] * x.z };
}

Vec3 Fit::solve(const Vec3& b) const
{
  const Vec3 r0{ m[0], m[1], m[2] }, r1{ m[1], m[3], m[4] }, r2{ m[2], m[4], m[5] };
  const Vec3 c0 = cross(r1, r2), c1 = cross(r2, r0), c2 = cross(r0, r1);
  const double det = dot(r0, c0);
  if (!(std::abs(det) > 1e-300)) return {};
  return (b.x * c0 + b.y * c1 + b.z * c2) / det;
}

void sheetFaces(const TetComplex& complex, std::int32_t v, const std::vector<std::int32_t>& star,
                std::vector<SheetFace>& faces)
{
  faces.clear();
  if (!complex.onInterface[v]) return;
  for (std::int32_t t : star)
    for (int i = 0; i < 4; ++i)
    {
      const std::int32_t n = complex.neighbours[t][i];
      if (complex.tets[t][i] == v || n < t || complex.labels[n] == complex.labels[t]) continue;
      std::int32_t others[2];
      int k = 0;
      for (int j = 0; j < 4; ++j)
        if (j != i && complex.tets[t][j] != v) others[k++] = complex.tets[t][j];
      faces.push_back({ t, i, others[0], others[1] });
    }
}

Fit fitOf(const TetComplex& complex, std::int32_t v, const std::vector<SheetFace>& faces, double robust)
{
  Fit fit;
  const Vec3 p = complex.points[v];
  for (const SheetFace& f : faces)
  {
    const auto [h, i] = complex.holder(f.tet, f.face);
    const Vec3 x = complex.points[f.x], y = complex.points[f.y];
    const Vec3 n = cross(x - p, y - p);
    const double area2 = squaredNorm(n);
    if (!(area2 > 0)) continue;
    const Vec3 unit = n / std::sqrt(area2);
    const Vec3 slope = cross(unit, y - x) / std::sqrt(area2); // gradient of v's barycentric coordinate
    double weight = 0;
    for (std::int32_t e = complex.evidenceHeads[h][i]; e >= 0; e = complex.evidence[e].next)
    {
      const Vec3 d = complex.evidence[e].position - p;
      const double b = std::clamp(1 + dot(slope, d), 0.0, 1.0);
      const double height = dot(unit, d), w = robust > 0 ? robust / (robust + std::abs(height)) : 1;
      weight += w * b * b;
      fit.g += (w * b * height) * unit;
    }
    fit.m[0] += weight * unit.x * unit.x, fit.m[1] += weight * unit.x * unit.y, fit.m[2] += weight * unit.x * unit.z;
    fit.m[3] += weight * unit.y * unit.y, fit.m[4] += weight * unit.y * unit.z, fit.m[5] += weight * unit.z * unit.z;
  }
  return fit;
}

} // namespace surgicalmesher
