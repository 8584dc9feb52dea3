// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The Eulerian operators of a simplex mesh (Delingette 1999; Audette et al. 2007, figure 3b), applied to the surfaces
/// of all tissues at once under guards. The mesh is stored as its dual triangles; a simplex vertex is the centroid of
/// its triangle, so that mesh and dual always stay consistent.
///
/// | operator | simplex mesh                                         | dual                     |
/// |----------|------------------------------------------------------|--------------------------|
/// | T1       | an edge is removed, its faces fuse: 5 edges become 2 | edge collapse            |
/// | T2       | a face is cut in two by a new edge: 2 edges become 5 | vertex split, edge split |
/// | T7       | an edge passes from two faces to the two at its ends | edge flip                |
///
/// An operation that returns false has left the mesh unchanged. An operation is refused if it would
/// - change the topology of any tissue. On the surface of each tissue, the outside included, the link condition must
///   hold (two faces fuse only if they share exactly one edge there), and tissues that touch must stay in contact.
///   Faces on a curve where three tissues meet may fuse with others as long as each tissue keeps its topology;
/// - create a triangle that violates a bound and is also worse in this than every triangle it replaces: quality below
///   `minimumQuality`, cosine to the normal of the boundary beside it below `minimumCosine`, or distance from the
///   boundary above the proximity bound; or leave a part of the boundary farther than that bound from the surface;
/// - make the surface intersect itself.

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
  /// Target length L of the dual edges, mm; simplex edges are L / sqrt(3)
  std::function<double(const Vec3&)> edgeLength;
  std::function<double(const Vec3&)> proximity; ///< bound on the distance to the tissue boundary, mm
  /// 4 sqrt(3) area / sum of squared edges: 1 for an equilateral triangle, 0.3 for one with an angle of 8 to 9 degrees.
  double minimumQuality = 0.3;
  double minimumCosine = 0.3; ///< between the normals of a triangle and of the boundary
  /// Applies the proximity bound also at the midpoints of edges and at all samples of the boundary, for callers that
  /// guarantee it.
  bool isBoundStrict = false;
};

/// An edge of the dual, given by its two points.
using DualEdge = std::array<std::int32_t, 2>;

/// Implemented in several files: operators (SimplexOperators.cxx), guards of shape (OperatorGuards.cxx) and of topology
/// (TopologyGuards.cxx), queries of the neighbourhood of a face (FaceNeighbourhood.cxx) and of lengths and angles
/// (FaceMeasures.cxx).
class SimplexOperators
{
public:
  /// `surface` must be sound (requireSound). `boundary` is kept by reference. `creases` are edges of the surface to
  /// preserve. As with the curves between tissues, no operator removes or joins them or lets a face leave them, and
  /// points where they end, meet others or turn by more than 45 degrees are not merged into other points.
  SimplexOperators(const SurfaceComplex& surface, const TissueBoundary& boundary, OperatorLimits limits,
                   const std::vector<DualEdge>& creases = {});

  // --- operators; faces are given by the ids of their dual points
  /// T1: fuses faces a and b across the simplex edge between them.
  bool fuse(std::int32_t a, std::int32_t b);
  /// T2: cuts face a in two across its longer axis. On a curve between tissues, the new face has four vertices per
  /// tissue.
  bool cut(std::int32_t a);
  /// T2 on the edge between faces a and b: inserts a face of four vertices, or of four per tissue, at its midpoint. In
  /// the dual, edge ab is split.
  bool cutEdge(std::int32_t a, std::int32_t b);
  /// T7: replaces the edge between faces a and b by one between the faces at its two ends.
  bool swap(std::int32_t a, std::int32_t b);
  /// Moves dual point a to p. No triangle may turn by more than 60 degrees.
  bool move(std::int32_t a, const Vec3& p);

