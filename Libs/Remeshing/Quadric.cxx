// SPDX-License-Identifier: Apache-2.0
#include "Quadric.h"

#include "Bending.h"
#include "Prefetch.h"

#include <algorithm>
#include <cmath>

namespace surgicalmesher
{

namespace
{

/// Adds the squared distance of the vertex to the plane of a sample, with a weight that falls with the distance |way|
/// of the sample. `normal` as in BackgroundMesh::Sample.
template <bool hasGoal>
void addPlane(const std::array<float, 3>& normal, const Vec3& way, Quadric& quadric)
{
  constexpr double share = 0.3; // largest weight, relative to the distance between face and sample
  const Vec3 n{ normal[0], normal[1], normal[2] };
  const double perRadius2 = squaredNorm(n), near = 1 - squaredNorm(way) * perRadius2;
  if (perRadius2 == 0 || near <= 0) return;
  const double w = share * near * near / perRadius2;
  if (hasGoal) quadric.g += (w * dot(n, way)) * n;
  double* m = quadric.m;
  m[0] += w * n.x * n.x, m[1] += w * n.x * n.y, m[2] += w * n.x * n.z;
  m[3] += w * n.y * n.y, m[4] += w * n.y * n.z, m[5] += w * n.z * n.z;
}

/// Returns the quadric of the samples alone, see quadricOf; g is computed only if `hasGoal`.
template <bool hasGoal>
Quadric ofSamples(const TetComplex& complex, std::int32_t v, const Vec3& p, const Sheet& sheet, double robust)
{
  constexpr std::ptrdiff_t ahead = 4; // samples; processing them takes about as long as fetching a normal
  Quadric quadric;
  const bool hasNormals = !complex.sampleNormals.empty();
  auto sample = sheet.samples.begin();
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
    for (; sample != sheet.samples.end() && std::size_t(sample->from) == k; ++sample)
    {
      if (hasNormals && sheet.samples.end() - sample > ahead) prefetch(&complex.sampleNormals[(sample + ahead)->id]);
      const Vec3 d = sample->position - p;
      const double b = std::clamp(1 + dot(slope, d), 0.0, 1.0);
      const double height = dot(unit, d), w = robust > 0 ? robust / (robust + std::abs(height)) : 1;
      weight += w * b * b;
      if (hasGoal) quadric.g += (w * b * height) * unit;
      if (hasNormals) addPlane<hasGoal>(complex.sampleNormal(sample->id), d, quadric);
    }
    double* m = quadric.m;
    m[0] += weight * unit.x * unit.x, m[1] += weight * unit.x * unit.y, m[2] += weight * unit.x * unit.z;
    m[3] += weight * unit.y * unit.y, m[4] += weight * unit.y * unit.z, m[5] += weight * unit.z * unit.z;
  }
  return quadric;
}

} // namespace

Vec3 Quadric::times(const Vec3& x) const
{
  return { m[0] * x.x + m[1] * x.y + m[2] * x.z, m[1] * x.x + m[3] * x.y + m[4] * x.z,
           m[2] * x.x + m[4] * x.y + m[5] * x.z };
}

Vec3 Quadric::solve(const Vec3& b) const
{
  const Vec3 r0{ m[0], m[1], m[2] }, r1{ m[1], m[3], m[4] }, r2{ m[2], m[4], m[5] };
  const Vec3 c0 = cross(r1, r2), c1 = cross(r2, r0), c2 = cross(r0, r1);
  const double det = dot(r0, c0);
  if (!(std::abs(det) > 1e-300)) return {};
  return (b.x * c0 + b.y * c1 + b.z * c2) / det;
}

void Quadric::add(const Quadric& other, double weight)
{
  for (int i = 0; i < 6; ++i) m[i] += weight * other.m[i];
  g += weight * other.g;
}

Quadric quadricOf(const TetComplex& complex, std::int32_t v, const Sheet& sheet, double robust, double rigidity)
{
  return quadricWith(complex, v, complex.points[v], sheet, robust, rigidity);
}

Quadric resistanceOf(const TetComplex& complex, std::int32_t v, const Sheet& sheet)
{
  return ofSamples<false>(complex, v, complex.points[v], sheet, 0);
}

Quadric quadricWith(const TetComplex& complex, std::int32_t v, const Vec3& p, const Sheet& sheet, double robust,
                    double rigidity)
{
  Quadric quadric = ofSamples<true>(complex, v, p, sheet, robust);
  if (rigidity > 0)
  {
    const Quadric bending = bendingOf(complex, v, p, sheet);
    if (bending.trace() > 0) quadric.add(bending, rigidity * quadric.trace() / bending.trace());
  }
  return quadric;
}

} // namespace surgicalmesher
