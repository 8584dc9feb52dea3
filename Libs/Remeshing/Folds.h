// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Folds of the interface: edges at which the normal turns by more than a right angle between two triangles that form a
/// hinge (Bending.h): they separate the same two labels, or both bound the background.

#include "BoundarySamples.h"

namespace surgicalmesher
{

/// The two ends of an edge, then the third corners of the two triangles at it; each pair in ascending order.
using Hinge = std::array<std::int32_t, 4>;

/// The set of hinges at the edges of the faces of one or several sheets. Edges on a block's border have none if the
/// other triangle lies outside the block.
class Hinges
{
public:
  void clear() { m_Hinges.clear(); }
  void add(const TetComplex& complex, const Sheet& sheet);
  const std::vector<Hinge>& sorted();

private:
  std::vector<Hinge> m_Hinges;
};

/// Returns the angle, radians, between the normals of a hinge's triangles.
double turnAt(const TetComplex& complex, const Hinge& hinge);

/// Returns the length, mm, of a hinge's edge.
double lengthAt(const TetComplex& complex, const Hinge& hinge);

/// Returns the folded length, mm, of a hinge's edge: all of its length from 94 degrees on, half at 90, none below 86.
/// With a step at 90 degrees, turns of 89 degrees would pass, and become folds by the next operation.
double foldedAt(const TetComplex& complex, const Hinge& hinge);

/// Returns the sum of foldedAt() over `hinges`, mm.
double foldedLength(const TetComplex& complex, const std::vector<Hinge>& hinges);

/// Returns the growth, mm, of the folded length of the edges of `sheet` (the interface faces at v) if v moved to p.
double foldedMore(const TetComplex& complex, std::int32_t v, const Vec3& p, const Sheet& sheet);

} // namespace surgicalmesher
