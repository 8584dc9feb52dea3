#include "BoundarySamples.h"

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

void Sheet::clear()
{
  faces.clear();
  points.clear();
}

void Sheet::addFace(const TetComplex& complex, std::int32_t t, int face)
{
  const auto& v = complex.tets[t];
  faces.push_back({ t,
                    face,
                    labelPair(complex.labels[t], complex.labels[complex.neighbours[t][face]]),
                    { v[(face + 1) & 3], v[(face + 2) & 3], v[(face + 3) & 3] },
                    complex.holder(t, face) });
}

void Sheet::addPoints(const TetComplex& complex, std::size_t k)
{
  const auto [t, face] = faces[k].holder;
  for (std::int32_t e = complex.sampleHeads[t][face]; e >= 0; e = complex.samples[e].next)
  {
    const double tolerance = complex.samples[e].tolerance;
    points.push_back({ complex.samples[e].position, tolerance * tolerance, e, std::int32_t(k), -1, 0 });
  }
}

void gatherSheet(const TetComplex& complex, std::int32_t v, const std::vector<std::int32_t>& star, Sheet& sheet)
{
  sheet.clear();
  if (!complex.onInterface[v]) return;
  for (std::int32_t t : star)
    for (int i = 0; i < 4; ++i)
    {
      const std::int32_t n = complex.neighbours[t][i];
      if (complex.tets[t][i] != v && n > t && complex.labels[n] != complex.labels[t]) sheet.addFace(complex, t, i);
    }
  for (std::size_t k = 0; k < sheet.faces.size(); ++k) sheet.addPoints(complex, k);
}

Fit fitOf(const TetComplex& complex, std::int32_t v, const Sheet& sheet, double robust)
{
  return fitAt(complex, v, complex.points[v], sheet, robust);
}

Fit fitAt(const TetComplex& complex, std::int32_t v, const Vec3& p, const Sheet& sheet, double robust)
{
  Fit fit;
  auto point = sheet.points.begin();
  for (std::size_t k = 0; k < sheet.faces.size(); ++k)
  {
    const SheetFace& f = sheet.faces[k];
    const int own = f.vertices[0] == v ? 0 : f.vertices[1] == v ? 1 : 2;
    const Vec3 x = complex.points[f.vertices[(own + 1) % 3]], y = complex.points[f.vertices[(own + 2) % 3]];
    const Vec3 n = cross(x - p, y - p);
    const double area2 = squaredNorm(n); // positive, as the tetrahedra on both sides are
    const Vec3 unit = n / std::sqrt(area2);
    const Vec3 slope = cross(unit, y - x) / std::sqrt(area2); // gradient of v's barycentric coordinate
    double weight = 0;
    for (; point != sheet.points.end() && std::size_t(point->from) == k; ++point)
    {
      const Vec3 d = point->position - p;
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
