// SPDX-License-Identifier: Apache-2.0
#include "SimplexOperators.h"

#include "Compaction.h"

#include <limits>
#include <map>
#include <utility>

namespace surgicalmesher
{

namespace
{

constexpr double kCellSize = 1.5; ///< in edges of the surface to begin with

bool contains(const std::array<std::int32_t, 3>& corners, std::int32_t p)
{
  return corners[0] == p || corners[1] == p || corners[2] == p;
}

std::int32_t thirdCorner(const std::array<std::int32_t, 3>& corners, std::int32_t a, std::int32_t b)
{
  for (std::int32_t c : corners)
    if (c != a && c != b) return c;
  return -1;
}

double cellSize(const SurfaceComplex& surface)
{
  double sum = 0;
  for (const auto& [a, b, c] : surface.triangles) sum += norm(surface.points[a] - surface.points[b]);
  return kCellSize * std::max(1e-6, sum / double(std::max<std::size_t>(1, surface.triangles.size())));
}

Box boxOf(const CornerTriangle& t)
{
  Box box = Box::around(t.corners[0]);
  box.add(t.corners[1]);
  box.add(t.corners[2]);
  return box;
}

double qualityOf(const CornerTriangle& t)
{
  const auto& [a, b, c] = t.corners;
  const double edges = squaredNorm(b - a) + squaredNorm(c - b) + squaredNorm(a - c);
  return edges > 0 ? 2 * std::sqrt(3.) * norm(cross(b - a, c - a)) / edges : 0;
}

bool disjoint(const Box& a, const Box& b)
{
  return a.low.x > b.high.x || a.low.y > b.high.y || a.low.z > b.high.z || b.low.x > a.high.x || b.low.y > a.high.y ||
         b.low.z > a.high.z;
}

/// Seen as one face, inertia of its vertices across over along its longer axis.
double roundnessOf(const std::vector<Vec3>& vertices)
{
  Vec3 mean;
  for (const Vec3& v : vertices) mean += v / double(vertices.size());
  double xx = 0, yy = 0, zz = 0, xy = 0, yz = 0, zx = 0;
  for (const Vec3& v : vertices)
  {
    const Vec3 d = v - mean;
    xx += d.x * d.x, yy += d.y * d.y, zz += d.z * d.z;
    xy += d.x * d.y, yz += d.y * d.z, zx += d.z * d.x;
  }
  // The third eigenvalue is near zero: two are left of trace and second invariant.
  const double half = 0.5 * (xx + yy + zz);
  const double second = xx * yy - xy * xy + yy * zz - yz * yz + zz * xx - zx * zx;
  const double spread = std::sqrt(std::max(0., half * half - second));
  return half > 0 ? std::sqrt(std::max(0., half - spread) / (half + spread)) : 0;
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
    if (triangle.labels[0] < triangle.labels[1]) // one sheet, one orientation
    {
      std::swap(triangle.labels[0], triangle.labels[1]);
      std::swap(triangle.corners[1], triangle.corners[2]);
    }
    insert(triangle);
  }
  for (const auto& [a, b] : creases) setCrease(a, b);
}

// ---- elements -------------------------------------------------------------------------------------------------------

CornerTriangle SimplexOperators::cornersOf(const Triangle& t) const
{
  return { { m_Points[t.corners[0]], m_Points[t.corners[1]], m_Points[t.corners[2]] }, t.corners };
}

double SimplexOperators::distanceAt(const Vec3& p, const std::array<Label, 2>& labels) const
{
  const auto nearest = m_Boundary.nearest(p, labels);
  return nearest ? nearest->distance : 2 * m_Boundary.reach();
}

double SimplexOperators::distanceOfPoint(std::int32_t p, const std::array<Label, 2>& labels)
{
  auto& known = m_Distances[p];
  for (const auto& [between, distance] : known)
    if (between == labels) return distance;
  known.emplace_back(labels, distanceAt(m_Points[p], labels));
  return known.back().second;
}

SimplexOperators::Fit SimplexOperators::fitOf(const Triangle& t)
{
  const auto corners = cornersOf(t).corners;
  const Vec3 centroid = (corners[0] + corners[1] + corners[2]) / 3,
             n = cross(corners[1] - corners[0], corners[2] - corners[0]);
  double farthest = 0;
  for (std::int32_t p : t.corners) farthest = std::max(farthest, distanceOfPoint(p, t.labels));
  for (int k = 0; m_Limits.isBoundStrict && k < 3; ++k)
    if (t.corners[k] < t.corners[(k + 1) % 3]) // once for both triangles of a sheet
      farthest = std::max(farthest, distanceAt(0.5 * (corners[k] + corners[(k + 1) % 3]), t.labels));
  Fit fit;
  const auto nearest = m_Boundary.nearest(centroid, t.labels);
  farthest = std::max(farthest, nearest ? nearest->distance : 2 * m_Boundary.reach());
  if (nearest) fit.cosine = dot(n, nearest->normal) / std::max(1e-300, norm(n));
  fit.distance = farthest / m_Limits.proximity(centroid);
  return fit;
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
  m_Fits[t].distance = -1; // found when it is asked for
  for (std::int32_t p : triangle.corners) m_At[p].insert(std::lower_bound(m_At[p].begin(), m_At[p].end(), t), t);
  m_Grid.insert(t, boxOf(cornersOf(triangle)));
  return t;
}

// ---- guards ---------------------------------------------------------------------------------------------------------

bool SimplexOperators::crosses(const std::vector<std::int32_t>& old, const std::vector<Triangle>& fresh) const
{
  for (std::size_t i = 0; i < fresh.size(); ++i)
  {
    const CornerTriangle shape = cornersOf(fresh[i]);
    for (std::size_t j = 0; j < i; ++j)
      if (trianglesCross(shape, cornersOf(fresh[j]))) return true;
    const Box box = boxOf(shape);
    bool apart = true;
    m_Grid.visit(box,
                 [&](std::int32_t t)
                 {
                   const CornerTriangle other = cornersOf(m_Triangles[t]);
                   const bool stays = !disjoint(box, boxOf(other)) && std::find(old.begin(), old.end(), t) == old.end();
                   return apart = !stays || !trianglesCross(shape, other);
                 });
    if (!apart) return true;
  }
  return false;
}

bool SimplexOperators::coveredElsewhere(const Vec3& p, double within, const std::array<Label, 2>& labels,
                                        const std::vector<std::int32_t>& old) const
{
  bool covered = false;
  m_Grid.visit(Box::around(p, within),
               [&](std::int32_t t)
               {
                 if (m_Triangles[t].labels != labels || std::find(old.begin(), old.end(), t) != old.end()) return true;
                 const auto& [a, b, c] = cornersOf(m_Triangles[t]).corners;
                 covered = squaredNorm(nearestOnTriangle(p, a, b, c) - p) <= within * within;
                 return !covered;
               });
  return covered;
}

bool SimplexOperators::staysCovered(const Patch& before, const Patch& after, const std::vector<std::int32_t>& old) const
{
  Box box = boxOf(before.facets[0].shape);
  for (const Facet& f : before.facets)
    for (const Vec3& p : f.shape.corners) box.add(p);
  const double bound = m_Limits.proximity(0.5 * (box.low + box.high));
  if (m_Limits.isBoundStrict)
  {
    box.add(box.low - Vec3{ bound, bound, bound });
    box.add(box.high + Vec3{ bound, bound, bound });
  }
  bool holds = true;
  const auto visit = [&](const Vec3& p, std::array<Label, 2> labels)
  {
    if (labels[0] < labels[1]) std::swap(labels[0], labels[1]);
    const auto distanceTo = [&](const Patch& patch)
    {
      double best = 2 * bound; // farther samples belong to other parts of the surface
      for (const Facet& f : patch.facets)
      {
        if (f.labels != labels || norm(p - f.centroid) >= best + f.radius) continue;
        const auto& [a, b, c] = f.shape.corners;
        best = std::min(best, norm(nearestOnTriangle(p, a, b, c) - p));
      }
      return best;
    };
    const double now = distanceTo(after);
    if (now <= bound) return true;
    const double limit = m_Limits.isBoundStrict ? bound : std::max(bound, distanceTo(before));
    holds = now <= limit || coveredElsewhere(p, limit, labels, old);
    return holds;
  };
  if (m_Limits.isBoundStrict) m_Boundary.allSamples(box, visit);
  else m_Boundary.samples(box, visit);
  return holds;
}

/// Whether a triangle of `after` has turned by more than 60 degrees.
bool SimplexOperators::turns(const Patch& before, const Patch& after) const
{
  const auto normal = [](const Facet& f)
  { return cross(f.shape.corners[1] - f.shape.corners[0], f.shape.corners[2] - f.shape.corners[0]); };
  for (std::size_t i = 0; i < after.facets.size(); ++i)
  {
    const Vec3 m = normal(before.facets[i]), n = normal(after.facets[i]);
    if (dot(m, n) < 0.5 * norm(m) * norm(n)) return true;
  }
  return false;
}

SimplexOperators::Patch SimplexOperators::patchOf(const std::vector<Triangle>& triangles) const
{
  Patch patch;
  for (const Triangle& t : triangles)
  {
    const CornerTriangle shape = cornersOf(t);
    const auto& [a, b, c] = shape.corners;
    const Vec3 centroid = (a + b + c) / 3;
    patch.facets.push_back(
      { shape, t.labels, centroid, std::max({ norm(a - centroid), norm(b - centroid), norm(c - centroid) }) });
    patch.quality = std::min(patch.quality, qualityOf(patch.facets.back().shape));
  }
  return patch;
}

void SimplexOperators::addFits(Patch& patch, const std::vector<std::int32_t>& old)
{
  for (std::int32_t t : old)
  {
    if (m_Fits[t].distance < 0) m_Fits[t] = fitOf(m_Triangles[t]);
    patch.fit.distance = std::max(patch.fit.distance, m_Fits[t].distance);
    patch.fit.cosine = std::min(patch.fit.cosine, m_Fits[t].cosine);
  }
}

bool SimplexOperators::fits(const std::vector<Triangle>& fresh, const Fit& before)
{
  return std::all_of(fresh.begin(), fresh.end(),
                     [&](const Triangle& t)
                     {
                       const Fit fit = fitOf(t);
                       return fit.distance <= std::max(1., before.distance) &&
                              fit.cosine >= std::min(m_Limits.minimumCosine, before.cosine);
                     });
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

/// Two faces may fuse if they share exactly one edge on the surface of each tissue that has both, if no two triangles
/// become one, and if the tissues that touch here still do.
bool SimplexOperators::keepsTissues(std::int32_t a, std::int32_t b) const
{
  const std::vector<std::int32_t> between = trianglesAt(a, b);
  std::set<Label> tissues;
  std::set<std::array<Label, 2>> pairs, left;
  for (std::int32_t p : { a, b })
    for (std::int32_t t : m_At[p])
    {
      tissues.insert(m_Triangles[t].labels.begin(), m_Triangles[t].labels.end());
      pairs.insert(m_Triangles[t].labels);
      if (!contains(m_Triangles[t].corners, p == a ? b : a)) left.insert(m_Triangles[t].labels);
    }
  if (left != pairs) return false;
  const auto common = [](const std::vector<std::int32_t>& x, const std::vector<std::int32_t>& y)
  {
    std::vector<std::int32_t> both;
    std::set_intersection(x.begin(), x.end(), y.begin(), y.end(), std::back_inserter(both));
    return both;
  };
  if (common(faceNeighbours(a), faceNeighbours(b)).size() != between.size()) return false;
  for (const Label tissue : tissues)
  {
    const std::vector<std::int32_t> atA = neighboursOn(tissue, a), atB = neighboursOn(tissue, b);
    if (atA.empty() || atB.empty()) continue;
    const auto edges = std::count_if(
      between.begin(), between.end(),
      [&](std::int32_t t) { return m_Triangles[t].labels[0] == tissue || m_Triangles[t].labels[1] == tissue; });
    if (edges != 2 || common(atA, atB).size() != 2) return false;
  }
  for (std::int32_t t : m_At[a])
    for (std::int32_t s : m_At[b])
    {
      const auto& x = m_Triangles[t].corners;
      const auto& y = m_Triangles[s].corners;
      if (contains(x, b) || contains(y, a)) continue;
      if (std::count_if(x.begin(), x.end(), [&](std::int32_t c) { return c != a && contains(y, c); }) == 2)
        return false;
    }
  return true;
}

/// Two faces fuse along a curve or where one of them lies beside it, and no two parts of curves become one.
bool SimplexOperators::keepsCreases(std::int32_t a, std::int32_t b) const
{
  if (m_Creases.empty()) return true;
  const int orderA = junctionOrder(a), orderB = junctionOrder(b);
  if (orderA == 0 || orderB == 0) return true;
  if (!isCurve(a, b) || orderA + orderB == 4) return false;
  const std::vector<std::int32_t> between = trianglesAt(a, b);
  return std::none_of(between.begin(), between.end(),
                      [&](std::int32_t t)
                      {
                        const std::int32_t c = thirdCorner(m_Triangles[t].corners, a, b);
                        return isCurve(a, c) && isCurve(b, c);
                      });
}

// ---- operators ------------------------------------------------------------------------------------------------------

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

/// Cuts a face inside a sheet into two of nearly as many vertices, across the way along which its neighbours lie
/// closest.
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

// ---- queries --------------------------------------------------------------------------------------------------------

std::size_t SimplexOperators::faceCount() const
{
  return std::size_t(std::count_if(m_At.begin(), m_At.end(), [](const auto& at) { return !at.empty(); }));
}

std::vector<std::int32_t> SimplexOperators::faceNeighbours(std::int32_t a) const
{
  std::vector<std::int32_t> neighbours;
  for (std::int32_t t : m_At[a])
    for (std::int32_t c : m_Triangles[t].corners)
      if (c != a) neighbours.push_back(c);
  std::sort(neighbours.begin(), neighbours.end());
  neighbours.erase(std::unique(neighbours.begin(), neighbours.end()), neighbours.end());
  return neighbours;
}

std::vector<std::int32_t> SimplexOperators::neighboursOn(Label tissue, std::int32_t a) const
{
  std::vector<std::int32_t> neighbours;
  for (std::int32_t t : m_At[a])
    if (m_Triangles[t].labels[0] == tissue || m_Triangles[t].labels[1] == tissue)
      for (std::int32_t c : m_Triangles[t].corners)
        if (c != a) neighbours.push_back(c);
  std::sort(neighbours.begin(), neighbours.end());
  neighbours.erase(std::unique(neighbours.begin(), neighbours.end()), neighbours.end());
  return neighbours;
}

std::vector<std::int32_t> SimplexOperators::trianglesAt(std::int32_t a, std::int32_t b) const
{
  std::vector<std::int32_t> between;
  for (std::int32_t t : m_At[a])
    if (contains(m_Triangles[t].corners, b)) between.push_back(t);
  return between;
}

bool SimplexOperators::isCurve(std::int32_t a, std::int32_t b) const
{
  return trianglesAt(a, b).size() != 2 || isCrease(a, b);
}

std::vector<Label> SimplexOperators::tissuesAt(std::int32_t a) const
{
  std::set<Label> tissues;
  for (std::int32_t t : m_At[a]) tissues.insert(m_Triangles[t].labels.begin(), m_Triangles[t].labels.end());
  return { tissues.begin(), tissues.end() };
}

std::vector<std::int32_t> SimplexOperators::curveNeighbours(std::int32_t a) const
{
  std::vector<std::int32_t> neighbours = faceNeighbours(a);
  neighbours.erase(std::remove_if(neighbours.begin(), neighbours.end(), [&](std::int32_t b) { return !isCurve(a, b); }),
                   neighbours.end());
  return neighbours;
}

int SimplexOperators::junctionOrder(std::int32_t a) const
{
  const std::vector<std::int32_t> along = curveNeighbours(a);
  if (along.size() != 2) return along.empty() ? 0 : 2;
  if (m_Creases.empty()) return 1;
  constexpr double straight = 0.7; // cosine of the turn
  const Vec3 in = m_Points[a] - m_Points[along[0]], out = m_Points[along[1]] - m_Points[a];
  const bool turns = isCrease(a, along[0]) && isCrease(a, along[1]) && dot(in, out) < straight * norm(in) * norm(out);
  return turns ? 2 : 1;
}

bool SimplexOperators::isOnCrease(std::int32_t a) const
{
  const std::vector<std::int32_t> neighbours = faceNeighbours(a);
  return std::any_of(neighbours.begin(), neighbours.end(), [&](std::int32_t b) { return isCrease(a, b); });
}

/// The faces around face a, counter-clockwise; none unless it lies inside one sheet.
std::vector<std::int32_t> SimplexOperators::sheetRing(std::int32_t a) const
{
  if (junctionOrder(a) != 0) return {};
  std::vector<std::int32_t> ring;
  std::int32_t at = -1;
  for (std::size_t step = 0; step < m_At[a].size(); ++step)
    for (std::int32_t t : m_At[a])
    {
      const auto& c = m_Triangles[t].corners;
      const int k = c[0] == a ? 0 : c[1] == a ? 1 : 2;
      if (step > 0 && c[(k + 1) % 3] != at) continue;
      ring.push_back(c[(k + 1) % 3]);
      at = c[(k + 2) % 3];
      break;
    }
  const bool once = ring.size() == m_At[a].size() && at == ring[0] && std::count(ring.begin(), ring.end(), at) == 1;
  return once ? ring : std::vector<std::int32_t>{};
}

std::array<std::int32_t, 2> SimplexOperators::endsOf(std::int32_t a, std::int32_t b) const
{
  const std::vector<std::int32_t> between = trianglesAt(a, b);
  if (between.size() != 2) return { -1, -1 };
  const auto forward = [&](const Corners& c)
  { return (c[0] == a && c[1] == b) || (c[1] == a && c[2] == b) || (c[2] == a && c[0] == b); };
  const Corners &x = m_Triangles[between[0]].corners, &y = m_Triangles[between[1]].corners;
  if (forward(x) == forward(y)) return { -1, -1 };
  const std::int32_t left = thirdCorner(x, a, b), right = thirdCorner(y, a, b);
  return forward(x) ? std::array<std::int32_t, 2>{ left, right } : std::array<std::int32_t, 2>{ right, left };
}

Vec3 SimplexOperators::onBoundary(const Vec3& p, const std::array<Label, 2>& labels) const
{
  const auto nearest = m_Boundary.nearest(p, labels);
  return nearest ? nearest->position : p;
}

double SimplexOperators::area(std::int32_t a) const
{
  double sum = 0;
  for (std::int32_t t : m_At[a])
  {
    const auto& [p, q, r] = cornersOf(m_Triangles[t]).corners;
    sum += norm(cross(q - p, r - p)) / 6;
  }
  return sum;
}

Vec3 SimplexOperators::vertex(std::int32_t v) const
{
  const auto& [a, b, c] = m_Triangles[v].corners;
  return (m_Points[a] + m_Points[b] + m_Points[c]) / 3;
}

std::size_t SimplexOperators::mostVertices(std::int32_t a) const
{
  std::map<Label, std::size_t> count;
  std::size_t most = 0;
  for (std::int32_t t : m_At[a])
    for (const Label label : m_Triangles[t].labels) most = std::max(most, ++count[label]);
  return most;
}

double SimplexOperators::edgeRatio(std::int32_t a, std::int32_t b) const
{
  const std::vector<std::int32_t> between = trianglesAt(a, b);
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < between.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
    {
      const auto &x = m_Triangles[between[i]].labels, &y = m_Triangles[between[j]].labels;
      if (x[0] != y[0] && x[0] != y[1] && x[1] != y[0] && x[1] != y[1]) continue;
      const Vec3 p = vertex(between[i]), q = vertex(between[j]);
      least = std::min(least, std::sqrt(3.) * norm(p - q) / m_Limits.edgeLength(0.5 * (p + q)));
    }
  return least;
}

double SimplexOperators::centreDistance(std::int32_t a) const
{
  std::map<std::array<Label, 2>, std::pair<Vec3, int>> centres;
  for (std::int32_t t : m_At[a])
  {
    auto& [sum, count] = centres[m_Triangles[t].labels];
    sum += vertex(t);
    ++count;
  }
  double most = 0;
  for (const auto& [labels, centre] : centres)
  {
    const auto nearest = m_Boundary.nearest(centre.first / centre.second, labels);
    most = std::max(most, nearest ? nearest->distance : m_Boundary.reach());
  }
  return most;
}

double SimplexOperators::faceQuality(std::int32_t a, const Vec3& p) const
{
  double worst = 1;
  for (std::int32_t t : m_At[a])
  {
    CornerTriangle shape = cornersOf(m_Triangles[t]);
    for (int k = 0; k < 3; ++k)
      if (shape.ids[k] == a) shape.corners[k] = p;
    worst = std::min(worst, qualityOf(shape));
  }
  return worst;
}

double SimplexOperators::edgeQuality(std::int32_t a, std::int32_t b) const
{
  double worst = 1;
  for (std::int32_t t : trianglesAt(a, b)) worst = std::min(worst, qualityOf(cornersOf(m_Triangles[t])));
  return worst;
}

double SimplexOperators::qualityAfterSwap(std::int32_t a, std::int32_t b) const
{
  const auto [c, d] = endsOf(a, b);
  if (c < 0) return 0;
  return std::min(qualityOf(cornersOf({ { a, d, c }, {} })), qualityOf(cornersOf({ { d, b, c }, {} })));
}

double SimplexOperators::fusion(std::int32_t a, std::int32_t b) const
{
  std::vector<Vec3> vertices;
  Vec3 normalA, normalB;
  for (std::int32_t p : { a, b })
    for (std::int32_t t : m_At[p])
    {
      const auto& [x, y, z] = cornersOf(m_Triangles[t]).corners;
      (p == a ? normalA : normalB) += cross(y - x, z - x);
      if (!contains(m_Triangles[t].corners, p == a ? b : a)) vertices.push_back(vertex(t));
    }
  const double cosine = dot(normalA, normalB) / std::max(1e-300, norm(normalA) * norm(normalB));
  const Vec3 between = m_Points[b] - m_Points[a];
  const double length = norm(between) / m_Limits.edgeLength(m_Points[a] + 0.5 * between);
  return std::max(0., cosine) * roundnessOf(vertices) / (0.2 + length);
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
