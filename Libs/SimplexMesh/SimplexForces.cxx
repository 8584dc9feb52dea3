// SPDX-License-Identifier: Apache-2.0
#include "SimplexForces.h"

#include "Parallel.h"
#include "SimplexGeometry.h"

namespace surgicalmesher
{

namespace
{

/// What C2 takes the mean of, per vertex and side.
struct Bend
{
  double curvature = 0;
  double cosine = 1; ///< of the simplex angle: below 0 on the branch beyond 90 degrees
};

using Bends = std::vector<std::array<Bend, 2>>;

bool hasNeighbours(const SimplexMesh& mesh, std::size_t v, int side) { return mesh.neighbours[v][side][0] >= 0; }

/// Counter-clockwise as seen from outside the tissue of that side.
SimplexNeighbours neighboursOf(const SimplexMesh& mesh, std::size_t v, int side)
{
  const auto& n = mesh.neighbours[v][side];
  return { mesh.points[n[0]], mesh.points[n[side == 0 ? 1 : 2]], mesh.points[n[side == 0 ? 2 : 1]] };
}

template <class Action>
void forVertices(const SimplexMesh& mesh, const Action& action)
{
  parallelFor(mesh.points.size(),
              [&](vtkIdType v)
              {
                for (int side = 0; side < 2; ++side)
                  if (hasNeighbours(mesh, v, side)) action(std::size_t(v), side);
              });
}

Bends bendsOf(const SimplexMesh& mesh)
{
  Bends bends(mesh.points.size());
  forVertices(mesh,
              [&](std::size_t v, int side)
              {
                const SimplexShape shape = simplexShape(mesh.points[v], neighboursOf(mesh, v, side));
                bends[v][side] = { shape.meanCurvature(), std::cos(shape.angle) };
              });
  return bends;
}

/// One ring more: each vertex takes the mean of itself and its neighbours.
Bends averaged(const SimplexMesh& mesh, const Bends& bends)
{
  Bends means = bends;
  forVertices(mesh,
              [&](std::size_t v, int side)
              {
                Bend& mean = means[v][side];
                for (std::int32_t n : mesh.neighbours[v][side])
                {
                  const Bend& other = bends[n][mesh.labels[n][0] == mesh.labels[v][side] ? 0 : 1];
                  mean.curvature += other.curvature;
                  mean.cosine += other.cosine;
                }
                mean.curvature /= 4;
                mean.cosine /= 4;
              });
  return means;
}

Vec3 referencePosition(const SimplexMesh& mesh, std::size_t v, int side, const Bend& mean,
                       const InternalForceOptions& options)
{
  const Vec3& p = mesh.points[v];
  const SimplexNeighbours neighbours = neighboursOf(mesh, v, side);
  std::array<double, 3> metric = options.metric;
  if (side == 1) std::swap(metric[1], metric[2]);
  const SimplexShape shape = simplexShape(p, neighbours);
  double angle = 0;
  if (options.continuity == Continuity::C0) angle = shape.angle;
  if (options.continuity == Continuity::C2)
    angle = angleOfCurvature(mean.curvature, shape.circle.radius, mean.cosine < 0);
  return simplexPosition(neighbours, metric, angle);
}

} // namespace

std::vector<std::array<double, 2>> meanCurvatures(const SimplexMesh& mesh)
{
  const Bends bends = bendsOf(mesh);
  std::vector<std::array<double, 2>> curvatures;
  for (const auto& [back, front] : bends) curvatures.push_back({ back.curvature, front.curvature });
  return curvatures;
}

std::vector<Vec3> internalForces(const SimplexMesh& mesh, const InternalForceOptions& options)
{
  Bends means(mesh.points.size());
  if (options.continuity == Continuity::C2)
  {
    means = bendsOf(mesh);
    for (int ring = 0; ring < options.rigidity; ++ring) means = averaged(mesh, means);
  }
  std::vector<std::array<Vec3, 2>> forces(mesh.points.size());
  forVertices(mesh, [&](std::size_t v, int side)
              { forces[v][side] = referencePosition(mesh, v, side, means[v][side], options) - mesh.points[v]; });
  std::vector<Vec3> result;
  for (std::size_t v = 0; v < forces.size(); ++v)
  {
    const int sides = hasNeighbours(mesh, v, 0) + hasNeighbours(mesh, v, 1);
    result.push_back((forces[v][0] + forces[v][1]) / std::max(1, sides));
  }
  return result;
}

std::vector<Vec3> imageForces(const SurfaceComplex& dual, const TissueBoundary& boundary,
                              std::vector<double>* distances)
{
  std::vector<Vec3> forces(dual.triangles.size());
  std::vector<double> farthest(dual.triangles.size(), 0);
  parallelFor(forces.size(),
              [&](vtkIdType t)
              {
                const auto& [a, b, c] = dual.triangles[t];
                const std::array<Vec3, 3> corners{ dual.points[a], dual.points[b], dual.points[c] };
                const Vec3 sum = corners[0] + corners[1] + corners[2],
                           n = cross(corners[1] - corners[0], corners[2] - corners[0]);
                double way = 0;
                for (const Vec3& corner : corners)
                {
                  const Vec3 sample = sum / 6 + corner / 2;
                  const auto nearest = boundary.nearest(sample, dual.labels[t]);
                  farthest[t] = std::max(farthest[t], nearest ? nearest->distance : boundary.reach());
                  if (nearest) way += dot(nearest->position - sample, n) / 3;
                }
                if (squaredNorm(n) > 0) forces[t] = way / squaredNorm(n) * n;
              });
  if (distances) *distances = std::move(farthest);
  return forces;
}

} // namespace surgicalmesher
