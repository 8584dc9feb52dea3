// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Which tetrahedra share a face; the surface between labels, and the mesh without what lies outside.

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

/// [t][f]: the tetrahedron beyond the face opposite corner f; -1: none.
using AcrossFaces = std::vector<std::array<std::int32_t, 4>>;

struct FaceAdjacency
{
  AcrossFaces across;
  std::vector<std::int32_t> overused; ///< tetrahedra with a face that more than two share, ascending
};

FaceAdjacency faceAdjacency(const TetMesh& mesh);

/// Finds the neighbours that are not in `across` yet; returns the overused tetrahedra among those faces, ascending.
std::vector<std::int32_t> matchOpenFaces(const std::vector<std::array<std::int32_t, 4>>& tetrahedra,
                                         std::size_t pointCount, AcrossFaces& across);

/// Regions of tetrahedra joined through faces: the region of each tetrahedron, numbered from 0 in the order of their
/// first tetrahedra. `joined(t, f)` says whether the face may be passed; it must say the same from both sides, and is
/// asked only where there is a tetrahedron beyond.
std::vector<std::int32_t> faceRegions(const FaceAdjacency& neighbours,
                                      const std::function<bool(std::int32_t t, int f)>& joined);

/// A face between different labels (0 beyond the mesh), of the tetrahedron of the higher one.
struct InterfaceFace
{
  std::int32_t tetrahedron;
  int face; ///< opposite this corner
  Label front;
};

/// In the order of the tetrahedra. `across`: where it is known.
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
