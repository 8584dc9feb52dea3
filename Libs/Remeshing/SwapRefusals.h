// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Edges whose swap was refused, while vertices stay: each comes up once for every mediocre tetrahedron around it, and
/// mostly nothing has changed since the first.

#include "TetComplex.h"

#include <algorithm>

namespace surgicalmesher
{

class SwapRefusals
{
public:
  explicit SwapRefusals(std::size_t tetrahedra) : m_Of(tetrahedra) {}

  /// Edge ab was refused; t is a tetrahedron at it.
  void add(const TetComplex& complex, std::int32_t t, std::int32_t a, std::int32_t b)
  {
    OfTetrahedron& own = m_Of[t];
    if (own.edges == 0 || own.since < own.changed) own = { own.changed, m_Time, 0 };
    own.edges |= edgeOf(complex, t, a, b);
  }

  /// Whether ab was refused and nothing has changed at its ring since.
  bool contains(const TetComplex& complex, std::int32_t a, std::int32_t b, const std::vector<std::int32_t>& ring) const
  {
    std::uint32_t newest = 0;
    for (const std::int32_t t : ring) newest = std::max(newest, m_Of[t].changed);
    return std::any_of(ring.begin(), ring.end(),
                       [&](std::int32_t t)
                       { return m_Of[t].since >= newest && m_Of[t].edges & edgeOf(complex, t, a, b); });
  }

  /// Tetrahedra are new, or what is around them.
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
    std::uint32_t since = 0; ///< the first of its refusals; they no longer count if it has changed later
    std::uint16_t edges = 0; ///< refused, a bit for each pair of corners
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
