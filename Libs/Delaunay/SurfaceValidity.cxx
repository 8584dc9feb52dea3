// SPDX-License-Identifier: Apache-2.0
#include "SurfaceValidity.h"

#include "MeshChecks.h"

#include <CGAL/Bbox_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/box_intersection_d.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>

namespace surgicalmesher
{
namespace
{

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Triangle = std::array<std::int32_t, 3>;

Kernel::Point_3 exact(const Vec3& p) { return { p.x, p.y, p.z }; }

Kernel::Triangle_3 exact(const SurfaceComplex& surface, const Triangle& t)
{
  return { exact(surface.points[t[0]]), exact(surface.points[t[1]]), exact(surface.points[t[2]]) };
}

/// Returns the corners of `t`, those shared with `other` first, and the number of shared corners.
std::pair<Triangle, int> sharedFirst(const Triangle& t, const Triangle& other)
{
  Triangle sorted = t;
  const auto end =
    std::stable_partition(sorted.begin(), sorted.end(),
                          [&](std::int32_t id) { return std::find(other.begin(), other.end(), id) != other.end(); });
  return { sorted, static_cast<int>(end - sorted.begin()) };
}

bool oppositeEdgeMeets(const SurfaceComplex& surface, const Triangle& from, const Triangle& to)
{
  const Kernel::Segment_3 edge(exact(surface.points[from[1]]), exact(surface.points[from[2]]));
  return CGAL::do_intersect(edge, exact(surface, to));
}

/// Triangles with a common edge overlap only if they are coplanar and on the same side of it.
bool overlapAcrossEdge(const SurfaceComplex& surface, const Triangle& a, std::int32_t apex)
{
  const auto p = exact(surface.points[a[0]]), q = exact(surface.points[a[1]]);
  const auto r = exact(surface.points[a[2]]), s = exact(surface.points[apex]);
  return CGAL::orientation(p, q, r, s) == CGAL::COPLANAR && CGAL::coplanar_orientation(p, q, r, s) == CGAL::POSITIVE;
}

bool meetElsewhere(const SurfaceComplex& surface, const Triangle& a, const Triangle& b)
{
  const auto [first, shared] = sharedFirst(a, b);
  const Triangle second = sharedFirst(b, a).first;
  switch (shared)
  {
  case 0: return CGAL::do_intersect(exact(surface, first), exact(surface, second));
  case 1: return oppositeEdgeMeets(surface, first, b) || oppositeEdgeMeets(surface, second, a);
  case 2: return overlapAcrossEdge(surface, first, second[2]);
  default: return true;
  }
}

Vec3 centreOf(const SurfaceComplex& surface, std::int32_t t)
{
  const auto& [a, b, c] = surface.triangles[t];
  return (surface.points[a] + surface.points[b] + surface.points[c]) / 3;
}

std::vector<std::int32_t> degenerateTriangles(const SurfaceComplex& surface)
{
  std::vector<std::int32_t> result;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
  {
    if (exact(surface, surface.triangles[t]).is_degenerate()) result.push_back(static_cast<std::int32_t>(t));
  }
  return result;
}

[[noreturn]] void refuse(const SurfaceComplex& surface, const std::string& name, const std::string& what,
                         const std::string& expected, std::vector<std::int32_t> triangles, const Vec3& where)
{
  throw SurfaceRefused(name + ": " + what + ", the first at " + place(where) + ", expected " + expected, surface,
                       std::move(triangles));
}

void requireNoIntersections(const SurfaceComplex& surface, const std::string& name)
{
  const std::vector<std::int32_t> degenerate = degenerateTriangles(surface);
  if (!degenerate.empty())
  {
    refuse(surface, name, std::to_string(degenerate.size()) + " triangles without area", "none", degenerate,
           centreOf(surface, degenerate.front()));
  }
  const auto pairs = selfIntersections(surface);
  if (pairs.empty()) return;
  std::vector<std::int32_t> triangles;
  for (const auto& [a, b] : pairs) triangles.insert(triangles.end(), { a, b });
  refuse(surface, name, "the surface cuts itself: " + std::to_string(pairs.size()) + " pairs of triangles",
         "triangles that meet in common points and edges only", triangles, centreOf(surface, pairs.front().first));
}

// ---- edges ----------------------------------------------------------------------------------------------------------

struct EdgeUse
{
  std::int32_t low, high, triangle;
  bool ascending;
};

std::vector<EdgeUse> edgeUses(const SurfaceComplex& surface)
{
  std::vector<EdgeUse> uses;
  uses.reserve(3 * surface.triangles.size());
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
  {
    for (int c = 0; c < 3; ++c)
    {
      const std::int32_t from = surface.triangles[t][c], to = surface.triangles[t][(c + 1) % 3];
      uses.push_back({ std::min(from, to), std::max(from, to), static_cast<std::int32_t>(t), from < to });
    }
  }
  std::sort(uses.begin(), uses.end(),
            [](const EdgeUse& a, const EdgeUse& b)
            { return std::tie(a.low, a.high, a.triangle) < std::tie(b.low, b.high, b.triangle); });
  return uses;
}

/// Returns the triangles at fault at the edges of a tissue's boundary: without `overused`, those at edges where the
/// sides on which the tissue lies do not balance as around a closed boundary; with `overused`, those at edges of more
/// than two triangles.
std::vector<std::int32_t> faultyTriangles(const SurfaceComplex& surface, Label tissue, bool overused)
{
  std::vector<std::int32_t> result;
  const std::vector<EdgeUse> uses = edgeUses(surface);
  for (std::size_t begin = 0, end; begin < uses.size(); begin = end)
  {
    int balance = 0;
    std::vector<std::int32_t> around;
    for (end = begin; end < uses.size() && uses[end].low == uses[begin].low && uses[end].high == uses[begin].high;
         ++end)
    {
      const auto& [behind, front] = surface.labels[uses[end].triangle];
      if ((behind == tissue) == (front == tissue)) continue;
      balance += uses[end].ascending == (behind == tissue) ? 1 : -1;
      around.push_back(uses[end].triangle);
    }
    if (overused ? around.size() > 2 : balance != 0) result.insert(result.end(), around.begin(), around.end());
  }
  return result;
}

std::vector<std::int32_t> trianglesAt(const SurfaceComplex& surface, std::int32_t point)
{
  std::vector<std::int32_t> result;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
  {
    const Triangle& ids = surface.triangles[t];
    if (std::find(ids.begin(), ids.end(), point) != ids.end()) result.push_back(static_cast<std::int32_t>(t));
  }
  return result;
}

void requireManifold(const SurfaceComplex& surface, const std::string& name, Label label, const TissueSurface& tissue)
{
  const auto refuseFor =
    [&](const Defect& defect, const char* what, const char* expected, std::vector<std::int32_t> triangles)
  {
    refuse(surface, name,
           "the surface of tissue " + std::to_string(label) + " has " + std::to_string(defect.count) + " " + what,
           expected, std::move(triangles), defect.where);
  };
  const char* const closed = "a closed surface around every tissue";
  const char* const manifold = "tissues that don't touch themselves along an edge or at a point";
  if (tissue.openEdges.count > 0)
  {
    refuseFor(tissue.openEdges, "open edges", closed, faultyTriangles(surface, label, false));
  }
  if (tissue.misorientedEdges.count > 0)
  {
    refuseFor(tissue.misorientedEdges, "edges with BoundaryLabels on mismatched sides", closed,
              faultyTriangles(surface, label, false));
  }
  if (tissue.nonManifoldEdges.count > 0)
  {
    refuseFor(tissue.nonManifoldEdges, "edges of more than two triangles", manifold,
              faultyTriangles(surface, label, true));
  }
  if (tissue.nonManifoldVertices.count > 0)
  {
    refuseFor(tissue.nonManifoldVertices, "points where parts of it touch", manifold,
              trianglesAt(surface, tissue.nonManifoldVertices.item));
  }
}

/// For each triangle corner c, the triangle across the edge from corner c to the next.
using Neighbours = std::vector<std::array<std::int32_t, 3>>;

Neighbours closedNeighbours(const SurfaceComplex& surface, const std::string& name)
{
  Neighbours across(surface.triangles.size(), { -1, -1, -1 });
  std::vector<std::int32_t> open, overused;
  const std::vector<EdgeUse> uses = edgeUses(surface);
  const auto corner = [&](const EdgeUse& use)
  {
    const Triangle& t = surface.triangles[use.triangle];
    return std::find(t.begin(), t.end(), use.ascending ? use.low : use.high) - t.begin();
  };
  for (std::size_t begin = 0, end; begin < uses.size(); begin = end)
  {
    for (end = begin + 1; end < uses.size() && uses[end].low == uses[begin].low && uses[end].high == uses[begin].high;)
      ++end;
    if (end - begin == 2)
    {
      across[uses[begin].triangle][corner(uses[begin])] = uses[begin + 1].triangle;
      across[uses[begin + 1].triangle][corner(uses[begin + 1])] = uses[begin].triangle;
    }
    for (std::size_t i = begin; end - begin > 2 && i < end; ++i) overused.push_back(uses[i].triangle);
    if (end - begin == 1) open.push_back(uses[begin].triangle);
  }
  if (!open.empty())
  {
    refuse(surface, name, "the surface is open: " + std::to_string(open.size()) + " edges of a single triangle",
           "closed shells", open, centreOf(surface, open.front()));
  }
  if (!overused.empty())
  {
    refuse(surface, name, std::to_string(overused.size()) + " triangles at edges of more than two",
           "closed shells, or BoundaryLabels", overused, centreOf(surface, overused.front()));
  }
  return across;
}

bool runsAlong(const Triangle& t, std::int32_t from, std::int32_t to)
{
  return (t[0] == from && t[1] == to) || (t[1] == from && t[2] == to) || (t[2] == from && t[0] == to);
}

/// Returns the shell of each triangle, after flipping triangles so that all of a shell are oriented alike.
std::vector<std::int32_t> orientShells(SurfaceComplex& surface, const Neighbours& across, const std::string& name)
{
  std::vector<std::int32_t> shell(surface.triangles.size(), -1);
  std::vector<bool> turned(surface.triangles.size(), false);
  std::int32_t count = 0;
  for (std::size_t seed = 0; seed < shell.size(); ++seed)
  {
    if (shell[seed] >= 0) continue;
    std::vector<std::int32_t> front{ static_cast<std::int32_t>(seed) };
    shell[seed] = count;
    while (!front.empty())
    {
      const std::int32_t t = front.back();
      front.pop_back();
      for (int c = 0; c < 3; ++c)
      {
        const std::int32_t next = across[t][c], from = surface.triangles[t][c], to = surface.triangles[t][(c + 1) % 3];
        const bool mustTurn = runsAlong(surface.triangles[next], from, to) != turned[t];
        if (shell[next] < 0)
        {
          shell[next] = count;
          turned[next] = mustTurn;
          front.push_back(next);
        }
        else if (turned[next] != mustTurn)
        {
          refuse(surface, name, "a shell has no consistent inside", "closed orientable shells", { t, next },
                 centreOf(surface, t));
        }
      }
    }
    ++count;
  }
  for (std::size_t t = 0; t < shell.size(); ++t)
  {
    if (turned[t]) std::swap(surface.triangles[t][1], surface.triangles[t][2]);
  }
  return shell;
}

// ---- points ---------------------------------------------------------------------------------------------------------

/// Points of a foreign surface closer than this share of its diagonal are merged: seams of revolved shapes, whose sines
/// differ in the last digits, and coordinates in single precision.
constexpr double kSamePlace = 1e-6;

/// Assigns ids to points. A point within the tolerance of an earlier one, or in the same cube of that width, gets its
/// id.
class PointMerger
{
public:
  explicit PointMerger(double tolerance) : m_Tolerance(tolerance) {}

