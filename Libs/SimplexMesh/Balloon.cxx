// SPDX-License-Identifier: Apache-2.0
#include "Balloon.h"

#include "Errors.h"
#include "Parallel.h"
#include "SimplexDeformation.h"
#include "SurfaceShapes.h"

#include <limits>
#include <memory>

namespace surgicalmesher
{

namespace
{

constexpr double widthOfRigidity = 0.375; ///< width of the neighbourhood that resists bending, over the rigidity
constexpr double lengthOfRigidity = 0.3;  ///< shortest edges while a balloon grows, over the rigidity
/// Upper bound of that width, over the radius of a ball of the balloon's volume.
constexpr double widthOfRadius = 0.3;
constexpr double pressureInTheOpen = 3; ///< in units of the pressure near stopping tissues
/// Weight of the resistance to bending, as alpha in Delingette's law of motion.
constexpr double resistance = 0.5;
constexpr double leastFaces = 40;  ///< lower bound, for small balloons as well
constexpr int motionsPerRound = 3; ///< between uses of the operators
constexpr int lastMotions = 12;    ///< after the last use of the operators

SurfaceComplex seedSphere(const Vec3& centre, double radius, Label tissue)
{
  constexpr int levels = 2;
  return sphere(centre, radius, levels, tissue, 0);
}

/// Returns spheres with a radius of 1.5 voxels, or less where the space around the seed requires it.
SurfaceComplex startingSpheres(const std::vector<BalloonSeed>& seeds, const StoppingField& field)
{
  const double voxel = field.reach() / 2;
  SurfaceComplex all;
  for (const BalloonSeed& seed : seeds)
  {
    double radius = 1.5 * voxel;
    for (const BalloonSeed& other : seeds)
      if (&other != &seed) radius = std::min(radius, 0.4 * norm(other.centre - seed.centre));
    SurfaceComplex start = seedSphere(seed.centre, radius, seed.tissue);
    const auto hits = [&]
    { return std::any_of(start.points.begin(), start.points.end(), [&](const Vec3& p) { return field.stops(p); }); };
    while (radius > 0.2 * voxel && hits()) start = seedSphere(seed.centre, radius *= 0.7, seed.tissue);
    append(all, start);
  }
  return all;
}

std::vector<Label> tissuesOfPoints(const SurfaceComplex& surface)
{
  std::vector<Label> tissues(surface.points.size());
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    for (const std::int32_t p : surface.triangles[t]) tissues[p] = surface.labels[t][0];
  return tissues;
}

/// Returns for each point whether a point of another tissue is within `reach` mm.
std::vector<char> meetsAnother(const SurfaceComplex& surface, const std::vector<Label>& tissues, double reach)
{
  BoxGrid grid(reach);
  for (std::size_t p = 0; p < tissues.size(); ++p) grid.insert(std::int32_t(p), Box::around(surface.points[p]));
  std::vector<char> meets(tissues.size(), false);
  for (std::size_t p = 0; p < tissues.size(); ++p)
    grid.visit(Box::around(surface.points[p], reach),
               [&](std::int32_t q)
               {
                 meets[p] = tissues[q] != tissues[p] && norm(surface.points[q] - surface.points[p]) < reach;
                 return !meets[p];
               });
  return meets;
}

class Growth
{
public:
  Growth(const std::vector<BalloonSeed>& seeds, const StoppingField& field, const BalloonOptions& options,
         const BalloonWatch& watch)
    : m_Field(field), m_Options(options), m_Watch(watch),
      m_Pressure(options.pressure > 0 ? options.pressure : 0.075 * field.reach()), m_None(SurfaceComplex{}, 1e-6)
  {
    for (const BalloonSeed& seed : seeds) m_Centres[seed.tissue] = seed.centre;
    m_Motion.internalForce.continuity = Continuity::C0; // tangential only; bending has a width of its own
    m_Motion.least = 1e-3 * field.reach();
    begin(startingSpheres(seeds, field));
  }

