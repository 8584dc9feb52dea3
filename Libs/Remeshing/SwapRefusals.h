// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Cache of edges whose swap was refused, valid while no vertex moves. An edge is tried once for every mediocre
/// tetrahedron around it, and mostly nothing has changed since the first refusal.

#include "TetComplex.h"

#include <algorithm>

namespace surgicalmesher
{

class SwapRefusals
{
public:
  explicit SwapRefusals(std::size_t tetrahedra) : m_Of(tetrahedra) {}

  /// Records the refusal of edge ab; t is a tetrahedron at the edge.
  void add(const TetComplex& complex, std::int32_t t, std::int32_t a, std::int32_t b)
  {
    OfTetrahedron& own = m_Of[t];
    if (own.edges == 0 || own.since < own.changed) own = { own.changed, m_Time, 0 };
    own.edges |= edgeOf(complex, t, a, b);
  }

  /// Returns whether ab was refused and no tetrahedron of its `ring` has changed since.
  bool contains(const TetComplex& complex, std::int32_t a, std::int32_t b, const std::vector<std::int32_t>& ring) const
  {
    std::uint32_t newest = 0;
    for (const std::int32_t t : ring) newest = std::max(newest, m_Of[t].changed);
    return std::any_of(ring.begin(), ring.end(),
                       [&](std::int32_t t)
                       { return m_Of[t].since >= newest && m_Of[t].edges & edgeOf(complex, t, a, b); });
  }

  /// Invalidates refusals at tetrahedra that are new or have new neighbours.
  void forgetAt(const std::vector<std::int32_t>& tetrahedra)
  {
    ++m_Time;
    for (const std::int32_t t : tetrahedra)
    {
      if (std::size_t(t) >= m_Of.size()) m_Of.resize(std::size_t(t) + 1);
      m_Of[t].changed = m_Time;
    }
  }

private:
  struct OfTetrahedron
  {
    std::uint32_t changed = 0;
    std::uint32_t since = 0; ///< time of the first refusal; refusals before `changed` are void
    std::uint16_t edges = 0; ///< refused edges, one bit per pair of corners
  };
  static std::uint16_t edgeOf(const TetComplex& complex, std::int32_t t, std::int32_t a, std::int32_t b)
  {
    const auto [i, j] = std::minmax({ complex.indexOf(t, a), complex.indexOf(t, b) });
    return std::uint16_t(1 << (4 * i + j));
  }

  std::vector<OfTetrahedron> m_Of;
  std::uint32_t m_Time = 0; ///< counts changes
};

} // namespace surgicalmesher
