// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Quality of the star of a vertex, and of the interface triangles at it, as a function of the vertex's position. Laid
/// out for SIMD: guarded operations spend more time on this than on anything else.

#include "TetComplex.h"

#include <array>
#include <vector>

namespace surgicalmesher
{

/// Factor on the quality of background: 6.8 degrees there count like 32 degrees in a tissue.
constexpr double backgroundLeniency = 20;

class StarQuality
{
public:
  /// Collects the geometry. `star`: the tetrahedra at v. `triangles`: the interface triangles at v, whose quality is
  /// multiplied by `triangleWeight`; 0: they do not count. Valid until a vertex other than v moves or the star changes.
  void gather(const TetComplex& complex, std::int32_t v, const std::vector<std::int32_t>& star,
              const std::vector<TetComplex::FaceOfTet>& triangles = {}, double triangleWeight = 0);

  /// Returns the worst quality (see GuardedOperations) with the vertex at p, or some value below `atLeast` if the worst
  /// is below `atLeast`. Tetrahedra and triangles that contain the vertex `without` do not count.
  double worst(const Vec3& p, double atLeast, std::int32_t without = -1) const;

  /// Returns the quality of each tetrahedron, in the order of the star, then that of each triangle, with the vertex at
  /// p. Only the first size() values count. The reference is valid until the next call.
  const std::vector<double>& each(const Vec3& p);

  /// Returns the sum of the unit gradients, by forward differences of step h (mm), of all qualities that are at most
  /// `most` with the vertex at p.
  Vec3 sumOfGradients(const Vec3& p, double h, double most) const;

  std::size_t size() const { return m_Size + m_TriangleCount; }
  bool isBackground(std::size_t i) const { return i < m_Size && m_Groups[i / lanes].weight[i % lanes] != 1; }

private:
  static constexpr std::size_t lanes = 4;
  struct Group
  {
    double corners[3][3][lanes]; ///< by corner and axis; positively wound with the vertex as the first corner
    double ids[3][lanes];        ///< of the corners; doubles, so that comparisons use the same registers
    double weight[lanes];
  };
  struct Triangles
  {
    double corners[2][3][lanes]; ///< by corner and axis
    double ids[2][lanes];
  };
  static void measure(const Group& group, const Vec3& p, double* quality);
  void measure(const Triangles& group, const Vec3& p, double* quality) const;
  void gatherTriangles(const TetComplex& complex, std::int32_t v, const std::vector<TetComplex::FaceOfTet>& triangles);
  template <class Groups, class Measure>
  static double worstOf(const Groups& groups, double without, double atLeast, double worst, Measure&& measure);
  template <class Groups, class Measure>
  static void addGradients(const Groups& groups, std::size_t size, const Vec3& p, double h, double most,
                           Measure&& measure, Vec3& sum);

  std::vector<Group> m_Groups;        ///< the last one is padded with copies of its first tetrahedron
  std::vector<Triangles> m_Triangles; ///< the last one is padded with copies of its last triangle
  std::vector<double> m_Each;
  std::size_t m_Size = 0, m_TriangleCount = 0;
  double m_TriangleWeight = 0;
};

} // namespace surgicalmesher