  /// Iterates until the volume is at rest (returns true) or the motions run out (returns false). The target edge length
  /// is L(x); while the balloon grows, it is not below the length that the rigidity requires.
  bool run(bool grows, const Progress& progress)
  {
    m_ShortestEdge = grows && m_Options.continuity != Continuity::C0 ? lengthOfRigidity * m_Options.rigidity : 0;
    std::vector<double> volumes;
    while (m_Motions + motionsPerRound + lastMotions <= m_Options.mostMotions)
    {
      report(progress, double(m_Motions) / m_Options.mostMotions, "balloon");
      round();
      volumes.push_back(m_Steps.back().volume);
      constexpr std::size_t span = 7; // rounds to look back
      if (volumes.size() <= span) continue;
      const double way = (volumes.back() - volumes[volumes.size() - 1 - span]) / m_Steps.back().area;
      if (std::abs(way) < 0.01 * m_Field.reach()) return true;
    }
    return false;
  }

  /// Performs the last motions, without operators.
  void settle()
  {
    SimplexMotion motion(m_Motion);
    for (int n = 0; n < lastMotions; ++n) move(motion);
    measure({});
  }

  BalloonResult result(bool isAtRest) const
  {
    BalloonResult result{ m_Mesh->surface(), m_Steps, {}, isAtRest };
    countHalts(result);
    return result;
  }

private:
  double length(const Vec3& p) const { return std::max(m_ShortestEdge, m_Options.edgeLength(p)); }

  void begin(const SurfaceComplex& surface)
  {
    m_Sizes = balloonSizes(surface);
    double area = 0;
    for (const auto& [label, size] : m_Sizes) area += size.area;
    m_EdgeAtBegin = std::sqrt(area / double(surface.triangles.size()));
    OperatorLimits limits;
    limits.edgeLength = [this](const Vec3& p) { return length(p); };
    limits.proximity = [](const Vec3&) { return 1.; };
    m_Mesh = std::make_unique<SimplexOperators>(surface, m_None, limits);
  }

  /// Returns A_s(x), or less if the balloon would have too few faces.
  double targetArea(const Vec3& p) const
  {
    double area = std::sqrt(3.) / 2 * length(p) * length(p);
    for (const auto& [label, size] : m_Sizes) area = std::min(area, size.area / leastFaces);
    return area;
  }

  void round()
  {
    const AreaCounts counts = adaptAreas(
      *m_Mesh, [this](const Vec3& p) { return targetArea(p); }, m_Options.areaTolerance);
    const double edge = std::sqrt(m_Steps.empty() ? m_EdgeAtBegin * m_EdgeAtBegin
                                                  : m_Steps.back().area / double(m_Steps.back().vertices));
    if (edge > 1.6 * m_EdgeAtBegin || edge < 0.6 * m_EdgeAtBegin) begin(m_Mesh->surface());
    SimplexMotion motion(m_Motion);
    for (int n = 0; n < motionsPerRound; ++n) move(motion);
    measure(counts);
  }

  void move(SimplexMotion& motion)
  {
    const std::vector<Vec3> before = m_Mesh->points();
    motion.step(*m_Mesh, [this](const SurfaceComplex& dual) { return forces(dual); });
    double sum = 0;
    for (std::size_t p = 0; p < before.size(); ++p) sum += norm(m_Mesh->points()[p] - before[p]);
    m_MeanMove = sum / double(m_Mesh->faceCount());
    ++m_Motions;
    if (m_Watch) m_Watch(m_Motions, *m_Mesh);
  }

  double wayToLimit(const Vec3& p, const Vec3& n, Label tissue) const
  {
    if (m_Options.limit == 0) return std::numeric_limits<double>::infinity();
    const Vec3 v = p - m_Centres.at(tissue);
    const double b = dot(v, n), beyond = squaredNorm(v) - m_Options.limit * m_Options.limit;
    return beyond > 0 ? m_Options.limit - norm(v) : std::sqrt(b * b - beyond) - b;
  }

