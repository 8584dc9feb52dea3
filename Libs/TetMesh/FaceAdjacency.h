// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Adjacency of tetrahedra through faces, the surface between labels, and the mesh without the outside.

#include "TetMesh.h"

#include <functional>

namespace surgicalmesher
{

/// Corners of the face opposite corner f, wound so that the normal points out of a positive tetrahedron.
constexpr std::array<std::array<int, 3>, 4> kFaceCorners{ { { 1, 2, 3 }, { 0, 3, 2 }, { 0, 1, 3 }, { 0, 2, 1 } } };

/// Corners of the six edges; edge e and edge 5 - e are opposite.
constexpr std::array<std::array<int, 2>, 6> kEdgeCorners{
  { { 0, 1 }, { 0, 2 }, { 0, 3 }, { 1, 2 }, { 1, 3 }, { 2, 3 } }
};

/// [t][f]: the tetrahedron beyond the face of tetrahedron t opposite corner f; -1: none.
using AcrossFaces = std::vector<std::array<std::int32_t, 4>>;

struct FaceAdjacency
{
  AcrossFaces across;
  std::vector<std::int32_t> overused; ///< tetrahedra with a face that more than two share, ascending
};

FaceAdjacency faceAdjacency(const TetMesh& mesh);

/// Finds the neighbours across the faces that are -1 in `across`. Returns the tetrahedra with overused faces among
/// these, ascending (see FaceAdjacency).
std::vector<std::int32_t> matchOpenFaces(const std::vector<std::array<std::int32_t, 4>>& tetrahedra,
                                         std::size_t pointCount, AcrossFaces& across);

/// Finds the regions of tetrahedra that are connected through faces. Returns the region of each tetrahedron, numbered
/// from 0 in the order of their first tetrahedra. `joined(t, f)` says whether the face connects; it must return the
/// same from both sides, and is called only where there is a tetrahedron beyond.
std::vector<std::int32_t> faceRegions(const FaceAdjacency& neighbours,
                                      const std::function<bool(std::int32_t t, int f)>& joined);

/// A face between different labels (0 beyond the mesh), as a face of the tetrahedron with the higher label.
struct InterfaceFace
{
  std::int32_t tetrahedron;
  int face; ///< opposite this corner
  Label front;
};

/// Returns the faces between different labels in the order of the tetrahedra. `across`: the adjacency, if known
/// already.
std::vector<InterfaceFace> interfaceFaces(const TetMesh& mesh);
std::vector<InterfaceFace> interfaceFaces(const TetMesh& mesh, const AcrossFaces& across);

/// The triangles of interfaceFaces(), in their order, wound so that the higher label is behind. `pointIds`, if given,
/// receives for each point of the surface its id in the mesh, ascending.
SurfaceComplex interfaceOf(const TetMesh& mesh, std::vector<std::int32_t>* pointIds = nullptr);
SurfaceComplex interfaceOf(const TetMesh& mesh, const AcrossFaces& across,
                           std::vector<std::int32_t>* pointIds = nullptr);

/// The tetrahedra of `mesh` with a label other than 0, and the points they use, both in the same order. `pointIds`, if
/// given, receives for each point of the result its id in `mesh`.
TetMesh withoutOutside(const TetMesh& mesh, std::vector<std::int32_t>* pointIds = nullptr);

} // namespace surgicalmesher
