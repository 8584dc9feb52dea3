// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Assignment of hexahedra to parts, such as muscles, by the share of each hexahedron inside a part's closed surface
/// (Kim et al. 2018, section 3.2.2).

#include "ElementMesh.h"

#include <string>

namespace surgicalmesher
{

/// A closed surface, mm, with its name and file.
struct Part
{
  std::string name, file;
  TriangleSurface surface;
};

/// How well the elements of a part match it. Volumes in mm^3.
struct PartMatch
{
  std::size_t elements = 0;
  double cutOff = 0;        ///< an element can belong to the part only if a larger share of it lies inside
  double partVolume = 0;    ///< inside the surface
  double elementVolume = 0; ///< of the part's elements
  double recall = 0;        ///< shared volume of part and elements divided by the part's volume
  double precision = 0;     ///< shared volume of part and elements divided by the elements' volume
};

struct Classification
{
  std::vector<std::int32_t> part; ///< per element: 0 filler, n the n-th part
  std::vector<PartMatch> matches; ///< per part
};

/// Assigns each element to the part that contains its largest share, the first one if equal, among the parts whose
/// cut-off (in (0, 1)) the share exceeds. For a cut-off of 0, one is chosen so that the elements above it have the
/// part's volume as closely as possible; the paper's cut-offs are 52, 50 and 45 % for fine to coarse meshes. Shares are
/// computed from 216 points in each hexahedron, weighted by their volume. A part may end up without elements. Throws
/// InputError with the part's file if its surface is not closed or lies outside all elements, with its vertices and the
/// centres of its triangles.
Classification classified(const ElementMesh& mesh, const std::vector<Part>& parts, const std::vector<double>& cutOffs);

} // namespace surgicalmesher
