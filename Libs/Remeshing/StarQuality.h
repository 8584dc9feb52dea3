// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The tetrahedra at a vertex, and the triangles between labels, laid out so that several are measured at once wherever
/// the vertex is put: guarded operations spend more time on this than on anything else.

#include "TetComplex.h"

#include <array>
#include <vector>

namespace surgicalmesher
{

constexpr double backgroundLeniency = 20; ///< worst angles of 32 degrees inside weigh as 6.8 degrees outside

class StarQuality
{
public:
  /// `star`: the tetrahedra at v. Stays true until another vertex than v moves, or the star changes. `triangles`: those
  /// between labels, which count with `triangleWeight`; 0: not at all.
  void gather(const TetComplex& complex, std::int32_t v, const std::vector<std::int32_t>& star,
              const std::vector<TetComplex::FaceOfTet>& triangles = {}, double triangleWeight = 0);

  /// The worst quality (see GuardedOperations) with the vertex at p, or some value below `atLeast` if it is less than
  /// that. What contains the vertex `without` does not count.
  double worst(const Vec3& p, double atLeast, std::int32_t without = -1) const;

  /// The quality of each tetrahedron, in the order of the star, and of each triangle after them, with the vertex at p.
  /// The result lives until the next call.
  const std::vector<double>& each(const Vec3& p);

  /// The sum of the unit gradients, by differences of step h (mm), of all that are no better than `most` with the vertex
  /// at p.
  Vec3 sumOfGradients(const Vec3& p, double h, double most) const;

  std::size_t size() const { return m_Size + m_TriangleCount; }
  bool isBackground(std::size_t i) const { return i < m_Size && m_Groups[i / lanes].weight[i % lanes] != 1; }

private:
  static constexpr std::size_t lanes = 4;
  struct Group
  {
    double corners[3][3][lanes]; ///< by corner and axis: with the vertex, a positively wound tetrahedron
    double ids[3][lanes];        ///< of the corners; as doubles they are compared in the same registers
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

  std::vector<Group> m_Groups;        ///< the last one filled up with its first tetrahedron
  std::vector<Triangles> m_Triangles; ///< the last one filled up with its last triangle
  std::vector<double> m_Each;
  std::size_t m_Size = 0, m_TriangleCount = 0;
  double m_TriangleWeight = 0;
};

} // namespace surgicalmesher
