// SPDX-License-Identifier: Apache-2.0
#include "FeatureSides.h"

#include <algorithm>
#include <cmath>

namespace surgicalmesher
{

namespace
{

// Of a thousandth of a radian: rounding of coordinates to single precision tilts triangles by less.
constexpr double kFlatCosine = 1 - 0.5e-6;
// Least length of the component of a unit normal orthogonal to the normals found before, for it to count as another
// direction: planes that meet in a sharp edge exceed it by far.
constexpr double kIndependent = 1e-2;

Vec3 outwardNormal(const TetComplex& complex, const SheetFace& face)
{
  const auto corner = [&](int k) -> const Vec3& { return complex.points[face.vertices[k]]; };
  const Vec3 n = cross(corner(1) - corner(0), corner(2) - corner(0));
  const Vec3& apex = complex.points[complex.tets[face.tet][face.face]];
  const bool leavesTet = dot(n, apex - corner(0)) < 0, leavesLarger = complex.labels[face.tet] == face.labels >> 16;
  return (leavesTet == leavesLarger ? 1 : -1) / norm(n) * n;
}

} // namespace

FeatureSides::FeatureSides(double angle) : m_LeastCosine(std::cos(angle * std::acos(-1.0) / 180)) {}

void FeatureSides::find(const TetComplex& complex, const std::vector<SheetFace>& faces)
{
  m_Triangles.clear();
  m_FlatNormals.clear();
  for (const SheetFace& face : faces) m_Triangles.push_back({ outwardNormal(complex, face), face.labels, true });
  for (auto side = m_Triangles.begin(), end = side; side != m_Triangles.end(); side = end)
  {
    end = side + 1;
    for (auto at = side; at != end; ++at)
      end = std::partition(end, m_Triangles.end(),
                           [&](const Triangle& t)
                           { return t.labels == at->labels && dot(t.normal, at->normal) >= m_LeastCosine; });
    Vec3 sum;
    for (auto t = side; t != end; ++t) sum += t->normal;
    const Vec3 mean = sum / norm(sum);
    const bool isFlat = std::all_of(side, end, [&](const Triangle& t) { return dot(t.normal, mean) >= kFlatCosine; });
    for (auto t = side; t != end; ++t) t->isFlat = isFlat;
    const Vec3 rest = isFlat ? along(mean) : Vec3{};
    if (norm(rest) > kIndependent) m_FlatNormals.push_back(rest / norm(rest));
  }
}

bool FeatureSides::allow(const Vec3& normal, LabelPair labels) const
{
  return std::any_of(m_Triangles.begin(), m_Triangles.end(),
                     [&](const Triangle& t)
                     {
                       const double least = t.isFlat ? kFlatCosine : m_LeastCosine;
                       return t.labels == labels && std::abs(dot(t.normal, normal)) >= least;
                     });
}

Vec3 FeatureSides::along(Vec3 step) const
{
  for (const Vec3& normal : m_FlatNormals) step = step - dot(normal, step) * normal;
  return m_FlatNormals.size() > 2 ? Vec3{} : step;
}

} // namespace surgicalmesher
