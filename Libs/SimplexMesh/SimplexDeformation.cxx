// SPDX-License-Identifier: Apache-2.0
#include "SimplexDeformation.h"

#include <queue>
#include <sstream>

namespace surgicalmesher
{

namespace
{

/// A simplex edge, given by the two faces beside it; ordered so that a priority queue yields the shortest first.
struct ShortEdge
{
  double ratio;
  std::int32_t a, b;
  bool operator<(const ShortEdge& e) const
  { // std::priority_queue yields the greatest
    return ratio != e.ratio ? ratio > e.ratio : a != e.a ? a > e.a : b > e.b;
  }
};

using ShortEdges = std::priority_queue<ShortEdge>;

void addShortEdges(const SimplexOperators& mesh, std::int32_t a, double threshold, ShortEdges& heap)
{
  for (std::int32_t b : mesh.faceNeighbours(a))
  {
    const double ratio = mesh.edgeRatio(a, b);
    if (ratio < threshold) heap.push({ ratio, std::min(a, b), std::max(a, b) });
  }
}

/// Fuses the pair of faces with the highest merit: the two beside the edge, or the two beside one of the four edges at
/// its ends. Returns the fused face, or -1.
std::int32_t fuseBest(SimplexOperators& mesh, std::int32_t a, std::int32_t b)
{
  struct Choice
  {
    double merit;
    std::int32_t a, b;
  };
  std::vector<Choice> choices{ { mesh.fusion(a, b), a, b } };
  for (std::int32_t end : mesh.endsOf(a, b))
    if (end >= 0)
      for (std::int32_t face : { a, b }) choices.push_back({ mesh.fusion(face, end), face, end });
  std::stable_sort(choices.begin(), choices.end(), [](const Choice& x, const Choice& y) { return x.merit > y.merit; });
  for (const Choice& c : choices)
    if (c.merit > 0 && mesh.fuse(c.a, c.b)) return c.a;
  return -1;
}

/// Applies T1, the relatively shortest edge first.
int fuseShortEdges(SimplexOperators& mesh, const AdaptationOptions& options)
{
  const double threshold = options.shortEdge;
  const int most = int(std::ceil(options.mostFusions * double(mesh.faceCount())));
  ShortEdges heap;
  for (std::size_t a = 0; a < mesh.points().size(); ++a) addShortEdges(mesh, std::int32_t(a), threshold, heap);
  int count = 0;
  while (!heap.empty() && count < most)
  {
    const ShortEdge edge = heap.top();
    heap.pop();
    if (!mesh.alive(edge.a) || !mesh.alive(edge.b) || mesh.edgeRatio(edge.a, edge.b) != edge.ratio) continue;
    const std::int32_t fused = fuseBest(mesh, edge.a, edge.b);
    if (fused < 0) continue;
    ++count;
    addShortEdges(mesh, fused, threshold, heap);
    for (std::int32_t b : mesh.faceNeighbours(fused)) addShortEdges(mesh, b, threshold, heap);
  }
  return count;
}

/// Applies T2 to faces whose centre is too far from the boundary, that have too many vertices or too long an edge.
int cutFaces(SimplexOperators& mesh, const AdaptationOptions& options)
{
  struct Need
  {
    double urgency;
    std::int32_t face;
  };
  std::vector<Need> needs;
  for (std::int32_t a = 0; a < std::int32_t(mesh.points().size()); ++a)
  {
    if (!mesh.alive(a)) continue;
    double urgency = mesh.centreDistance(a) / mesh.proximity(mesh.points()[a]);
    for (std::int32_t b : mesh.faceNeighbours(a))
      if (const double ratio = mesh.edgeRatio(a, b); std::isfinite(ratio))
        urgency = std::max(urgency, ratio / options.longEdge);
    if (mesh.mostVertices(a) > options.mostVertices) urgency = std::max(urgency, 1.01);
    if (urgency > 1) needs.push_back({ urgency, a });
  }
  std::stable_sort(needs.begin(), needs.end(), [](const Need& x, const Need& y) { return x.urgency > y.urgency; });
  return int(std::count_if(needs.begin(), needs.end(), [&](const Need& need) { return mesh.cut(need.face); }));
}

void measure(const SimplexOperators& mesh, SimplexStep& step)
{
  step.vertices = mesh.surface().triangles.size();
  step.faces = mesh.faceCount();
  for (std::int32_t a = 0; a < std::int32_t(mesh.points().size()); ++a)
  {
    if (!mesh.alive(a)) continue;
    const double distance = mesh.centreDistance(a);
    step.meanDistance += distance / double(step.faces);
    step.maximumDistance = std::max(step.maximumDistance, distance);
  }
}

/// Returns displacements against roughness of the dual points that the centroids of their triangles do not show, such
/// as points alternately above, below and on the surface, and that no force on vertices detects. Each is the
/// displacement to the mean of the vertices minus what the neighbourhood has in common, which is curvature. Zero where
/// tissues meet.
std::vector<Vec3> hiddenRoughness(const SurfaceComplex& dual)
{
  const auto centroids = [&](const std::vector<Vec3>& x)
  {
    std::vector<Vec3> c;
    for (const auto& [p, q, r] : dual.triangles) c.push_back((x[p] + x[q] + x[r]) / 3);
    return c;
  };
  std::vector<bool> inside(dual.points.size(), true);
  std::vector<std::int32_t> sheet(dual.points.size(), -1);
  for (std::size_t t = 0; t < dual.triangles.size(); ++t)
    for (std::int32_t p : dual.triangles[t])
    {
      if (sheet[p] < 0) sheet[p] = std::int32_t(t);
      if (dual.labels[sheet[p]] != dual.labels[t]) inside[p] = false;
    }
  std::vector<Vec3> away = meansAround(dual, centroids(dual.points));
  for (std::size_t p = 0; p < away.size(); ++p) away[p] = inside[p] ? away[p] - dual.points[p] : Vec3{};
  const std::vector<Vec3> common = meansAround(dual, centroids(away));
  for (std::size_t p = 0; p < away.size(); ++p) away[p] = inside[p] ? away[p] - common[p] : Vec3{};
  return away;
}

/// Returns the neighbours of each point, each once per triangle.
std::vector<std::vector<std::int32_t>> pointNeighbours(const SurfaceComplex& surface)
{
  std::vector<std::vector<std::int32_t>> neighbours(surface.points.size());
  for (const auto& t : surface.triangles)
    for (int k = 0; k < 3; ++k)
      for (const std::int32_t n : { t[(k + 1) % 3], t[(k + 2) % 3] }) neighbours[t[k]].push_back(n);
  return neighbours;
}

double shortestEdge(const SurfaceComplex& surface, std::int32_t p, const std::vector<std::int32_t>& neighbours)
{
  double least = 1e300;
  for (const std::int32_t n : neighbours) least = std::min(least, norm(surface.points[n] - surface.points[p]));
  return least;
}

} // namespace

int swapEdges(SimplexOperators& mesh)
{
  const auto excess = [&](std::int32_t face, int change)
  {
    const double n = double(mesh.mostVertices(face)) + change - 6;
    return n * n;
  };
  int count = 0;
  for (std::int32_t a = 0; a < std::int32_t(mesh.points().size()); ++a)
    for (std::int32_t b : mesh.faceNeighbours(a))
    {
      const auto [c, d] = mesh.endsOf(a, b);
      if (b < a || c < 0) continue;
      const double before = mesh.edgeQuality(a, b);
      const double gain = excess(a, 0) + excess(b, 0) + excess(c, 0) + excess(d, 0) - excess(a, -1) - excess(b, -1) -
                          excess(c, 1) - excess(d, 1);
      const double after = mesh.qualityAfterSwap(a, b);
      if (after > 1.1 * before || (gain > 0 && after > 0.85 * before && after > 0.5)) count += mesh.swap(a, b);
    }
  return count;
}

double SimplexMotion::step(SimplexOperators& mesh, const TissueBoundary& boundary)
{
  return step(mesh,
              [&](const SurfaceComplex& dual)
              {
                std::vector<Vec3> force = imageForces(dual, boundary);
                for (Vec3& f : force) f = m_Options.image * f;
                return meansAround(dual, force);
              });
}

double SimplexMotion::step(SimplexOperators& mesh, const OuterForces& outerForces)
{
  MovingDual dual;
  dual.surface = mesh.surface(&dual.ids);
  dual.simplex = simplexMeshOf(dual.surface);
  dual.move = [&](std::int32_t id, const Vec3& p) { return mesh.move(id, p); };
  m_Last.resize(mesh.points().size());
  return step(dual, outerForces(dual.surface));
}

double SimplexMotion::step(MovingDual& dual, const std::vector<Vec3>& outer)
{
  SurfaceComplex& surface = dual.surface;
  for (std::size_t v = 0; v < surface.triangles.size(); ++v)
  {
    const auto& [a, b, c] = surface.triangles[v];
    dual.simplex.points[v] = (surface.points[a] + surface.points[b] + surface.points[c]) / 3;
  }
  std::vector<Vec3> inner = internalForces(dual.simplex, m_Options.internalForce);
  for (Vec3& f : inner) f = m_Options.internal * f;
  const std::vector<Vec3> way = meansAround(surface, inner), hidden = hiddenRoughness(surface);
  const auto neighbours = pointNeighbours(surface);
  if (!dual.ids.empty()) m_Last.resize(std::max(m_Last.size(), std::size_t(dual.ids.back()) + 1));
  double largest = 0;
  for (std::size_t p = 0; p < way.size(); ++p)
  {
    const std::int32_t id = dual.ids[p];
    Vec3 displacement = way[p] + outer[p] + m_Options.hidden * hidden[p] + (1 - m_Options.damping) * m_Last[id];
    const double limit = shortestEdge(surface, std::int32_t(p), neighbours[p]) / 3;
    if (norm(displacement) > limit) displacement = limit / norm(displacement) * displacement;
    m_Last[id] = {};
    if (norm(displacement) < m_Options.least) continue;
    for (int tries = 0; tries < 4; ++tries, displacement = 0.5 * displacement)
    {
      if (!dual.move(id, surface.points[p] + displacement)) continue;
      surface.points[p] += displacement;
      m_Last[id] = displacement;
      break;
    }
    largest = std::max(largest, norm(m_Last[id]));
  }
  return largest;
}

std::vector<double> relaxSimplexMesh(SimplexOperators& mesh, const TissueBoundary& boundary,
                                     const MotionOptions& options, int mostSteps, double tolerance)
{
  SimplexMotion motion(options);
  std::vector<double> ways;
  for (int n = 0; n < mostSteps && (ways.empty() || ways.back() > tolerance); ++n)
    ways.push_back(motion.step(mesh, boundary));
  return ways;
}

std::vector<SimplexStep> adaptSimplexMesh(SimplexOperators& mesh, const TissueBoundary& boundary,
                                          const AdaptationOptions& options, const Progress& progress)
{
  std::vector<SimplexStep> steps(1);
  measure(mesh, steps[0]);
  const auto atRest = [&]
  {
    constexpr std::size_t span = 5; // steps to look back: single steps may balance by chance
    if (steps.size() <= span + 1) return false;
    const double now = double(steps.back().faces), then = double(steps[steps.size() - 1 - span].faces);
    return std::abs(now - then) <= options.rest * now;
  };
  for (int n = 0; n < options.mostIterations && !atRest(); ++n)
  {
    report(progress, double(n) / options.mostIterations, "adaptation");
    SimplexStep step;
    step.t1 = fuseShortEdges(mesh, options);
    step.t2 = cutFaces(mesh, options);
    step.t7 = swapEdges(mesh);
    SimplexMotion motion(options.motion);
    for (int m = 0; m < options.motionsPerIteration; ++m) step.largestMove = motion.step(mesh, boundary);
    measure(mesh, step);
    steps.push_back(step);
  }
  relaxSimplexMesh(mesh, boundary, options.motion, options.lastMotions, 0);
  if (options.lastMotions > 0)
  {
    steps.emplace_back();
    measure(mesh, steps.back());
  }
  report(progress, 1, "adaptation");
  return steps;
}

std::string evolutionCSV(const std::vector<SimplexStep>& steps)
{
  std::ostringstream out;
  out << "iteration,faces,vertices,meanDistance,maximumDistance,T1,T2,T7,largestMove\n";
  for (std::size_t n = 0; n < steps.size(); ++n)
  {
    const SimplexStep& s = steps[n];
    out << n << ',' << s.faces << ',' << s.vertices << ',' << s.meanDistance << ',' << s.maximumDistance << ',' << s.t1
        << ',' << s.t2 << ',' << s.t7 << ',' << s.largestMove << '\n';
  }
  return out.str();
}

} // namespace surgicalmesher
