// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Folds of the interface: edges at which its normals turn by more than a right angle, from a triangle to the next that
/// parts the same two labels, or that bounds the background as well (cornerBeyond).

#include "BoundarySamples.h"

namespace surgicalmesher
{

/// The ends of an edge, and the corners beyond it of the two triangles there; each pair in ascending order.
using Hinge = std::array<std::int32_t, 4>;

/// The hinges at the edges of the faces of some sheets, each once. Edges on a block's border have none if the other
/// triangle is outside.
class Hinges
{
public:
  void clear() { m_Hinges.clear(); }
  void add(const TetComplex& complex, const Sheet& sheet);
  const std::vector<Hinge>& sorted();

private:
  std::vector<Hinge> m_Hinges;
};

/// Radians between the normals of a hinge's triangles.
double turnAt(const TetComplex& complex, const Hinge& hinge);

/// Length, mm, of a hinge's edge.
double lengthAt(const TetComplex& complex, const Hinge& hinge);

/// What of that length is folded: all of it from 94 degrees on, half at 90, nothing below 86. A step at 90 degrees would
/// leave folds of 89 to whatever comes next.
double foldedAt(const TetComplex& complex, const Hinge& hinge);

/// The sum of that, mm.
double foldedLength(const TetComplex& complex, const std::vector<Hinge>& hinges);

/// How much more of the length of the edges of v's `sheet` would be folded, were v at p.
double foldedMore(const TetComplex& complex, std::int32_t v, const Vec3& p, const Sheet& sheet);

} // namespace surgicalmesher
