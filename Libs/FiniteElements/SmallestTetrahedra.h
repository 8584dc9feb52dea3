// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The tetrahedra that limit the time step of an explicit solver, and the reasons why they are small.

#include "MeshIO.h"

namespace surgicalmesher
{

/// Why a tetrahedron is small; the first reason that applies.
enum class SmallBecause
{
  NullDisplacement, ///< it is held fixed and does not limit the step
  Junction,         ///< three or more tissues meet at one of its corners, the outside included
  ThinTissue,       ///< its tissue is thinner than L in the direction of its least height
  Boundary,         ///< it has a corner on the boundary of its tissue
  Inside            ///< none of these: left by the mesh improvement
};

/// Returns the text used in reports: "null displacement", "junction", "thin tissue", "boundary", "inside".
const char* nameOf(SmallBecause reason);

struct SmallTetrahedron
{
  std::int32_t tetrahedron = 0;
  double height = 0;     ///< mm; the least of its four heights
  double edgeLength = 0; ///< mm; L, mean over the corners
  double thickness = 0;  ///< mm; of its tissue, through its centroid in the direction of the least height
  Vec3 place;            ///< mm; its centroid
  SmallBecause reason = SmallBecause::Inside;
};

/// Returns the `count` tetrahedra of least height, ascending (ties by index). `content` must meet requireSound() and
/// have a targetEdgeLength.
std::vector<SmallTetrahedron> smallestTetrahedra(const MeshFile& content, std::size_t count = 100);

} // namespace surgicalmesher
