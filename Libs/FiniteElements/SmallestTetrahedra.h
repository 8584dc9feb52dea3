// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The tetrahedra that set an explicit solver's step, and why they are as small as they are.

#include "MeshIO.h"

namespace surgicalmesher
{

/// The first that applies.
enum class SmallBecause
{
  NullDisplacement, ///< it is held still, and sets no step
  Junction,         ///< at one of its corners three tissues or more meet, outside included
  ThinTissue,       ///< in the direction of its least height, its tissue is thinner than L
  Boundary,         ///< it has a corner on its tissue's boundary
  Inside            ///< none of these: improvement left it
};

/// "null displacement", "junction", "thin tissue", "boundary", "inside": as in reports.
const char* nameOf(SmallBecause reason);

struct SmallTetrahedron
{
  std::int32_t tetrahedron = 0;
  double height = 0;     ///< mm; the least of its four
  double edgeLength = 0; ///< mm; L, the mean of the corners'
  double thickness = 0;  ///< mm; of its tissue, through its centre in the direction of the least height
  Vec3 place;            ///< mm; its centre
  SmallBecause reason = SmallBecause::Inside;
};

/// The `count` tetrahedra of least height, ascending (of equal ones, the first). `content` as requireSound() has it,
/// with targetEdgeLength.
std::vector<SmallTetrahedron> smallestTetrahedra(const MeshFile& content, std::size_t count = 100);

} // namespace surgicalmesher
