// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Checks of what must hold for surface complexes and labelled tetrahedra, from scratch: the last check of every run,
/// the first check of files from elsewhere, and the assertions of the tests.

#include "DigitalTopology.h"
#include "Place.h"
#include "TetMesh.h"

#include <map>
#include <string>

namespace surgicalmesher
{

/// The number of occurrences of a defect, and the first of them in the order of the arrays.
struct Defect
{
  std::size_t count = 0;
  Vec3 where;             ///< place of the first
  std::int32_t item = -1; ///< index of the first: triangle, tetrahedron or point

  void add(const Vec3& at, std::int32_t index)
  {
    if (count++ == 0)
    {
      where = at;
      item = index;
    }
  }
};

/// One tissue's boundary: all triangles that have its label on exactly one side.
struct TissueSurface
{
  std::size_t triangles = 0;
  Defect openEdges;           ///< edges of an odd number of its triangles
  Defect misorientedEdges;    ///< edges whose triangles don't have the tissue on matching sides
  Defect nonManifoldEdges;    ///< edges of four or more of its triangles
  Defect nonManifoldVertices; ///< points whose triangles, joined through edges, form several fans
  int euler = 0;              ///< V - E + F
  double volume = 0;          ///< enclosed, mm^3

  bool closed() const { return openEdges.count == 0 && misorientedEdges.count == 0; }
  bool manifold() const { return closed() && nonManifoldEdges.count == 0 && nonManifoldVertices.count == 0; }
};

/// Checks the surface of each tissue. Background is left out: two tissues that touch along an edge pinch it, which is
/// allowed.
std::map<Label, TissueSurface> checkSurface(const SurfaceComplex& surface);

struct MeshDefects
{
  Defect invertedOrFlat;  ///< tetrahedra whose volume isn't positive
  Defect overusedFaces;   ///< tetrahedra with a face that more than two share
  Defect unusedPoints;    ///< points of no tetrahedron
  Defect duplicatePoints; ///< points at exactly the position of an earlier one

  bool none() const
  {
    return invertedOrFlat.count == 0 && overusedFaces.count == 0 && unusedPoints.count == 0 &&
           duplicatePoints.count == 0;
  }
};

MeshDefects checkMesh(const TetMesh& mesh);

/// Betti numbers of every tissue's tetrahedra, comparable with those of a label map: a tissue is connected through
/// faces, its complement through edges and points as well. Label 0 is left out; the space beyond the mesh belongs to
/// the complement.
std::map<Label, Betti> meshTopology(const TetMesh& mesh);

/// Throws EngineError, naming `stage` and the place in mm, unless the mesh has no defects and every tissue's surface is
/// a closed 2-manifold.
void requireSound(const TetMesh& mesh, const std::string& stage);

/// The same for a surface.
void requireSound(const SurfaceComplex& surface, const std::string& stage);

} // namespace surgicalmesher
