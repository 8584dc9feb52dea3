// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Which hexahedra belong to which part, muscles for one, by how much of each lies inside the part's closed surface
/// (Kim et al. 2018, section 3.2.2).

#include "ElementMesh.h"

#include <string>

namespace surgicalmesher
{

/// A closed surface, mm, and what it is called.
struct Part
{
  std::string name, file;
  TriangleSurface surface;
};

/// What the elements of a part make of it. Volumes in mm^3.
struct PartMatch
{
  std::size_t elements = 0;
  double cutOff = 0;        ///< an element belongs to the part if a larger share of it lies inside
  double partVolume = 0;    ///< inside the surface
  double elementVolume = 0; ///< of the part's elements
  double recall = 0;        ///< volume that part and elements share, of the part's
  double precision = 0;     ///< and of the elements'
};

struct Classification
{
  std::vector<std::int32_t> part; ///< per element: 0 filler, n the n-th part
  std::vector<PartMatch> matches; ///< per part
};

/// Elements go to the part that has most of them, the first of equal ones, among those whose cut-off (in (0, 1)) they
/// exceed. A cut-off of 0 is chosen so that the elements above it have the part's volume, as nearly as they can: the
/// paper's are 52, 50 and 45 % for fine to coarse meshes. Shares are those of 216 points in each hexahedron, by the
/// volume they stand for. A part may end without an element. Throws InputError, naming the part's file, if a surface is
/// not closed, or lies outside all elements.
Classification classified(const ElementMesh& mesh, const std::vector<Part>& parts, const std::vector<double>& cutOffs);

} // namespace surgicalmesher
