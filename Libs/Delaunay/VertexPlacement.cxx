// SPDX-License-Identifier: Apache-2.0
#include "VertexPlacement.h"

#include "Parallel.h"
#include "SurfaceLocator.h"

#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStaticPointLocator.h>

#include <vnl/algo/vnl_lbfgs.h>
#include <vnl/vnl_cost_function.h>

#include <algorithm>
#include <cmath>

namespace surgicalmesher
{
namespace
{

constexpr double kReach = 1.5;    // range of the force, over l
constexpr double kSeen = 2.2;     // range of the pairs kept for a round, during which points move, over l
constexpr double kTooClose = 0.5; // over l: one of the two points is removed
constexpr std::size_t kFewNeighbours = 11;
constexpr double kRoomForOne = 0.75; // over L: no point may be within this distance of a new one
constexpr double kAtRest = 0.01;     // over L
constexpr int kRounds = 2;
constexpr int kEvaluations = 10;

double force(double s) { return s < kReach ? (1.25 * s - 2.375) * s * s + 1.125 : 0; }

/// Integral of the force from s to the end of its range.
double potential(double s)
{
  const auto integral = [](double u) { return ((0.3125 * u - 19.0 / 24) * u * u + 1.125) * u; };
  return s < kReach ? integral(kReach) - integral(s) : 0;
}

/// The points of a round: the fixed ones of the surface, then the placed ones.
struct Cloud
{
  std::vector<Vec3> points;
  std::vector<double> lengths;
  std::vector<char> moves;
};

using Neighbours = std::vector<std::vector<std::int32_t>>;

class PointSearch
{
public:
  explicit PointSearch(const std::vector<Vec3>& points)
  {
    vtkNew<vtkPoints> copies;
    copies->SetDataTypeToDouble();
    for (const Vec3& p : points) copies->InsertNextPoint(p.x, p.y, p.z);
    m_Data->SetPoints(copies);
    m_Locator->SetDataSet(m_Data);
    m_Locator->BuildLocator();
  }

  /// Returns point ids, ascending. Thread-safe.
  std::vector<std::int32_t> within(double radius, const Vec3& p) const
  {
    const double x[3] = { p.x, p.y, p.z };
    vtkNew<vtkIdList> ids;
    m_Locator->FindPointsWithinRadius(radius, x, ids);
    std::vector<std::int32_t> result(ids->begin(), ids->end());
    std::sort(result.begin(), result.end());
    return result;
  }

private:
  vtkNew<vtkPolyData> m_Data;
  vtkNew<vtkStaticPointLocator> m_Locator;
};

/// Returns, for the moving points, all points within `reach` times the mean of both target lengths.
Neighbours neighboursOf(const Cloud& cloud, const PointSearch& search, double reach)
{
  Neighbours neighbours(cloud.points.size());
  parallelFor(cloud.points.size(),
              [&](std::size_t i)
              {
                if (!cloud.moves[i]) return;
                const Vec3& p = cloud.points[i];
                for (const std::int32_t j : search.within(1.5 * reach * cloud.lengths[i], p))
                {
                  const double l = 0.5 * (cloud.lengths[i] + cloud.lengths[j]);
                  if (std::size_t(j) != i && norm(cloud.points[j] - p) < reach * l) neighbours[i].push_back(j);
                }
              });
  return neighbours;
}

/// F as a function of the moving points, for L-BFGS.
class Penalty : public vnl_cost_function
{
public:
  Penalty(const Cloud& cloud, const Neighbours& neighbours)
    : m_Cloud(cloud), m_Neighbours(neighbours), m_Points(cloud.points), m_Energies(cloud.points.size())
  {
    for (std::size_t i = 0; i < cloud.points.size(); ++i)
      if (cloud.moves[i]) m_Moving.push_back(std::int32_t(i));
    set_number_of_unknowns(int(3 * m_Moving.size()));
  }

  vnl_vector<double> start() const
  {
    vnl_vector<double> x(3 * m_Moving.size());
    for (std::size_t k = 0; k < m_Moving.size(); ++k)
      for (int axis = 0; axis < 3; ++axis) x[3 * k + axis] = m_Cloud.points[m_Moving[k]][axis];
    return x;
  }

  const std::vector<Vec3>& pointsAt(const vnl_vector<double>& x)
  {
    for (std::size_t k = 0; k < m_Moving.size(); ++k) m_Points[m_Moving[k]] = { x[3 * k], x[3 * k + 1], x[3 * k + 2] };
    return m_Points;
  }

