// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The Eulerian operators of a simplex mesh (Delingette 1999; Audette et al. 2007, figure 3b), on the surface of all
/// tissues at once and each with every guard. The mesh is held by its dual triangles: a simplex vertex is the centroid
/// of its triangle, so both stay consistent whatever happens.
///
/// | operator | simplex mesh                                         | dual                     |
/// |----------|------------------------------------------------------|--------------------------|
/// | T1       | an edge goes, its two faces fuse: 5 edges become 2   | edge collapse            |
/// | T2       | a face is cut in two by a new edge: 2 edges become 5 | vertex split, edge split |
/// | T7       | an edge passes from two faces to the two at its ends | edge flip                |
///
/// An operation that returns false has changed nothing. It is refused if it would
///   - change any tissue's topology: on the surface of each tissue, the outside included, the link condition holds (two
///     faces fuse only if they share exactly one edge there), and no two tissues stop touching there. Faces on a
///     curve where three tissues meet may so fuse with others as long as each tissue stays what it is;
///   - leave a triangle that is flatter than `minimumQuality`, or turned from the boundary beside it by more than
///     `minimumCosine` says, or farther from it than the proximity bound, or leave a part of the boundary uncovered by
///     as much: worse than any of the triangles it replaces, that is;
///   - make the surface cross itself.

#include "BoxGrid.h"
#include "SimplexMesh.h"
#include "TissueBoundary.h"
#include "TriangleCrossing.h"

#include <functional>
#include <set>

namespace surgicalmesher
{

struct OperatorLimits
{
  std::function<double(const Vec3&)> edgeLength; ///< target L of the dual triangles, mm; simplex edges are L / sqrt(3)
  std::function<double(const Vec3&)> proximity;  ///< bound on the distance to the tissue boundary, mm
  double minimumQuality =
    0.3; ///< 4 sqrt(3) area / sum of squared edges: 1 equilateral, 0.3 with an angle of 8 to 9 degrees
  double minimumCosine = 0.3; ///< between the normals of a triangle and of the boundary
  /// The proximity bound is asked at the middles of edges and at the boundary's points as well: where it is a promise.
  bool isBoundStrict = false;
};

/// An edge of the dual, by its points.
using DualEdge = std::array<std::int32_t, 2>;

/// Its parts: operators (SimplexOperators.cxx), what refuses them by shape (OperatorGuards.cxx) and by topology
/// (TopologyGuards.cxx), and queries of what is around a face (FaceNeighbourhood.cxx) and of lengths and angles
/// (FaceMeasures.cxx).
class SimplexOperators
{
public:
  /// `surface` is to be sound (requireSound). `boundary` is kept by reference. `creases` are edges of the surface that
  /// stay: with the curves between tissues, no operator takes them away, joins them or lets a face leave them, and
  /// points where they end, meet others or turn by more than 45 degrees go into no other.
  SimplexOperators(const SurfaceComplex& surface, const TissueBoundary& boundary, OperatorLimits limits,
                   const std::vector<DualEdge>& creases = {});

  // --- operators; faces are ids of dual points
  /// T1: fuses faces a and b across the simplex edge between them.
  bool fuse(std::int32_t a, std::int32_t b);
  /// T2: cuts face a across its longer side. On a curve between tissues, the new face is made of four vertices per
  /// tissue.
  bool cut(std::int32_t a);
  /// T2 on the edge between a and b: a new face of four vertices, or of four per tissue, in its middle. In the dual,
  /// the edge ab is split.
  bool cutEdge(std::int32_t a, std::int32_t b);
  /// T7: the edge between faces a and b becomes one between the faces at its two ends.
  bool swap(std::int32_t a, std::int32_t b);
  /// Moves dual point a to p; no triangle may turn by more than 60 degrees.
  bool move(std::int32_t a, const Vec3& p);

  // --- queries
  const std::vector<Vec3>& points() const { return m_Points; }
  bool alive(std::int32_t face) const { return !m_At[face].empty(); }
  std::size_t faceCount() const;
  std::vector<std::int32_t> faceNeighbours(std::int32_t a) const; ///< ascending
  double area(std::int32_t a) const;              ///< of face a, mm^2: a third of the dual triangles' there
  Vec3 vertex(std::int32_t v) const;              ///< simplex vertex
  std::size_t mostVertices(std::int32_t a) const; ///< largest number of vertices of face a on the surface of one tissue
  /// Of the shortest simplex edge between faces a and b to its target; infinite if there is none.
  double edgeRatio(std::int32_t a, std::int32_t b) const;
  /// Faces at the two ends of the edge between faces a and b (to the left and to the right of the dual edge ab), if
  /// only one sheet passes there; else -1.
  std::array<std::int32_t, 2> endsOf(std::int32_t a, std::int32_t b) const;
  /// Of the centre of face a's vertices to the boundary of its tissues, mm: the largest over the sheets that meet
  /// there; the reach, if there is nothing nearer.
  double centreDistance(std::int32_t a) const;
  /// 0 inside a sheet, 1 on a curve between three or more tissues or on a crease, 2 where such curves meet, end or
  /// turn.
  int junctionOrder(std::int32_t a) const;
  bool isOnCrease(std::int32_t a) const;
  std::vector<Label> tissuesAt(std::int32_t a) const;              ///< ascending
  std::vector<std::int32_t> curveNeighbours(std::int32_t a) const; ///< along such curves, ascending
  double faceQuality(std::int32_t a, const Vec3& p) const;         ///< of the worst dual triangle at a, were that at p
  double edgeQuality(std::int32_t a, std::int32_t b) const;        ///< of the worst dual triangle at the edge
  double qualityAfterSwap(std::int32_t a, std::int32_t b) const;   ///< of the worse of the two that T7 would make
  /// How well faces a and b go together: the flatter, the rounder and the smaller they are as one, the more.
  double fusion(std::int32_t a, std::int32_t b) const;
  double proximity(const Vec3& p) const { return m_Limits.proximity(p); }
  double targetLength(const Vec3& p) const { return m_Limits.edgeLength(p); }

