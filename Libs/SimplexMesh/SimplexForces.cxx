// SPDX-License-Identifier: Apache-2.0
#include "SimplexForces.h"

#include "Parallel.h"
#include "SimplexGeometry.h"

namespace surgicalmesher
{

namespace
{

/// The quantities that C2 averages over the neighbourhood, per vertex and side.
struct Bend
{
  double curvature = 0;
  double cosine = 1; ///< of the simplex angle; negative on the branch beyond 90 degrees
};

using Bends = std::vector<std::array<Bend, 2>>;

bool hasNeighbours(const SimplexMesh& mesh, std::size_t v, int side) { return mesh.neighbours[v][side][0] >= 0; }

/// Returns the neighbours counter-clockwise as seen from outside the tissue of that side.
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

/// Extends the neighbourhood by one ring: averages each vertex with its neighbours.
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

/// Diffusion along the edges of a surface that spreads the value of a point over a given width, whatever the edge
/// lengths.
class Diffusion
{
public:
  Diffusion(const SurfaceComplex& surface, const std::vector<double>& widths) : m_First(surface.points.size() + 1, 0)
  {
    std::vector<std::array<std::int32_t, 2>> pairs;
    for (const auto& [a, b, c] : surface.triangles)
      for (const std::array<std::int32_t, 2>& pair : { std::array{ a, b }, std::array{ b, c }, std::array{ c, a } })
        pairs.push_back(pair); // the opposite direction comes with the other triangle
    std::sort(pairs.begin(), pairs.end());
    for (const auto& [a, b] : pairs)
    {
      ++m_First[a + 1];
      m_Neighbours.push_back(b);
    }
    for (std::size_t p = 1; p < m_First.size(); ++p) m_First[p] += m_First[p - 1];
    setRates(surface, widths);
  }

  template <class T>
  std::vector<T> applied(std::vector<T> x) const
  {
    std::vector<T> next = x;
    for (int sweep = 0; sweep < m_Sweeps; ++sweep)
    {
      parallelFor(x.size(),
                  [&](std::size_t p)
                  {
                    T sum{};
                    for (std::size_t n = m_First[p]; n < m_First[p + 1]; ++n) sum += x[m_Neighbours[n]];
                    const double count = double(std::max<std::size_t>(1, m_First[p + 1] - m_First[p]));
                    next[p] = x[p] + m_Rates[p] * (sum / count - x[p]);
                  });
      x.swap(next);
    }
    return x;
  }

private:
  /// The mean over neighbours at distance L minus the centre is L^2/4 times the Laplacian; diffusion over a time t
  /// spreads to sqrt(2 t).
  void setRates(const SurfaceComplex& surface, const std::vector<double>& widths)
  {
    constexpr double fastest = 0.7;
    constexpr int mostSweeps = 200;
    m_Rates.assign(surface.points.size(), 0);
    double largest = 0;
    for (std::size_t p = 0; p < m_Rates.size(); ++p)
    {
      double squared = 0;
      for (std::size_t n = m_First[p]; n < m_First[p + 1]; ++n)
        squared += squaredNorm(surface.points[m_Neighbours[n]] - surface.points[p]);
      if (squared > 0) m_Rates[p] = 2 * widths[p] * widths[p] * double(m_First[p + 1] - m_First[p]) / squared;
      largest = std::max(largest, m_Rates[p]);
    }
    m_Sweeps = std::clamp(int(std::ceil(largest / fastest)), 1, mostSweeps);
    for (double& rate : m_Rates) rate = std::min(fastest, rate / m_Sweeps);
  }

  std::vector<std::size_t> m_First;
  std::vector<std::int32_t> m_Neighbours;
  std::vector<double> m_Rates;
  int m_Sweeps = 1;
};

} // namespace

std::vector<Vec3> meansAround(const SurfaceComplex& dual, const std::vector<Vec3>& perVertex)
{
  std::vector<Vec3> sum(dual.points.size());
  std::vector<double> count(dual.points.size(), 0);
  for (std::size_t t = 0; t < perVertex.size(); ++t)
    for (std::int32_t p : dual.triangles[t])
    {
      sum[p] += perVertex[t];
      ++count[p];
    }
  for (std::size_t p = 0; p < sum.size(); ++p) sum[p] = sum[p] / std::max(1., count[p]);
  return sum;
}

std::vector<Vec3> pointNormals(const SurfaceComplex& surface)
{
  std::vector<Vec3> normals(surface.points.size());
  for (const auto& [a, b, c] : surface.triangles)
  {
    const Vec3 n = cross(surface.points[b] - surface.points[a], surface.points[c] - surface.points[a]);
    for (const std::int32_t p : { a, b, c }) normals[p] += n;
  }
  for (Vec3& n : normals) n = n / std::max(1e-300, norm(n));
  return normals;
}

std::vector<Vec3> bendingForces(const SurfaceComplex& dual, Continuity continuity, const std::vector<double>& widths)
{
  std::vector<Vec3> forces(dual.points.size());
  if (continuity == Continuity::C0) return forces;
  const Diffusion diffusion(dual, widths);
  const std::vector<Vec3> normals = pointNormals(dual), mean = diffusion.applied(dual.points);
  std::vector<double> bend(dual.points.size());
  for (std::size_t p = 0; p < bend.size(); ++p) bend[p] = dot(normals[p], dual.points[p] - mean[p]);
  const std::vector<double> common =
    continuity == Continuity::C2 ? diffusion.applied(bend) : std::vector<double>(bend.size(), 0);
  for (std::size_t p = 0; p < bend.size(); ++p) forces[p] = (common[p] - bend[p]) * normals[p];
  return forces;
}

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