  std::int32_t idOf(const Vec3& p, std::vector<Vec3>& points)
  {
    const Cube cube = m_Tolerance > 0 ? cubeOf(p) : Cube{ p.x, p.y, p.z };
    const auto [entry, isNew] = m_Ids.emplace(cube, static_cast<std::int32_t>(points.size()));
    if (!isNew) return entry->second;
    const std::int32_t near = m_Tolerance > 0 ? neighbour(p, cube, points) : -1;
    if (near >= 0) return entry->second = near;
    points.push_back(p);
    return entry->second;
  }

private:
  using Cube = std::array<double, 3>;

  Cube cubeOf(const Vec3& p) const
  {
    return { std::floor(p.x / m_Tolerance), std::floor(p.y / m_Tolerance), std::floor(p.z / m_Tolerance) };
  }

  std::int32_t neighbour(const Vec3& p, const Cube& cube, const std::vector<Vec3>& points) const
  {
    for (int step = 0; step < 27; ++step)
    {
      const int i = step % 3 - 1, j = step / 3 % 3 - 1, k = step / 9 - 1;
      const Cube at{ cube[0] + i, cube[1] + j, cube[2] + k };
      const auto found = at == cube ? m_Ids.end() : m_Ids.find(at);
      if (found != m_Ids.end() && norm(points[found->second] - p) <= m_Tolerance) return found->second;
    }
    return -1;
  }