  void compute(const vnl_vector<double>& x, double* value, vnl_vector<double>* gradient) override
  {
    pointsAt(x);
    parallelFor(m_Moving.size(),
                [&](std::size_t k)
                {
                  const Vec3 slope = slopeAt(m_Moving[k]);
                  for (int axis = 0; gradient && axis < 3; ++axis) (*gradient)[3 * k + axis] = slope[axis];
                });
    if (!value) return;
    *value = 0;
    for (const std::int32_t i : m_Moving) *value += m_Energies[i];
  }

private:
  Vec3 slopeAt(std::int32_t i)
  {
    Vec3 slope;
    m_Energies[i] = 0;
    for (const std::int32_t j : m_Neighbours[i])
    {
      const Vec3 apart = m_Points[i] - m_Points[j];
      const double r = norm(apart), l = 0.5 * (m_Cloud.lengths[i] + m_Cloud.lengths[j]);
      if (r >= kReach * l || !(r > 0)) continue;
      m_Energies[i] += (m_Cloud.moves[j] ? 0.5 : 1) * potential(r / l);
      slope -= force(r / l) / (l * r) * apart;
    }
    return slope;
  }

  const Cloud& m_Cloud;
  const Neighbours& m_Neighbours;
  std::vector<std::int32_t> m_Moving;
  std::vector<Vec3> m_Points;
  std::vector<double> m_Energies;
};

/// Whether a point has the fourteen neighbours of a regular lattice: the first shell at d, the second at 2 / sqrt(3) d.
bool isWhole(const Cloud& cloud, const std::vector<std::int32_t>& neighbours, std::size_t i)
{
  constexpr double second = 1.15470053837925153, slack = 0.04;
  std::vector<double> distances;
  for (const std::int32_t j : neighbours) distances.push_back(norm(cloud.points[j] - cloud.points[i]));
  std::sort(distances.begin(), distances.end());
  if (distances.size() < 15) return false;
  const double d = distances[3];
  for (int k = 0; k < 14; ++k)
    if (std::abs(distances[k] / d - (k < 8 ? 1 : second)) > slack) return false;
  return distances[14] > 1.4 * d;
}

class Placing
{
public:
  Placing(const SurfaceComplex& surface, const SizingFunction& edgeLength, double clearance)
    : m_Locator(surface), m_EdgeLength(edgeLength), m_Clearance(clearance), m_Fixed(surface.points.size())
  {
    m_Cloud.points = surface.points;
  }

  std::vector<Vec3> place(const std::vector<Vec3>& points, VertexPlacement placement)
  {
    m_Cloud.points.insert(m_Cloud.points.end(), points.begin(), points.end());
    m_Cloud.moves.assign(m_Cloud.points.size(), 0);
    parallelFor(points.size(), [&](std::size_t i) { m_Cloud.moves[m_Fixed + i] = m_Locator.ask(points[i]).inside; });
    measureLengths();
    if (placement == VertexPlacement::NotWhole) holdWhole();
    for (int round = 0; round < kRounds; ++round)
    {
      const double moved = minimise();
      const bool changed = removeCrowded() + insertMissing() > 0;
      if (moved < kAtRest && !changed) break;
    }
    return { m_Cloud.points.begin() + std::ptrdiff_t(m_Fixed), m_Cloud.points.end() };
  }

private:
  void measureLengths()
  {
    m_Cloud.lengths.resize(m_Cloud.points.size());
    parallelFor(m_Cloud.points.size(), [&](std::size_t i) { m_Cloud.lengths[i] = m_EdgeLength(m_Cloud.points[i]); });
  }

  void holdWhole()
  {
    const Neighbours neighbours = neighboursOf(m_Cloud, PointSearch(m_Cloud.points), kSeen);
    for (std::size_t i = m_Fixed; i < m_Cloud.points.size(); ++i)
      if (m_Cloud.moves[i] && isWhole(m_Cloud, neighbours[i], i)) m_Cloud.moves[i] = 0;
  }

  bool isClear(const Vec3& p) const
  {
    const SurfaceLocator::Answer answer = m_Locator.ask(p);
    return answer.inside && answer.distance >= m_Clearance * m_EdgeLength(p);
  }