  // --- queries
  const std::vector<Vec3>& points() const { return m_Points; }
  bool alive(std::int32_t face) const { return !m_At[face].empty(); }
  std::size_t faceCount() const;
  std::vector<std::int32_t> faceNeighbours(std::int32_t a) const; ///< ascending
  double area(std::int32_t a) const;              ///< of face a, mm^2: a third of the area of the dual triangles at a
  Vec3 vertex(std::int32_t v) const;              ///< position of simplex vertex v
  std::size_t mostVertices(std::int32_t a) const; ///< largest number of vertices of face a, over the tissues
  /// Returns the ratio of the shortest simplex edge between faces a and b to its target length; infinity if there is
  /// none.
  double edgeRatio(std::int32_t a, std::int32_t b) const;
  /// Returns the faces at the two ends of the edge between faces a and b (to the left and to the right of dual edge ab)
  /// if the edge lies within one interface; otherwise { -1, -1 }.
  std::array<std::int32_t, 2> endsOf(std::int32_t a, std::int32_t b) const;
  /// Returns the distance of the centre of face a's vertices to the boundary of its tissues, mm: the largest over the
  /// interfaces that meet at a, or the reach if no boundary is nearer.
  double centreDistance(std::int32_t a) const;
  /// Returns 0 within an interface, 1 on a curve between three or more tissues or on a crease, 2 where such curves
  /// meet, end or turn.
  int junctionOrder(std::int32_t a) const;
  bool isOnCrease(std::int32_t a) const;
  std::vector<Label> tissuesAt(std::int32_t a) const;              ///< ascending
  std::vector<std::int32_t> curveNeighbours(std::int32_t a) const; ///< along curves and creases, ascending
  /// Returns the quality of the worst dual triangle at a, with a moved to p.
  double faceQuality(std::int32_t a, const Vec3& p) const;
  double edgeQuality(std::int32_t a, std::int32_t b) const; ///< of the worst dual triangle at edge ab
  /// Returns the quality of the worse of the two triangles that T7 would create.
  double qualityAfterSwap(std::int32_t a, std::int32_t b) const;
  /// Returns the merit of fusing faces a and b: higher the flatter, rounder and smaller the fused face would be.
  double fusion(std::int32_t a, std::int32_t b) const;
  double proximity(const Vec3& p) const { return m_Limits.proximity(p); }
  double targetLength(const Vec3& p) const { return m_Limits.edgeLength(p); }

  /// Returns the current dual triangles; `pointIds`, if given, receives the id of the face of each point.
  SurfaceComplex surface(std::vector<std::int32_t>* pointIds = nullptr) const;
  /// Returns the current creases, as point indices of surface().
  std::vector<DualEdge> creases() const;

private:
  using Corners = std::array<std::int32_t, 3>;
  struct Triangle
  {
    Corners corners{ -1, -1, -1 };
    std::array<Label, 2> labels{};
  };
  struct Fit ///< how well a triangle matches the boundary
  {
    double distance = 0; ///< relative to the proximity bound
    double cosine = 1;
  };

  struct Facet ///< a triangle before or after an operation
  {
    CornerTriangle shape;
    std::array<Label, 2> labels;
    Vec3 centroid;
    double radius; ///< of a sphere around the centroid that contains the triangle
  };
  struct Patch
  {
    std::vector<Facet> facets;
    double quality = 1; ///< of the worst
    Fit fit;            ///< worst distance and worst cosine
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
  /// Triangles at each point, ascending; empty if the point has been removed.
  std::vector<std::vector<std::int32_t>> m_At;
  std::vector<Triangle> m_Triangles; ///< corner -1: removed
  std::vector<Fit> m_Fits;
  /// Distance of each point to the boundary, mm, by labels; filled in on demand.
  std::vector<std::vector<std::pair<std::array<Label, 2>, double>>> m_Distances;
  std::vector<std::int32_t> m_Free;
  std::set<DualEdge> m_Creases; ///< the lower id first
  BoxGrid m_Grid;
};

} // namespace surgicalmesher