  double m_Tolerance;
  std::map<Cube, std::int32_t> m_Ids;
};

double diagonalOf(const std::vector<Vec3>& points)
{
  Vec3 low = points.front(), high = low;
  for (const Vec3& p : points)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      low[axis] = std::min(low[axis], p[axis]);
      high[axis] = std::max(high[axis], p[axis]);
    }
  }
  return norm(high - low);
}

// ---- nesting --------------------------------------------------------------------------------------------------------

struct Shell
{
  std::vector<std::int32_t> triangles;
  Vec3 low{ std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(),
            std::numeric_limits<double>::infinity() };
  Vec3 high = -low;
  double volume = 0;
};

std::vector<Shell> collectShells(const SurfaceComplex& surface, const std::vector<std::int32_t>& shellOf)
{
  std::vector<Shell> shells(1 + *std::max_element(shellOf.begin(), shellOf.end()));
  for (std::size_t t = 0; t < shellOf.size(); ++t)
  {
    Shell& shell = shells[shellOf[t]];
    shell.triangles.push_back(static_cast<std::int32_t>(t));
    const Vec3& origin = surface.points[surface.triangles[shell.triangles.front()][0]];
    const auto& [a, b, c] = surface.triangles[t];
    shell.volume += orient(origin, surface.points[a], surface.points[b], surface.points[c]) / 6;
    for (const std::int32_t id : surface.triangles[t])
    {
      for (int axis = 0; axis < 3; ++axis)
      {
        shell.low[axis] = std::min(shell.low[axis], surface.points[id][axis]);
        shell.high[axis] = std::max(shell.high[axis], surface.points[id][axis]);
      }
    }
  }
  return shells;
}

