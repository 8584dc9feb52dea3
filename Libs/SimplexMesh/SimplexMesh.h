// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The 2-simplex mesh that is dual to the surface complex of all tissues (Delingette 1999; Audette et al. 2007, figure
/// 3a).
///
/// | triangle complex          | simplex mesh                                            |
/// |---------------------------|---------------------------------------------------------|
/// | triangle                  | vertex; it has three neighbours on each tissue's surface |
/// | edge                      | edges, one for each tissue whose surface passes it       |
/// | point                     | faces (polygons), one for each tissue that has the point |
///
/// Within the interface between two tissues, a vertex has the same three neighbours on both surfaces. Where three or
/// more tissues meet, the surface of each tissue continues into a different interface: the neighbours differ while the
/// vertex is shared. Forces on the vertex come from both surfaces, and contiguous tissues keep their common boundary.

#include "TetMesh.h"

namespace surgicalmesher
{

struct SimplexMesh
{
  std::vector<Vec3> points;                 ///< the vertices, mm
  std::vector<std::array<Label, 2>> labels; ///< per vertex: the tissues [behind, in front of] the surface; 0 outside
  /// Per vertex: ids of the three faces around it, counter-clockwise as seen from the front. The faces of all tissues
  /// at one dual point share its id.
  std::vector<std::array<std::int32_t, 3>> faces;
  /// [vertex][side][k]: the neighbour on the surface of tissue labels[vertex][side] across the edge opposite to face k.
  /// On side 1 the order is clockwise as seen from outside its tissue. All three are -1 where one is missing: where the
  /// outside is pinched along an edge, or at the border of a part.
  std::vector<std::array<std::array<std::int32_t, 3>, 2>> neighbours;
  std::int32_t faceCount = 0;
};

/// The face that one tissue has at a dual point.
struct SimplexFace
{
  Label tissue = 0;
  std::int32_t id = 0;                ///< as in SimplexMesh::faces
  std::vector<std::int32_t> vertices; ///< counter-clockwise as seen from outside the tissue
};

/// Whether a surface is complete or a part with a border.
enum class Extent
{
  whole,
  part
};

/// Returns the simplex mesh that is dual to `surface`: vertex i is the centroid of triangle i, and the faces at point i
/// have id i. Throws InputError unless the surface of every tissue has two triangles at each of its edges. With
/// Extent::part an edge may have one; its triangle then has no neighbours on that side.
SimplexMesh simplexMeshOf(const SurfaceComplex& surface, Extent extent = Extent::whole);

/// Returns the dual triangles of `mesh`, with the connectivity of the surface given to simplexMeshOf(). The points are
/// the least-squares solution for triangles whose centroids are the vertices, found by conjugate gradients from the
/// mean of the vertices around each point. Vertices on a curved boundary thus give triangles that touch it, where the
/// means alone would lie inside.
SurfaceComplex dualTriangles(const SimplexMesh& mesh);

/// Returns the faces of all tissues except the outside, ordered by face id, then tissue.
std::vector<SimplexFace> simplexFaces(const SimplexMesh& mesh);

} // namespace surgicalmesher
