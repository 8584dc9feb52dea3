// SPDX-License-Identifier: Apache-2.0
#include "SlabParameterisation.h"

#include "EdgeDivision.h"
#include "Errors.h"
#include "Parallel.h"
#include "SurfaceTetrahedralization.h"
#include "SurfaceValidity.h"
#include "TargetSurface.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>

namespace surgicalmesher
{
namespace
{

using Eigen::Vector3d;

constexpr double kNormalScale = 4; ///< distance (mm) that weighs as much as a difference of normals of 1

SurfaceComplex complexOf(const TriangleSurface& surface)
{
  SurfaceComplex complex;
  for (Eigen::Index i = 0; i < surface.points.cols(); ++i)
    complex.points.push_back({ surface.points(0, i), surface.points(1, i), surface.points(2, i) });
  complex.triangles.assign(surface.triangles.begin(), surface.triangles.end());
  return complex;
}

Points pointsOf(const std::vector<Vec3>& points)
{
  Points result(3, Eigen::Index(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i)
    result.col(Eigen::Index(i)) = Vector3d(points[i].x, points[i].y, points[i].z);
  return result;
}

/// Returns the envelope as one tissue, oriented outwards, with divided edges.
SurfaceComplex closedComplex(const TriangleSurface& surface, double edgeLength, const std::string& name)
{
  const SurfaceComplex closed = closedShellsToTissues(complexOf(surface), name);
  for (const auto& labels : closed.labels)
  {
    if (labels[0] != 1 || labels[1] != 0)
      throw InputError(name + ": more than one closed surface, expected one envelope");
  }
  return withDividedEdges(closed, [edgeLength](const Vec3&) { return edgeLength; });
}

/// Returns the tetrahedra inside the envelope; `ids` maps points of the surface to points of the result.
Tetrahedra insideOf(const TetMesh& filled, std::size_t surfacePoints, std::vector<std::int32_t>& ids)
{
  Tetrahedra inside;
  std::vector<std::int32_t> renumbered(filled.points.size(), -1);
  std::vector<Vec3> points;
  for (std::size_t t = 0; t < filled.tetrahedra.size(); ++t)
  {
    if (filled.labels[t] == 0) continue;
    inside.cells.push_back(filled.tetrahedra[t]);
    for (std::int32_t& id : inside.cells.back())
    {
      if (renumbered[id] < 0)
      {
        renumbered[id] = std::int32_t(points.size());
        points.push_back(filled.points[id]);
      }
      id = renumbered[id];
    }
  }
  inside.points = pointsOf(points);
  ids.assign(renumbered.begin(), renumbered.begin() + std::ptrdiff_t(surfacePoints));
  return inside;
}

/// Points of the tetrahedra that lie on a side.
std::vector<char> pointsOn(Side side, const FilledEnvelope& filled)
{
  const Envelope& envelope = filled.envelope;
  std::vector<char> on(std::size_t(filled.mesh.points.cols()), 0);
  for (std::size_t t = 0; t < envelope.sides.size(); ++t)
  {
    if (envelope.sides[t] != side) continue;
    for (const std::int32_t id : envelope.surface.triangles[t]) on[std::size_t(filled.ids[id])] = 1;
  }
  return on;
}

/// Boundary values: 0 on one side, 1 on another.
struct BetweenSides
{
  std::vector<char> known;
  Eigen::VectorXd values;
};

BetweenSides between(const std::vector<char>& zero, const std::vector<char>& one)
{
  BetweenSides result{ zero, Eigen::VectorXd::Zero(Eigen::Index(zero.size())) };
  for (std::size_t i = 0; i < zero.size(); ++i)
  {
    if (!one[i]) continue;
    result.known[i] = 1;
    result.values[Eigen::Index(i)] = 1;
  }
  return result;
}

Chart chartOf(Side side, const Envelope& envelope, const Eigen::Matrix2Xd& coordinates)
{
  std::vector<Triangle> triangles;
  for (std::size_t t = 0; t < envelope.sides.size(); ++t)
  {
    if (envelope.sides[t] == side) triangles.push_back(envelope.surface.triangles[t]);
  }
  Points lifted = Points::Zero(3, coordinates.cols());
  lifted.topRows<2>() = coordinates;
  return { compacted(envelope.surface.points, triangles), compacted(lifted, triangles).points.topRows<2>() };
}

Points middlesOf(const TriangleSurface& surface)
{
  Points middles(3, Eigen::Index(surface.triangles.size()));
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
  {
    const Triangle& n = surface.triangles[t];
    middles.col(Eigen::Index(t)) = (surface.points.col(n[0]) + surface.points.col(n[1]) + surface.points.col(n[2])) / 3;
  }
  return middles;
}

Points normalsOf(const TriangleSurface& surface)
{
  Points normals(3, Eigen::Index(surface.triangles.size()));
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
  {
    const Triangle& n = surface.triangles[t];
    const Vector3d a = surface.points.col(n[1]) - surface.points.col(n[0]),
                   b = surface.points.col(n[2]) - surface.points.col(n[0]);
    normals.col(Eigen::Index(t)) = a.cross(b).normalized();
  }
  return normals;
}

} // namespace

const char* nameOf(Side side)
{
  constexpr std::array<const char*, kSides> names = { "hole", "outer", "inner", "right", "left", "bottom", "top" };
  return names[std::size_t(side)];
}

Envelope withSides(const TriangleSurface& surface, const TriangleSurface& painted, const std::vector<Side>& sides,
                   const std::string& sidesFile)
{
  Envelope envelope{ surface, std::vector<Side>(surface.triangles.size()) };
  const Points middles = middlesOf(surface), normals = normalsOf(surface);
  TargetSurface lookup(painted);
  lookup.orientLike(middles, normals, 20);
  parallelFor(surface.triangles.size(),
              [&](std::size_t t)
              {
                const SurfacePoint closest =
                  lookup.closest(middles.col(Eigen::Index(t)), normals.col(Eigen::Index(t)), kNormalScale);
                envelope.sides[t] = sides[std::size_t(closest.triangle)];
              });
  for (int s = 1; s < kSides; ++s)
  {
    if (std::find(envelope.sides.begin(), envelope.sides.end(), Side(s)) == envelope.sides.end())
      throw InputError(sidesFile + ": no triangle of the envelope is on the side " + std::to_string(s) + " (" +
                       nameOf(Side(s)) + "), expected triangles on all of 1 to 6");
  }
  return envelope;
}

FilledEnvelope filledEnvelope(const Envelope& envelope, double edgeLength, const std::string& name)
{
  const SurfaceComplex complex = closedComplex(envelope.surface, edgeLength, name);
  const TriangleSurface divided{ pointsOf(complex.points), { complex.triangles.begin(), complex.triangles.end() } };
  FilledEnvelope result;
  result.envelope = withSides(divided, envelope.surface, envelope.sides, name);
  result.mesh = insideOf(fillWithTetrahedra(
                           complex, [edgeLength](const Vec3&) { return edgeLength; }, name),
                         complex.points.size(), result.ids);
  return result;
}

Eigen::VectorXd harmonicBetween(const FilledEnvelope& filled, Side zero, Side one)
{
  const BetweenSides problem = between(pointsOn(zero, filled), pointsOn(one, filled));
  return FieldSolver(filled.mesh, problem.known).harmonic(problem.values);
}

SlabParameterisation parameterise(const Envelope& envelope, double edgeLength, const std::string& name,
                                  const Progress& progress)
{
  report(progress, 0, "filling the envelope with tetrahedra");
  const FilledEnvelope filled = filledEnvelope(envelope, edgeLength, name);
  report(progress, 0.4, "harmonic field from bottom to top");
  const Eigen::VectorXd w = harmonicBetween(filled, Side::Bottom, Side::Top);
  report(progress, 0.7, "harmonic field from right to left");
  const BetweenSides leftwards = between(pointsOn(Side::Right, filled), pointsOn(Side::Left, filled));
  const FieldSolver solver(filled.mesh, leftwards.known);
  const Eigen::VectorXd first = solver.harmonic(leftwards.values);
  const Points gradient = orthogonalised(gradientOf(filled.mesh, first), gradientOf(filled.mesh, w));
  const Eigen::VectorXd u = solver.restored(gradient, leftwards.values);

  Eigen::Matrix2Xd coordinates(2, Eigen::Index(filled.ids.size()));
  for (std::size_t i = 0; i < filled.ids.size(); ++i)
    coordinates.col(Eigen::Index(i)) << u[filled.ids[i]], w[filled.ids[i]];
  report(progress, 1, "parameterised");
  return { chartOf(Side::Outer, filled.envelope, coordinates), chartOf(Side::Inner, filled.envelope, coordinates),
           filled.envelope };
}

} // namespace surgicalmesher
