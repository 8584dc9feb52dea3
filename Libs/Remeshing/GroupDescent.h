// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Vertices that move together where none alone could without making another tetrahedron the worst.

#include "GuardedOperations.h"

#include <cstdint>
#include <utility>
#include <vector>

namespace surgicalmesher
{

/// Descends the sum of the squares of what all tetrahedra at some vertices lack, vertex by vertex, and can take it all
/// back.
class GroupDescent
{
public:
  /// `target`: quality that tetrahedra are to have and a little more; `ease`: as in PolishingOptions.
  GroupDescent(GuardedOperations& operations, double target, double ease);

  /// The free vertices among v and its neighbours, v first.
  void setAround(std::int32_t v);
  void set(std::vector<std::int32_t> vertices);
  const std::vector<std::int32_t>& vertices() const { return m_Vertices; }

  /// Quality of the worst tetrahedron at the vertices.
  double worst();
  /// A step of each of them that can make one without a tetrahedron at it falling below `floor`; false: none could.
  bool step(double floor);
  /// Everything as it was when the vertices were set.
  void takeBack();

private:
  double lack(std::int32_t v, const Vec3& p);
  bool descend(std::int32_t v, double floor);

  GuardedOperations& m_Operations;
  TetComplex& m_Complex;
  const double m_Target, m_Ease;
  std::vector<std::int32_t> m_Vertices;
  std::vector<std::pair<std::int32_t, Vec3>> m_Moves; ///< and from where
};

} // namespace surgicalmesher