  std::vector<Vec3> forces(const SurfaceComplex& dual)
  {
    m_Sizes = balloonSizes(dual);
    const std::vector<Label> tissues = tissuesOfPoints(dual);
    std::vector<double> widths;
    for (const Label tissue : tissues)
      widths.push_back(std::min(widthOfRigidity * m_Options.rigidity, widthOfRadius * m_Sizes.at(tissue).radius()));
    std::vector<Vec3> force = bendingForces(dual, m_Options.continuity, widths);
    const std::vector<Vec3> blown = meansAround(dual, balloonForces(dual));
    for (std::size_t p = 0; p < force.size(); ++p) force[p] = resistance * force[p] + blown[p];
    return force;
  }

  /// Returns the force by triangle, from three quadrature points of second order as in imageForces(), which preserves
  /// the volume.
  std::vector<Vec3> balloonForces(const SurfaceComplex& dual) const
  {
    std::vector<Vec3> force(dual.triangles.size());
    parallelFor(force.size(),
                [&](std::size_t t)
                {
                  const auto& [a, b, c] = dual.triangles[t];
                  const std::array<Vec3, 3> corners{ dual.points[a], dual.points[b], dual.points[c] };
                  const Vec3 sum = corners[0] + corners[1] + corners[2];
                  Vec3 n = cross(corners[1] - corners[0], corners[2] - corners[0]);
                  n = n / std::max(1e-300, norm(n));
                  double way = 0;
                  for (const Vec3& corner : corners) way += pressureAt(sum / 6 + corner / 2, n, dual.labels[t][0]) / 3;
                  force[t] = way * n;
                });
    return force;
  }

  double pressureAt(const Vec3& x, const Vec3& n, Label tissue) const
  {
    double way = std::min(m_Field.wayToEnd(x, n), wayToLimit(x, n, tissue));
    const double toTissue = m_Field.wayToTissue(x, n);
    if (toTissue < m_Field.reach()) return std::clamp(0.5 * std::min(way, toTissue), -m_Pressure, m_Pressure);
    return way > 0 ? std::min(0.5 * way, m_Pressure * room(x, n, tissue)) : std::max(0.5 * way, -m_Pressure);
  }

  /// Returns a factor on the pressure. It is 1 where a ball as wide as the rigidity fits a voxel behind the membrane
  /// and drops to 0 where it does not, as in an opening or a recess; it is 1 for balloons smaller than that ball. In
  /// the open, where no tissue is near that the membrane could pass by, it rises to pressureInTheOpen.
  double room(const Vec3& x, const Vec3& n, Label tissue) const
  {
    const double voxel = m_Field.reach() / 2, radius = 0.5 * m_Options.rigidity;
    if (m_Options.continuity == Continuity::C0 || m_Sizes.at(tissue).radius() < radius + voxel) return 1;
    const double behind = (m_Field.clearance(x - (radius + voxel) * n) - radius) / voxel + 1;
    const double here = (m_Field.clearance(x) - radius) / voxel;
    return std::clamp(behind, 0., 1.) * (1 + (pressureInTheOpen - 1) * std::clamp(here, 0., 1.));
  }

  void measure(const AreaCounts& counts)
  {
    const SurfaceComplex surface = m_Mesh->surface();
    BalloonStep step;
    step.motion = m_Motions;
    step.faces = surface.points.size();
    step.vertices = surface.triangles.size();
    for (const auto& [label, size] : balloonSizes(surface))
    {
      step.volume += size.volume;
      step.area += size.area;
    }
    step.meanMove = m_MeanMove;
    step.withinTolerance = shareWithinTolerance(
      *m_Mesh, [this](const Vec3& p) { return targetArea(p); }, m_Options.areaTolerance);
    step.operations = counts;
    m_Steps.push_back(step);
  }