  /// Returns the longest displacement, over L. Points that would come too near to the surface stay where they are.
  double minimise()
  {
    const Neighbours neighbours = neighboursOf(m_Cloud, PointSearch(m_Cloud.points), kSeen);
    Penalty penalty(m_Cloud, neighbours);
    if (penalty.get_number_of_unknowns() == 0) return 0;
    vnl_lbfgs optimiser(penalty);
    optimiser.set_max_function_evals(kEvaluations);
    optimiser.line_search_accuracy = 0.9;
    vnl_vector<double> x = penalty.start();
    optimiser.minimize(x);
    const std::vector<Vec3>& after = penalty.pointsAt(x);
    std::vector<double> moved(after.size(), 0);
    parallelFor(after.size(),
                [&](std::size_t i)
                {
                  if (!m_Cloud.moves[i] || !isClear(after[i])) return;
                  moved[i] = norm(after[i] - m_Cloud.points[i]) / m_Cloud.lengths[i];
                });
    for (std::size_t i = m_Fixed; i < after.size(); ++i)
      if (moved[i] > 0) m_Cloud.points[i] = after[i];
    measureLengths();
    return *std::max_element(moved.begin(), moved.end());
  }

  /// Of two points that are too close, removes the later one, if it moves.
  std::size_t removeCrowded()
  {
    const Neighbours neighbours = neighboursOf(m_Cloud, PointSearch(m_Cloud.points), kTooClose);
    std::vector<char> gone(m_Cloud.points.size(), 0);
    for (std::size_t i = m_Fixed; i < gone.size(); ++i)
      gone[i] = std::any_of(neighbours[i].begin(), neighbours[i].end(),
                            [&](std::int32_t j) { return !gone[j] && (!m_Cloud.moves[j] || std::size_t(j) < i); });
    std::size_t kept = 0;
    for (std::size_t i = 0; i < gone.size(); ++i)
    {
      if (gone[i]) continue;
      m_Cloud.points[kept] = m_Cloud.points[i];
      m_Cloud.moves[kept++] = m_Cloud.moves[i];
    }
    m_Cloud.points.resize(kept);
    m_Cloud.moves.resize(kept);
    measureLengths();
    return gone.size() - kept;
  }

  std::size_t insertMissing()
  {
    const PointSearch search(m_Cloud.points);
    const Neighbours neighbours = neighboursOf(m_Cloud, search, kReach);
    std::vector<Vec3> added;
    for (std::size_t i = m_Fixed; i < m_Cloud.points.size(); ++i)
    {
      if (!m_Cloud.moves[i] || neighbours[i].empty() || neighbours[i].size() >= kFewNeighbours) continue;
      const Vec3 p = emptiestPlaceAt(i, neighbours[i]);
      if (!isClear(p)) continue;
      const double room = kRoomForOne * m_EdgeLength(p);
      const auto isNear = [&](const Vec3& q) { return norm(q - p) < room; };
      if (search.within(room, p).empty() && std::none_of(added.begin(), added.end(), isNear)) added.push_back(p);
    }
    m_Cloud.points.insert(m_Cloud.points.end(), added.begin(), added.end());
    m_Cloud.moves.resize(m_Cloud.points.size(), 1);
    measureLengths();
    return added.size();
  }

  Vec3 emptiestPlaceAt(std::size_t i, const std::vector<std::int32_t>& neighbours) const
  {
    const Vec3& p = m_Cloud.points[i];
    Vec3 away;
    for (const std::int32_t j : neighbours) away += (p - m_Cloud.points[j]) / norm(p - m_Cloud.points[j]);
    const double n = norm(away);
    return n > 0 ? p + m_Cloud.lengths[i] / n * away : p;
  }

  const SurfaceLocator m_Locator;
  const SizingFunction& m_EdgeLength;
  const double m_Clearance;
  const std::size_t m_Fixed; ///< the surface's points
  Cloud m_Cloud;
};

} // namespace

std::vector<Vec3> placedPoints(const SurfaceComplex& surface, const std::vector<Vec3>& points,
                               const SizingFunction& edgeLength, VertexPlacement placement, double clearance)
{
  if (placement == VertexPlacement::Lattice) return points;
  return Placing(surface, edgeLength, clearance).place(points, placement);
}

double placementPenalty(const std::vector<Vec3>& points, const SizingFunction& edgeLength)
{
  Cloud cloud{ points, {}, std::vector<char>(points.size(), 1) };
  for (const Vec3& p : points) cloud.lengths.push_back(edgeLength(p));
  const Neighbours neighbours = neighboursOf(cloud, PointSearch(points), kReach);
  Penalty penalty(cloud, neighbours);
  return penalty.f(penalty.start());
}

} // namespace surgicalmesher