/// Returns how often the shell winds around p, from the sum of its solid angles (van Oosterom and Strackee 1983): 1
/// inside, 0 outside.
double windingNumber(const SurfaceComplex& surface, const Shell& shell, const Vec3& p)
{
  double sum = 0;
  for (const std::int32_t t : shell.triangles)
  {
    const Vec3 a = surface.points[surface.triangles[t][0]] - p;
    const Vec3 b = surface.points[surface.triangles[t][1]] - p;
    const Vec3 c = surface.points[surface.triangles[t][2]] - p;
    const double na = norm(a), nb = norm(b), nc = norm(c);
    sum += std::atan2(dot(a, cross(b, c)), na * nb * nc + dot(a, b) * nc + dot(b, c) * na + dot(c, a) * nb);
  }
  return sum / (2 * std::acos(-1.0));
}

bool encloses(const SurfaceComplex& surface, const Shell& outer, const Shell& inner)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    if (inner.low[axis] < outer.low[axis] || inner.high[axis] > outer.high[axis]) return false;
  }
  if (!(inner.volume < outer.volume)) return false;
  return windingNumber(surface, outer, centreOf(surface, inner.triangles.front())) > 0.5;
}

} // namespace

std::vector<std::pair<std::int32_t, std::int32_t>> selfIntersections(const SurfaceComplex& surface)
{
  using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, std::int32_t>;
  std::vector<Box> boxes;
  boxes.reserve(surface.triangles.size());
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
  {
    CGAL::Bbox_3 box;
    for (const std::int32_t id : surface.triangles[t]) box += exact(surface.points[id]).bbox();
    boxes.emplace_back(box, static_cast<std::int32_t>(t));
  }
  std::vector<std::pair<std::int32_t, std::int32_t>> pairs;
  CGAL::box_self_intersection_d(boxes.begin(), boxes.end(),
                                [&](const Box& a, const Box& b)
                                {
                                  const std::int32_t low = std::min(a.info(), b.info()),
                                                     high = std::max(a.info(), b.info());
                                  if (meetElsewhere(surface, surface.triangles[low], surface.triangles[high]))
                                    pairs.emplace_back(low, high);
                                });
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

void requireFillable(const SurfaceComplex& surface, const std::string& name)
{
  for (const auto& [label, tissue] : checkSurface(surface)) requireManifold(surface, name, label, tissue);
  requireNoIntersections(surface, name);
}

SurfaceComplex withoutDuplicatePoints(const SurfaceComplex& surface, double tolerance)
{
  SurfaceComplex result;
  PointMerger merger(tolerance);
  std::vector<std::int32_t> newId;
  for (const Vec3& p : surface.points) newId.push_back(merger.idOf(p, result.points));
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
  {
    const auto& [i, j, k] = surface.triangles[t];
    const Triangle triangle{ newId[i], newId[j], newId[k] };
    if (triangle[0] == triangle[1] || triangle[1] == triangle[2] || triangle[2] == triangle[0]) continue;
    result.triangles.push_back(triangle);
    if (!surface.labels.empty()) result.labels.push_back(surface.labels[t]);
  }
  return result;
}

SurfaceComplex closedShellsToTissues(const SurfaceComplex& surface, const std::string& name)
{
  if (surface.points.empty()) throw InputError(name + ": no points, expected closed shells");
  SurfaceComplex result = withoutDuplicatePoints(surface, kSamePlace * diagonalOf(surface.points));
  result.labels.clear();
  if (result.triangles.empty()) throw InputError(name + ": no triangle with an area, expected closed shells");
  requireNoIntersections(result, name);
  const std::vector<std::int32_t> shellOf = orientShells(result, closedNeighbours(result, name), name);
  std::vector<Shell> shells = collectShells(result, shellOf);
  if (shells.size() > std::numeric_limits<Label>::max())
  {
    throw InputError(name + ": " + std::to_string(shells.size()) + " closed shells, at most 65535 are handled");
  }
  for (Shell& shell : shells)
  {
    if (shell.volume > 0) continue;
    shell.volume = -shell.volume;
    for (const std::int32_t t : shell.triangles) std::swap(result.triangles[t][1], result.triangles[t][2]);
  }
  result.labels.resize(result.triangles.size());
  for (std::size_t s = 0; s < shells.size(); ++s)
  {
    Label around = 0;
    for (std::size_t other = 0; other < shells.size(); ++other)
    {
      if (other == s || !encloses(result, shells[other], shells[s])) continue;
      if (around == 0 || shells[other].volume < shells[around - 1].volume) around = static_cast<Label>(other + 1);
    }
    for (const std::int32_t t : shells[s].triangles) result.labels[t] = { static_cast<Label>(s + 1), around };
  }
  return result;
}

} // namespace surgicalmesher