  void countHalts(BalloonResult& result) const
  {
    const SurfaceComplex& surface = result.surface;
    const std::vector<Label> tissues = tissuesOfPoints(surface);
    const std::vector<Vec3> normals = pointNormals(surface);
    const double voxel = m_Field.reach() / 2;
    const double edge = std::sqrt(m_Steps.back().area / double(m_Steps.back().vertices));
    const std::vector<char> meets = meetsAnother(surface, tissues, std::max(voxel, edge));
    for (std::size_t p = 0; p < tissues.size(); ++p)
    {
      BalloonHalt& halt = result.halts[tissues[p]];
      const Vec3 &x = surface.points[p], &n = normals[p];
      if (m_Field.wayToTissue(x, n) < voxel) ++halt.tissue;
      else if (wayToLimit(x, n, tissues[p]) < voxel) ++halt.limit;
      else if (m_Field.wayToEnd(x, n) < voxel) ++halt.end;
      else if (meets[p]) ++halt.neighbour;
      else ++halt.rigidity;
    }
  }

  const StoppingField& m_Field;
  const BalloonOptions& m_Options;
  const BalloonWatch& m_Watch;
  double m_Pressure;
  TissueBoundary m_None; ///< empty: no boundary attracts a balloon
  MotionOptions m_Motion;
  std::map<Label, Vec3> m_Centres;
  std::map<Label, BalloonSize> m_Sizes;
  std::unique_ptr<SimplexOperators> m_Mesh;
  double m_ShortestEdge = 0, m_EdgeAtBegin = 0, m_MeanMove = 0;
  int m_Motions = 0;
  std::vector<BalloonStep> m_Steps;
};

void requirePlaces(const std::vector<BalloonSeed>& seeds, const StoppingField& field)
{
  const double voxel = field.reach() / 2;
  for (std::size_t n = 0; n < seeds.size(); ++n)
    if (field.stops(seeds[n].centre))
      throw InputError("seed " + std::to_string(n + 1) +
                       " is in a stopping tissue, within half a voxel of it on most " +
                       "sides, or outside the map, expected a free place");
  for (std::size_t n = 0; n < seeds.size(); ++n)
    for (std::size_t m = 0; m < n; ++m)
      if (norm(seeds[n].centre - seeds[m].centre) < voxel)
        throw InputError("seeds " + std::to_string(m + 1) + " and " + std::to_string(n + 1) +
                         " are within a voxel of each other, expected them farther apart");
}

} // namespace

double BalloonSize::radius() const { return std::cbrt(std::max(0., volume) * 3 / (4 * std::acos(-1.))); }

std::map<Label, BalloonSize> balloonSizes(const SurfaceComplex& surface)
{
  std::map<Label, BalloonSize> sizes;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
  {
    const auto& [a, b, c] = surface.triangles[t];
    const Vec3 &p = surface.points[a], &q = surface.points[b], &r = surface.points[c];
    for (int side = 0; side < 2; ++side)
    {
      if (surface.labels[t][side] == 0) continue;
      BalloonSize& size = sizes[surface.labels[t][side]];
      size.volume += (side == 0 ? 1 : -1) * dot(p, cross(q, r)) / 6;
      size.area += norm(cross(q - p, r - p)) / 2;
    }
  }
  return sizes;
}

BalloonResult growBalloons(const std::vector<BalloonSeed>& seeds, const StoppingField& field,
                           const BalloonOptions& options, const Progress& progress, const BalloonWatch& watch)
{
  requirePlaces(seeds, field);
  Growth growth(seeds, field, options, watch);
  bool isAtRest = growth.run(true, subProgress(progress, 0, 0.6));
  isAtRest = growth.run(false, subProgress(progress, 0.6, 0.9)) && isAtRest;
  growth.settle();
  report(progress, 1, "balloon");
  return growth.result(isAtRest);
}

} // namespace surgicalmesher
