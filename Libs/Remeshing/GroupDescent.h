// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Moves several vertices together where no single one could move without making another tetrahedron the worst.

#include "GuardedOperations.h"

#include <cstdint>
#include <utility>
#include <vector>

namespace surgicalmesher
{

/// Reduces, vertex by vertex, the sum over the tetrahedra at a group of vertices of the squared deficit: what the sine
/// of the worst angle lacks to a little more than the target. All moves can be undone.
class GroupDescent
{
public:
  /// `target`: quality that the tetrahedra should reach; `ease`: as in PolishingOptions.
  GroupDescent(GuardedOperations& operations, double target, double ease);

  /// Sets the group to the free vertices among v and its neighbours, v first.
  void setAround(std::int32_t v);
  void set(std::vector<std::int32_t> vertices);
  const std::vector<std::int32_t>& vertices() const { return m_Vertices; }

  /// Returns the worst quality at the vertices.
  double worst();
  /// Moves each vertex once, if a step reduces its deficit and leaves no quality at it below `floor`. Returns whether
  /// any vertex has moved.
  bool step(double floor);
  /// Undoes all moves since the group was set.
  void takeBack();

private:
  double lack(std::int32_t v, const Vec3& p);
  bool descend(std::int32_t v, double floor);

  GuardedOperations& m_Operations;
  TetComplex& m_Complex;
  const double m_Target, m_Ease;
  std::vector<std::int32_t> m_Vertices;
  std::vector<std::pair<std::int32_t, Vec3>> m_Moves; ///< vertices moved, and their position before
};

} // namespace surgicalmesher
