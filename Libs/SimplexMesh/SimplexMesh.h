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
/// Inside the sheet between two tissues a vertex has the same three neighbours on both surfaces. Where three or more
/// tissues meet, the sheet goes on into another one on each surface, and so the neighbours differ while the vertex is
/// shared: forces on it come from both surfaces, and contiguous tissues keep their common boundary.

#include "TetMesh.h"

namespace surgicalmesher
{

struct SimplexMesh
{
  std::vector<Vec3> points;                 ///< the vertices, mm
  std::vector<std::array<Label, 2>> labels; ///< per vertex: the tissues [behind, in front of] the surface; 0 outside
  std::vector<std::array<std::int32_t, 3>>
    faces; ///< per vertex: ids of the three faces around it, counter-clockwise as
           ///< seen from the front; faces of one dual point share its id
  /// [vertex][side][k]: the neighbour, on the surface of labels[vertex][side], across the edge between the other two
  /// faces than k. Side 1 lists them clockwise as seen from its tissue's outside. The outside itself may be pinched
  /// along an edge: its neighbours there are -1, all three.
  std::vector<std::array<std::array<std::int32_t, 3>, 2>> neighbours;
  std::int32_t faceCount = 0;
};

/// One tissue's side of a dual point.
struct SimplexFace
{
  Label tissue = 0;
  std::int32_t id = 0;                ///< as in SimplexMesh::faces
  std::vector<std::int32_t> vertices; ///< counter-clockwise as seen from outside the tissue
};

/// Whether a surface is whole or a part that ends somewhere.
enum class Extent
{
  whole,
  part
};

/// The vertex of each triangle lies at its centroid; triangle i becomes vertex i, and point i the faces of id i. Throws
/// InputError unless every tissue's surface has two triangles at each of its edges; of a part it may have one, which
/// then has no neighbours on that side.
SimplexMesh simplexMeshOf(const SurfaceComplex& surface, Extent extent = Extent::whole);

/// The dual triangles, connected as those that simplexMeshOf() was given. Each is to have its vertex as its centroid:
/// the points are the least-squares solution, found from the mean of the vertices around each by conjugate gradients.
/// Vertices on a curved boundary thus give triangles that touch it, where the means alone would lie within.
SurfaceComplex dualTriangles(const SimplexMesh& mesh);

/// All faces of all tissues, the outside left out, by face id, then tissue.
std::vector<SimplexFace> simplexFaces(const SimplexMesh& mesh);

} // namespace surgicalmesher
