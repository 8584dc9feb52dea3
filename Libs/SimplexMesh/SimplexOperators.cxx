// SPDX-License-Identifier: Apache-2.0
#include "SimplexOperators.h"

#include "Compaction.h"
#include "FacetShape.h"

#include <utility>

namespace surgicalmesher
{

namespace
{

constexpr double kCellSize = 1.5; ///< relative to the initial edge length

double cellSize(const SurfaceComplex& surface)
{
  double sum = 0;
  for (const auto& [a, b, c] : surface.triangles) sum += norm(surface.points[a] - surface.points[b]);
  return kCellSize * std::max(1e-6, sum / double(std::max<std::size_t>(1, surface.triangles.size())));
}

} // namespace

SimplexOperators::SimplexOperators(const SurfaceComplex& surface, const TissueBoundary& boundary, OperatorLimits limits,
                                   const std::vector<DualEdge>& creases)
  : m_Boundary(boundary), m_Limits(std::move(limits)), m_Points(surface.points), m_At(surface.points.size()),
    m_Distances(surface.points.size()), m_Grid(cellSize(surface))
{
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
  {
    Triangle triangle{ surface.triangles[t], surface.labels[t] };
    if (triangle.labels[0] < triangle.labels[1]) // all triangles of an interface have the same orientation
    {
      std::swap(triangle.labels[0], triangle.labels[1]);
      std::swap(triangle.corners[1], triangle.corners[2]);
    }
    insert(triangle);
  }
  for (const auto& [a, b] : creases) setCrease(a, b);
}

// ---- elements ------------------------------------------------------------------------------------------------------

CornerTriangle SimplexOperators::cornersOf(const Triangle& t) const
{
  return { { m_Points[t.corners[0]], m_Points[t.corners[1]], m_Points[t.corners[2]] }, t.corners };
}

Vec3 SimplexOperators::onBoundary(const Vec3& p, const std::array<Label, 2>& labels) const
{
  const auto nearest = m_Boundary.nearest(p, labels);
  return nearest ? nearest->position : p;
}

std::int32_t SimplexOperators::addPoint(const Vec3& p)
{
  m_Points.push_back(p);
  m_At.emplace_back();
  m_Distances.emplace_back();
  return std::int32_t(m_Points.size()) - 1;
}

void SimplexOperators::erase(std::int32_t t)
{
  for (std::int32_t p : m_Triangles[t].corners) m_At[p].erase(std::find(m_At[p].begin(), m_At[p].end(), t));
  m_Triangles[t].corners = { -1, -1, -1 };
  m_Free.push_back(t);
}

std::int32_t SimplexOperators::insert(const Triangle& triangle)
{
  std::int32_t t = std::int32_t(m_Triangles.size());
  if (m_Free.empty())
  {
    m_Triangles.emplace_back();
    m_Fits.emplace_back();
  }
  else
  {
    t = m_Free.back();
    m_Free.pop_back();
  }
  m_Triangles[t] = triangle;
  m_Fits[t].distance = -1; // computed on demand
  for (std::int32_t p : triangle.corners) m_At[p].insert(std::lower_bound(m_At[p].begin(), m_At[p].end(), t), t);
  m_Grid.insert(t, boxOf(cornersOf(triangle)));
  return t;
}

bool SimplexOperators::replace(const std::vector<std::int32_t>& old, const std::vector<Triangle>& fresh,
                               const std::vector<std::pair<std::int32_t, Vec3>>& moved, bool sameTriangles)
{
  std::vector<Triangle> gone;
  for (std::int32_t t : old) gone.push_back(m_Triangles[t]);
  Patch before = patchOf(gone);
  addFits(before, old);
  std::vector<Vec3> home;
  std::vector<std::vector<std::pair<std::array<Label, 2>, double>>> distances;
  for (const auto& [id, p] : moved)
  {
    home.push_back(std::exchange(m_Points[id], p));
    distances.push_back(std::exchange(m_Distances[id], {}));
  }
  const Patch after = patchOf(fresh);
  const bool holds = after.quality >= std::min(m_Limits.minimumQuality, before.quality) &&
                     !(sameTriangles && turns(before, after)) && fits(fresh, before.fit) && !crosses(old, fresh) &&
                     staysCovered(before, after, old);
  if (!holds)
  {
    for (std::size_t i = 0; i < moved.size(); ++i)
    {
      m_Points[moved[i].first] = home[i];
      m_Distances[moved[i].first] = distances[i];
    }
    return false;
  }
  for (std::size_t i = 0; i < old.size(); ++i)
  {
    m_Grid.remove(old[i], boxOf(before.facets[i].shape));
    erase(old[i]);
  }
  for (const Triangle& t : fresh) insert(t);
  return true;
}

// ---- operators -----------------------------------------------------------------------------------------------------

bool SimplexOperators::fuse(std::int32_t a, std::int32_t b)
{
  const std::vector<std::int32_t> between = trianglesAt(a, b);
  if (between.empty() || !keepsTissues(a, b) || !keepsCreases(a, b)) return false;
  std::vector<std::int32_t> creasesOfB;
  for (std::int32_t c : faceNeighbours(b))
    if (isCrease(b, c)) creasesOfB.push_back(c);
  std::vector<std::int32_t> old = m_At[a];
  std::vector<Triangle> fresh;
  for (std::int32_t t : m_At[b])
    if (!contains(m_Triangles[t].corners, a)) old.push_back(t);
  for (std::int32_t t : old)
  {
    Triangle triangle = m_Triangles[t];
    if (contains(triangle.corners, a) && contains(triangle.corners, b)) continue;
    std::replace(triangle.corners.begin(), triangle.corners.end(), b, a);
    fresh.push_back(triangle);
  }
  const int orderA = junctionOrder(a), orderB = junctionOrder(b);
  std::vector<Vec3> places;
  if (orderA == orderB)
  {
    const Vec3 middle = 0.5 * (m_Points[a] + m_Points[b]);
    places.push_back(orderA == 0 ? onBoundary(middle, m_Triangles[between[0]].labels) : middle);
  }
  if (orderA >= orderB) places.push_back(m_Points[a]);
  if (orderB >= orderA) places.push_back(m_Points[b]);
  const bool isDone = std::any_of(places.begin(), places.end(),
                                  [&](const Vec3& p) {
                                    return replace(old, fresh, { { a, p } }, false);
                                  });
  if (!isDone) return false;
  for (std::int32_t c : creasesOfB)
  {
    m_Creases.erase({ std::min(b, c), std::max(b, c) });
    if (c != a) setCrease(a, c);
  }
  return true;
}

bool SimplexOperators::cut(std::int32_t a)
{
  if (cutSheet(a)) return true;
  double longest = 0;
  std::int32_t other = -1;
  for (std::int32_t b : faceNeighbours(a))
    if (norm(m_Points[b] - m_Points[a]) > longest) longest = norm(m_Points[b] - m_Points[a]), other = b;
  return other >= 0 && cutEdge(a, other);
}

/// Cuts a face within an interface into two with nearly equal numbers of vertices, across the direction in which its
/// neighbours lie closest.
bool SimplexOperators::cutSheet(std::int32_t a)
{
  const std::vector<std::int32_t> ring = sheetRing(a);
  const std::size_t n = ring.size();
  if (n < 5) return false;
  std::size_t first = 0;
  const auto span = [&](std::size_t i) { return norm(m_Points[ring[i]] - m_Points[ring[(i + n / 2) % n]]); };
  for (std::size_t i = 1; i < n; ++i)
    if (span(i) < span(first)) first = i;
  const std::array<Label, 2> labels = m_Triangles[m_At[a][0]].labels;
  const std::vector<std::int32_t> old = m_At[a];
  const std::int32_t b = addPoint(m_Points[a]);
  std::vector<Triangle> fresh;
  Vec3 middleA, middleB;
  for (std::size_t k = 0; k < n; ++k)
  {
    const std::int32_t from = ring[(first + k) % n], to = ring[(first + k + 1) % n];
    fresh.push_back({ { k < n / 2 ? b : a, from, to }, labels });
    (k < n / 2 ? middleB : middleA) += 0.5 / double(k < n / 2 ? n / 2 : n - n / 2) * (m_Points[from] + m_Points[to]);
  }
  fresh.push_back({ { a, ring[first], b }, labels });
  fresh.push_back({ { b, ring[(first + n / 2) % n], a }, labels });
  const auto place = [&](const Vec3& side) { return onBoundary(m_Points[a] + 0.35 * (side - m_Points[a]), labels); };
  return replace(old, fresh, { { a, place(middleA) }, { b, place(middleB) } }, false);
}

bool SimplexOperators::cutEdge(std::int32_t a, std::int32_t b)
{
  const std::vector<std::int32_t> old = trianglesAt(a, b);
  const Vec3 middle = 0.5 * (m_Points[a] + m_Points[b]);
  const std::int32_t m = addPoint(isCurve(a, b) ? middle : onBoundary(middle, m_Triangles[old[0]].labels));
  std::vector<Triangle> fresh;
  for (std::int32_t t : old)
    for (std::int32_t end : { a, b })
    {
      fresh.push_back(m_Triangles[t]);
      std::replace(fresh.back().corners.begin(), fresh.back().corners.end(), end, m);
    }
  const bool wasCrease = isCrease(a, b);
  if (!replace(old, fresh, {}, false)) return false;
  if (!wasCrease) return true;
  m_Creases.erase({ std::min(a, b), std::max(a, b) });
  setCrease(a, m);
  setCrease(m, b);
  return true;
}

bool SimplexOperators::swap(std::int32_t a, std::int32_t b)
{
  const auto [c, d] = endsOf(a, b);
  if (c < 0 || isCrease(a, b) || !trianglesAt(c, d).empty()) return false;
  const std::vector<std::int32_t> old = trianglesAt(a, b);
  const std::array<Label, 2> labels = m_Triangles[old[0]].labels;
  for (const Label tissue : labels)
    for (std::int32_t p : { a, b })
      if (neighboursOn(tissue, p).size() < 4) return false;
  return replace(old, { { { a, d, c }, labels }, { { d, b, c }, labels } }, {}, false);
}

bool SimplexOperators::move(std::int32_t a, const Vec3& p)
{
  std::vector<Triangle> fresh;
  for (std::int32_t t : m_At[a]) fresh.push_back(m_Triangles[t]);
  const std::vector<std::int32_t> old = m_At[a];
  return replace(old, fresh, { { a, p } }, true);
}

// ---- the whole -----------------------------------------------------------------------------------------------------

std::size_t SimplexOperators::faceCount() const
{
  return std::size_t(std::count_if(m_At.begin(), m_At.end(), [](const auto& at) { return !at.empty(); }));
}

SurfaceComplex SimplexOperators::surface(std::vector<std::int32_t>* pointIds) const
{
  SurfaceComplex result;
  for (const Triangle& t : m_Triangles)
    if (t.corners[0] >= 0)
    {
      result.triangles.push_back(t.corners);
      result.labels.push_back(t.labels);
    }
  std::vector<std::int32_t> ids = compactPoints(result.triangles, m_Points.size());
  result.points = valuesAt(m_Points, ids);
  if (pointIds) *pointIds = std::move(ids);
  return result;
}

std::vector<DualEdge> SimplexOperators::creases() const
{
  std::vector<std::int32_t> ids, newId(m_Points.size(), -1);
  surface(&ids);
  for (std::size_t p = 0; p < ids.size(); ++p) newId[ids[p]] = std::int32_t(p);
  std::vector<DualEdge> result;
  for (const auto& [a, b] : m_Creases) result.push_back({ newId[a], newId[b] });
  return result;
}

} // namespace surgicalmesher