  /// The triangles as they are; `pointIds` receives for each point the id of its face here.
  SurfaceComplex surface(std::vector<std::int32_t>* pointIds = nullptr) const;
  /// The creases as they are, by the points of surface().
  std::vector<DualEdge> creases() const;

private:
  using Corners = std::array<std::int32_t, 3>;
  struct Triangle
  {
    Corners corners{ -1, -1, -1 };
    std::array<Label, 2> labels{};
  };
  struct Fit ///< of a triangle to the boundary
  {
    double distance = 0; ///< over the proximity bound
    double cosine = 1;
  };

  struct Facet ///< a triangle as it was or would be
  {
    CornerTriangle shape;
    std::array<Label, 2> labels;
    Vec3 centroid;
    double radius; ///< around the centroid
  };
  struct Patch
  {
    std::vector<Facet> facets;
    double quality = 1; ///< of the worst
    Fit fit;            ///< the worst
  };
  bool replace(const std::vector<std::int32_t>& old, const std::vector<Triangle>& fresh,
               const std::vector<std::pair<std::int32_t, Vec3>>& moved, bool sameTriangles);
  Patch patchOf(const std::vector<Triangle>& triangles) const;
  void addFits(Patch& patch, const std::vector<std::int32_t>& old);
  bool fits(const std::vector<Triangle>& fresh, const Fit& before);
  bool turns(const Patch& before, const Patch& after) const;
  bool crosses(const std::vector<std::int32_t>& old, const std::vector<Triangle>& fresh) const;
  bool staysCovered(const Patch& before, const Patch& after, const std::vector<std::int32_t>& old) const;
  bool coveredElsewhere(const Vec3& p, double within, const std::array<Label, 2>& labels,
                        const std::vector<std::int32_t>& old) const;
  bool keepsTissues(std::int32_t a, std::int32_t b) const;
  bool keepsCreases(std::int32_t a, std::int32_t b) const;
  bool isChamfer(std::int32_t a, std::int32_t b) const;
  std::vector<Vec3> creaseDirections(std::int32_t a) const;
  bool isCurve(std::int32_t a, std::int32_t b) const;
  bool isCrease(std::int32_t a, std::int32_t b) const
  {
    return !m_Creases.empty() && m_Creases.count({ std::min(a, b), std::max(a, b) }) > 0;
  }
  void setCrease(std::int32_t a, std::int32_t b) { m_Creases.insert({ std::min(a, b), std::max(a, b) }); }
  bool cutSheet(std::int32_t a);
  std::vector<std::int32_t> sheetRing(std::int32_t a) const;
  std::vector<std::int32_t> trianglesAt(std::int32_t a, std::int32_t b) const;
  std::vector<std::int32_t> neighboursOn(Label tissue, std::int32_t a) const;
  Vec3 onBoundary(const Vec3& p, const std::array<Label, 2>& labels) const;
  CornerTriangle cornersOf(const Triangle& t) const;
  Fit fitOf(const Triangle& t);
  double distanceAt(const Vec3& p, const std::array<Label, 2>& labels) const;
  double distanceOfPoint(std::int32_t p, const std::array<Label, 2>& labels);
  std::int32_t addPoint(const Vec3& p);
  void erase(std::int32_t t);
  std::int32_t insert(const Triangle& t);

  const TissueBoundary& m_Boundary;
  OperatorLimits m_Limits;
  std::vector<Vec3> m_Points;
  std::vector<std::vector<std::int32_t>> m_At; ///< triangles at each point, ascending; none: it is gone
  std::vector<Triangle> m_Triangles;           ///< corner -1: it is gone
  std::vector<Fit> m_Fits;
  /// Of each point to the boundary, mm, by labels, as far as it has been asked for.
  std::vector<std::vector<std::pair<std::array<Label, 2>, double>>> m_Distances;
  std::vector<std::int32_t> m_Free;
  std::set<DualEdge> m_Creases; ///< the lower id first
  BoxGrid m_Grid;
};

} // namespace surgicalmesher
