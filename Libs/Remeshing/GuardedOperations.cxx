#include "GuardedOperations.h"

#include "TetQuality.h"
#include "UnionFind.h"

#include <algorithm>
#include <cassert>
#include <functional>
#include <limits>

namespace surgicalmesher
{

namespace
{

constexpr int maximumRing = 10;
constexpr std::size_t mostLocalLabels = 30;

int bitCount(std::uint32_t x)
{
  int n = 0;
  for (; x; x &= x - 1) ++n;
  return n;
}

/// The point of the sheet that is nearest to p, and its squared distance; null if there is none.
std::pair<const SheetSample*, double> nearestPoint(const Sheet& sheet, const Vec3& p)
{
  std::pair<const SheetSample*, double> result{ nullptr, std::numeric_limits<double>::max() };
  for (const SheetSample& point : sheet.points)
    if (const double d2 = squaredNorm(point.position - p); d2 < result.second) result = { &point, d2 };
  return result;
}

/// How far faces are off the points of a sheet.
struct FacesOff
{
  double area = 0;
  double sum = 0; ///< of areas times squared distances of centres to the nearest point, in units of its tolerance

  void add(const Sheet& sheet, const Vec3& a, const Vec3& b, const Vec3& c)
  {
    const Vec3 centre = (a + b + c) / 3.0;
    double least = std::numeric_limits<double>::max();
    for (const SheetSample& point : sheet.points)
      least = std::min(least, squaredNorm(point.position - centre) / point.tolerance2);
    const double own = 0.5 * norm(cross(b - a, c - a));
    area += own;
    sum += own * least;
  }
};

} // namespace

double squaredDistanceToTriangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c)
{
  const Vec3 ab = b - a, ac = c - a, ap = p - a;
  const double d1 = dot(ab, ap), d2 = dot(ac, ap);
  if (d1 <= 0 && d2 <= 0) return squaredNorm(ap);
  const Vec3 bp = p - b;
  const double d3 = dot(ab, bp), d4 = dot(ac, bp);
  if (d3 >= 0 && d4 <= d3) return squaredNorm(bp);
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return squaredNorm(ap - ab * (d1 / (d1 - d3)));
  const Vec3 cp = p - c;
  const double d5 = dot(ab, cp), d6 = dot(ac, cp);
  if (d6 >= 0 && d5 <= d6) return squaredNorm(cp);
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return squaredNorm(ap - ac * (d2 / (d2 - d6)));
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) return squaredNorm(bp - (c - b) * ((d4 - d3) / ((d4 - d3) + (d5 - d6))));
  const Vec3 n = cross(ab, ac);
  const double h = dot(n, ap);
  return h * h / squaredNorm(n);
}

GuardedOperations::GuardedOperations(TetComplex& complex, SizingFunction scale, const Envelope& guards)
  : m_Complex(complex), m_Scale(std::move(scale)), m_MeanSquareLimit(guards.rmsLimit * guards.rmsLimit),
    m_SquaredToleranceFactor(guards.toleranceFactor * guards.toleranceFactor), m_TriangleWeight(guards.triangleWeight), m_VertexDistance(guards.vertexDistance),
    m_SquaredSeparatedFactor(guards.separatedFactor * guards.separatedFactor)
{
}

double GuardedOperations::quality(std::int32_t t) const
{
  const auto& c = m_Complex;
  double result = lenient(t, c.quality(t));
  if (m_TriangleWeight == 0 || !c.mayHaveInterface(t)) return result;
  const auto corner = [&](int i) { return c.points[c.tets[t][i & 3]]; };
  for (int i = 0; i < 4; ++i)
    if (c.neighbours[t][i] > t && c.isInterface(t, i))
      result = std::min(result, m_TriangleWeight * smallestSine2(corner(i + 1), corner(i + 2), corner(i + 3)));
  return result;
}

const std::vector<std::int32_t>& GuardedOperations::starOf(std::int32_t v, Star& star)
{
  if (star.vertex != v)
  {
    m_Complex.star(v, star.tets);
    star.vertex = v;
    star.isMeasured = false;
  }
  return star.tets;
}

StarQuality& GuardedOperations::measured(std::int32_t v, Star& star)
{
  starOf(v, star);
  if (!star.isMeasured) star.quality.gather(m_Complex, v, star.tets, m_TriangleWeight);
  star.isMeasured = true;
  return star.quality;
}

const std::vector<GuardedOperations::Neighbour>& GuardedOperations::neighbours(std::int32_t v)
{
  if (m_NeighboursVertex == v) return m_Neighbours;
  m_NeighboursVertex = v;
  m_Neighbours.clear();
  m_Seen.resize(m_Complex.points.size());
  ++m_Search;
  for (std::int32_t t : star(v))
    for (std::int32_t x : m_Complex.tets[t])
    {
      if (x == v) continue;
      Seen& seen = m_Seen[x];
      const Label label = m_Complex.labels[t];
      if (seen.search == m_Search)
      {
        if (label != seen.label) m_Neighbours[seen.at].alongInterface = true;
        continue;
      }
      seen = { m_Search, std::int32_t(m_Neighbours.size()), label };
      m_Neighbours.push_back({ x, false });
    }
  return m_Neighbours;
}

double GuardedOperations::worstQuality(const std::vector<std::int32_t>& tetrahedra) const
{
  double worst = std::numeric_limits<double>::max();
  for (std::int32_t t : tetrahedra) worst = std::min(worst, quality(t));
  return worst;
}

// --- samples -------------------------------------------------------------------------------------------------------

void GuardedOperations::clearSamples()
{
  m_Changed.clear();
  m_NewFaces.clear();
}

/// Takes note of the interface face (t, face), once.
void GuardedOperations::gather(std::int32_t t, int face)
{
  const auto holder = m_Complex.holder(t, face);
  const auto& known = m_Changed.faces;
  if (std::none_of(known.begin(), known.end(), [&](const SheetFace& f) { return f.holder == holder; }))
    m_Changed.addFace(m_Complex, t, face);
}

void GuardedOperations::addNewFace(const Vec3& a, const Vec3& b, const Vec3& c, const std::array<std::int32_t, 3>& ids,
                                   Label x, Label y, std::int32_t tet, int face, bool changes)
{
  Face f{ { a, b, c }, labelPair(x, y), ids, {}, {}, {}, tet, face, changes };
  const Vec3 n = cross(b - a, c - a);
  const double area2 = squaredNorm(n); // positive, as the tetrahedra on both sides are
  f.normal = n / std::sqrt(area2);
  f.slopes = { cross(n, c - b) / area2, cross(n, a - c) / area2, cross(n, b - a) / area2 };
  for (int k = 0; k < 3; ++k) f.heights[k] = 1 / squaredNorm(f.slopes[k]);
  m_NewFaces.push_back(f);
}

bool GuardedOperations::newFacesAreGood(double minimumQuality) const
{
  return m_TriangleWeight == 0 || std::all_of(m_NewFaces.begin(), m_NewFaces.end(),
                                              [&](const Face& f)
                                              {
                                                const auto& [a, b, c] = f.corners;
                                                return !f.changes ||
                                                       m_TriangleWeight * smallestSine2(a, b, c) >= minimumQuality;
                                              });
}

double GuardedOperations::squaredDistanceNow(const Sheet& sheet, const SheetSample& point)
{
  double& distance2 = m_Complex.samples[point.id].distance2;
  if (distance2 >= 0) return distance2;
  const auto corner = [&](int k) { return m_Complex.points[sheet.faces[point.from].vertices[k]]; };
  return distance2 = squaredDistanceToTriangle(point.position, corner(0), corner(1), corner(2));
}

/// Finds the point the nearest new face of its labels; false if there is none. Begins with the face that takes the place of
/// its own, if there is one, and beyond the line of a side the distance to that line bounds the distance to the face from
/// below: both spare most faces the full test.
bool GuardedOperations::nearestFace(const Sheet& sheet, SheetSample& point) const
{
  point.to = -1;
  point.distance2 = std::numeric_limits<double>::max();
  const LabelPair labels = sheet.faces[point.from].labels;
  const std::size_t count = m_NewFaces.size();
  std::size_t k = std::size_t(point.from) < count ? std::size_t(point.from) : 0;
  for (std::size_t n = 0; n < count; ++n, k = k + 1 < count ? k + 1 : 0)
  {
    const Face& f = m_NewFaces[k];
    if (f.labels != labels) continue;
    const Vec3 d = point.position - f.corners[0];
    const double height = dot(f.normal, d);
    double d2 = height * height;
    if (d2 >= point.distance2) continue;
    const double second = dot(f.slopes[1], d), third = dot(f.slopes[2], d), first = 1 - second - third;
    double beyond = 0;
    if (first < 0) beyond = std::max(beyond, first * first * f.heights[0]);
    if (second < 0) beyond = std::max(beyond, second * second * f.heights[1]);
    if (third < 0) beyond = std::max(beyond, third * third * f.heights[2]);
    if (d2 + beyond >= point.distance2) continue;
    if (beyond > 0) d2 = squaredDistanceToTriangle(point.position, f.corners[0], f.corners[1], f.corners[2]);
    if (d2 < point.distance2) point.distance2 = d2, point.to = std::int32_t(k);
  }
  return point.to >= 0;
}

/// From a point to the new boundary of either of its labels, the greater distance. To that of background that has vanished
/// there is none to keep.
double GuardedOperations::squaredDistanceToBoth(const Sheet& sheet, const SheetSample& point) const
{
  constexpr double none = std::numeric_limits<double>::max();
  const auto toBoundary = [&](Label label)
  {
    double least = none;
    for (const Face& f : m_NewFaces)
      if (has(f.labels, label))
        least = std::min(least, squaredDistanceToTriangle(point.position, f.corners[0], f.corners[1], f.corners[2]));
    return least == none && label == 0 ? 0 : least;
  };
  const LabelPair labels = sheet.faces[point.from].labels;
  return std::max(toBoundary(Label(labels)), toBoundary(Label(labels >> 16)));
}

/// Assigns a point to the nearest new face of its labels; false if it would lie beyond its tolerance and farther than it does
/// now. Where others come between two labels, see Envelope::separatedFactor; where these cease to touch, their points are let go if the
/// boundary of either stays within tolerance.
bool GuardedOperations::pointStays(const Sheet& sheet, SheetSample& point)
{
  const double tolerance2 = m_SquaredToleranceFactor * point.tolerance2;
  const bool kept = nearestFace(sheet, point);
  if (point.distance2 <= std::max(tolerance2, m_LeastTolerance2)) return true;
  if (kept && point.distance2 <= squaredDistanceNow(sheet, point) * (1 + 1e-9)) return true;
  if (kept && point.distance2 > m_SquaredSeparatedFactor * tolerance2) return false;
  return squaredDistanceToBoth(sheet, point) <= tolerance2;
}

/// Whether the mean square of the points' distances, in units of the tolerance, is within the limit or does not grow.
bool GuardedOperations::meanSquareStays(const Sheet& sheet)
{
  double sum = 0;
  for (const SheetSample& point : sheet.points)
    sum += std::min(1.0, point.distance2 / (m_SquaredToleranceFactor * point.tolerance2));
  if (sum <= m_MeanSquareLimit * double(sheet.points.size())) return true;
  double before = 0;
  for (const SheetSample& point : sheet.points)
    before += std::min(1.0, squaredDistanceNow(sheet, point) / (m_SquaredToleranceFactor * point.tolerance2));
  return sum <= before * (1 + 1e-9);
}

bool GuardedOperations::samplesStay(Sheet& sheet)
{
  return std::all_of(sheet.points.begin(), sheet.points.end(),
                     [&](SheetSample& point) { return pointStays(sheet, point); }) &&
         meanSquareStays(sheet);
}

/// The same for the faces gathered: their points are fetched as they are needed, for most refusals come early.
bool GuardedOperations::changedSamplesStay()
{
  for (std::size_t k = 0; k < m_Changed.faces.size(); ++k)
  {
    std::size_t i = m_Changed.points.size();
    m_Changed.addPoints(m_Complex, k);
    for (; i < m_Changed.points.size(); ++i)
      if (!pointStays(m_Changed, m_Changed.points[i])) return false;
  }
  return meanSquareStays(m_Changed);
}

/// After samplesStay: whether at most this share would be left of the squared distances, in units of the tolerance, of the
/// points to the faces and of the faces to the points. A face that stands off all samples has none of its own to say so.
bool GuardedOperations::comesNearer(const Sheet& sheet, double mostLeft)
{
  if (sheet.points.empty()) return false;
  double before = 0, after = 0;
  for (const SheetSample& point : sheet.points)
  {
    before += squaredDistanceNow(sheet, point) / point.tolerance2;
    after += (point.to < 0 ? squaredDistanceToBoth(sheet, point) : point.distance2) / point.tolerance2;
  }
  FacesOff now, then;
  for (const SheetFace& f : sheet.faces)
  {
    const auto corner = [&](int k) { return m_Complex.points[f.vertices[k]]; };
    now.add(sheet, corner(0), corner(1), corner(2));
  }
  for (const Face& f : m_NewFaces) then.add(sheet, f.corners[0], f.corners[1], f.corners[2]);
  const double pointsPerArea = double(sheet.points.size()) / std::max(now.area, then.area);
  return after + pointsPerArea * then.sum < mostLeft * (before + pointsPerArea * now.sum);
}

void GuardedOperations::detachSamples(const Sheet& sheet)
{
  for (const SheetFace& f : sheet.faces) m_Complex.sampleHeads[f.holder.first][f.holder.second] = -1;
}

/// Hands the points to the holders of their new faces. Backwards, so that lists keep their order when nothing else changes.
void GuardedOperations::attach(const std::vector<SheetSample>& points,
                               const std::vector<std::pair<std::int32_t, int>>& holders)
{
  for (auto point = points.rbegin(); point != points.rend(); ++point)
  {
    if (point->to < 0) continue;
    const auto [t, i] = holders[point->to];
    m_Complex.samples[point->id].distance2 = point->distance2;
    m_Complex.samples[point->id].next = m_Complex.sampleHeads[t][i];
    m_Complex.sampleHeads[t][i] = point->id;
  }
}

/// Hands the points that an operation has changed to their new faces, each found among the tetrahedra `around`.
void GuardedOperations::attachSamples(const std::vector<std::int32_t>& around)
{
  if (m_Changed.points.empty()) return;
  m_Holders.assign(m_NewFaces.size(), { -1, 0 });
  for (std::size_t k = 0; k < m_NewFaces.size(); ++k)
    if (m_NewFaces[k].tet >= 0) m_Holders[k] = m_Complex.holder(m_NewFaces[k].tet, m_NewFaces[k].face);
  for (std::int32_t t : around)
  {
    if (!m_Complex.alive(t)) continue;
    for (int i = 0; i < 4; ++i)
    {
      if (!m_Complex.isInterface(t, i)) continue;
      for (std::size_t k = 0; k < m_NewFaces.size(); ++k)
      {
        if (m_Holders[k].first >= 0) continue;
        const auto& ids = m_NewFaces[k].vertices;
        const auto& v = m_Complex.tets[t];
        if (v[i] == ids[0] || v[i] == ids[1] || v[i] == ids[2]) continue;
        if (m_Complex.contains(t, ids[0]) && m_Complex.contains(t, ids[1]) && m_Complex.contains(t, ids[2]))
          m_Holders[k] = m_Complex.holder(t, i);
      }
    }
  }
  attach(m_Changed.points, m_Holders);
}

// --- edge collapse --------------------------------------------------------------------------------------------------

bool GuardedOperations::meetsLabels(const std::vector<std::int32_t>& star) const
{
  const auto& labels = m_Complex.labels;
  return std::any_of(star.begin(), star.end(), [&](std::int32_t t) { return labels[t] != labels[star.front()]; });
}

/// One of 30 bits for each label that keepsTissues meets, or a last one for all the others.
std::uint32_t GuardedOperations::bitOf(Label label)
{
  const auto at = std::find(m_LocalLabels.begin(), m_LocalLabels.end(), label);
  const auto k = std::size_t(at - m_LocalLabels.begin());
  if (at == m_LocalLabels.end()) m_LocalLabels.push_back(label);
  return 1u << std::min<std::size_t>(k, mostLocalLabels);
}

/// The labels of an end's star that are not at the edge's other end; and which of them are at each vertex of the ring, which
/// m_Places numbers.
std::uint32_t GuardedOperations::lookAround(const std::vector<std::int32_t>& star, std::int32_t other,
                                            std::uint32_t RingLabels::*atEnd)
{
  std::uint32_t beside = 0;
  for (std::int32_t t : star)
  {
    const std::uint32_t bit = bitOf(m_Complex.labels[t]);
    bool isAtOther = false;
    for (std::int32_t x : m_Complex.tets[t])
    {
      isAtOther |= x == other;
      if (const Place& place = m_Places[x]; place.search == m_Search) m_RingLabels[place.at].*atEnd |= bit;
    }
    if (!isAtOther) beside |= bit;
  }
  return beside;
}

/// The label, as a bit, that closes over tetrahedron t of the ring of uv once that is gone: the one beyond both its faces; 0
/// if they are two, or t's own.
std::uint32_t GuardedOperations::closingOver(std::int32_t t, std::int32_t u, std::int32_t v)
{
  const auto& c = m_Complex;
  const std::int32_t nu = c.neighbours[t][c.indexOf(t, v)], nv = c.neighbours[t][c.indexOf(t, u)];
  if (nu < 0 || nv < 0 || c.labels[nu] != c.labels[nv] || c.labels[nu] == c.labels[t]) return 0;
  return bitOf(c.labels[nu]);
}

/// Whether `label` has a disc on the boundary of star(u) and star(v) together: connected, and of Euler number 1.
bool GuardedOperations::hasDisc(Label label, std::int32_t u, std::int32_t v) const
{
  const auto& c = m_Complex;
  std::vector<std::int32_t> corners;
  std::vector<std::pair<std::array<std::int32_t, 2>, std::int32_t>> sides; // and their triangles' numbers
  std::int32_t triangles = 0;
  const auto add = [&](const std::vector<std::int32_t>& star, std::int32_t centre, std::int32_t other)
  {
    for (std::int32_t t : star)
    {
      if (c.labels[t] != label || c.contains(t, other)) continue;
      std::array<std::int32_t, 3> x;
      std::remove_copy(c.tets[t].begin(), c.tets[t].end(), x.begin(), centre);
      std::sort(x.begin(), x.end());
      corners.insert(corners.end(), x.begin(), x.end());
      for (const auto& side : { std::array{ x[0], x[1] }, { x[0], x[2] }, { x[1], x[2] } })
        sides.push_back({ side, triangles });
      ++triangles;
    }
  };
  add(m_Star.tets, u, v);
  add(m_StarOfV.tets, v, u);
  std::sort(corners.begin(), corners.end());
  std::sort(sides.begin(), sides.end());
  const auto points = std::int32_t(std::unique(corners.begin(), corners.end()) - corners.begin());
  std::int32_t shared = 0, components = triangles;
  UnionFind connected(triangles);
  for (std::size_t i = 1; i < sides.size(); ++i)
  {
    if (sides[i].first != sides[i - 1].first) continue;
    ++shared;
    components -= connected.unite(sides[i].second, sides[i - 1].second);
  }
  return components == 1 && points - (3 * triangles - shared) + triangles == 1;
}

/// Whether merging u into v leaves every label its topology and a manifold boundary. A label that is at both is cut out of
/// the ball of both stars and comes back as the cone over its share of the ball's boundary, which changes nothing if what
/// was there was contractible and that share is a disc:
///   - The stars meet in the ring of uv. Those of its vertices and edges at which both have the label, be it in the ring
///     or beyond, must be a path.
///   - The share is a disc for certain if the label is not at edge uv, or closes over nothing and meets the link condition
///     (Dey, Edelsbrunner, Guha, Nekhayev 1999) on its own boundary; else it is looked at.
/// Background that has no more than the ring of uv is enclosed by tissues, and may vanish: it is no tissue.
/// Positive volumes see to the link condition on the tetrahedra themselves: the cone from v tiles star(u) only if it holds.
bool GuardedOperations::keepsTissues(std::int32_t u, std::int32_t v)
{
  const auto& c = m_Complex;
  const std::size_t n = m_Ring.size();
  m_LocalLabels.clear();
  std::uint32_t onEdge = 0;
  for (std::int32_t t : m_Ring) onEdge |= bitOf(c.labels[t]);
  if (bitCount(onEdge) < 2) return false;
  m_RingLabels.assign(n, {});
  m_Places.resize(c.points.size());
  ++m_Search;
  for (std::size_t i = 0; i < n; ++i) m_Places[m_RingVertices[i]] = { m_Search, std::int32_t(i) };
  const std::uint32_t besideU = lookAround(m_Star.tets, v, &RingLabels::atU);
  const std::uint32_t besideV = lookAround(m_StarOfV.tets, u, &RingLabels::atV);
  const std::uint32_t lost = onEdge & ~(besideU | besideV);
  if (m_LocalLabels.size() > mostLocalLabels || (lost != 0 && lost != bitOf(0))) return false;

  std::uint32_t doubtful = 0, closed = 0;
  for (std::size_t i = 0; i < n; ++i)
  {
    auto& [atU, atV, atEdge] = m_RingLabels[i];
    const std::int32_t before = m_Ring[(i + n - 1) % n], after = m_Ring[i];
    const std::uint32_t own = bitOf(c.labels[after]), closing = closingOver(after, u, v);
    atEdge = own | closing;
    closed |= closing;
    if (c.labels[before] == c.labels[after] && bitCount(atU) > 1 && bitCount(atV) > 1) doubtful |= own;
  }
  doubtful |= closed & onEdge;
  m_RingLosesLabels = (doubtful | closed | lost) != 0;
  const std::uint32_t common = (besideU | onEdge) & (besideV | onEdge) & ~lost;
  for (std::size_t k = 0; common >> k != 0; ++k)
  {
    if (!(common >> k & 1)) continue;
    std::uint32_t vertices = 0, edges = 0;
    for (const auto& [atU, atV, atEdge] : m_RingLabels) vertices += (atU & atV) >> k & 1, edges += atEdge >> k & 1;
    if (edges == 0 || vertices != edges + 1) return false;
    if (doubtful >> k & 1 && !hasDisc(m_LocalLabels[k], u, v)) return false;
  }
  return true;
}

/// Whether the edge from `end` to x, once it leads from v at p, is short enough, or no longer than now.
bool GuardedOperations::keepsLength(std::int32_t end, std::int32_t x, std::int32_t v, const Vec3& p,
                                    double maximumRatio) const
{
  const auto& c = m_Complex;
  const double limit = maximumRatio * c.targetLength(x, v);
  const double length2 = squaredNorm(c.points[x] - p);
  return length2 <= limit * limit || length2 <= squaredNorm(c.points[x] - c.points[end]);
}

/// Gathers the samples of the interface faces at u and at v and finds it new faces; false if one point is left too far.
bool GuardedOperations::collapseKeepsSamples(std::int32_t u, std::int32_t v, const Vec3& p)
{
  const auto& c = m_Complex;
  clearSamples();
  // Each face as it will be in a tetrahedron that stays: `stays`, opposite its vertex number `opposite`.
  const auto addMoved = [&](std::int32_t t, int face, Label x, Label y, std::int32_t stays, int opposite, bool changing)
  {
    std::array<std::int32_t, 3> ids{ c.tets[t][(face + 1) & 3], c.tets[t][(face + 2) & 3], c.tets[t][(face + 3) & 3] };
    Vec3 corners[3];
    for (int k = 0; k < 3; ++k)
    {
      if (ids[k] == u) ids[k] = v;
      corners[k] = ids[k] == v ? p : c.points[ids[k]];
    }
    addNewFace(corners[0], corners[1], corners[2], ids, x, y, stays, opposite, changing);
  };
  const auto facesAt = [&](std::int32_t end, std::int32_t other, const std::vector<std::int32_t>& star, bool changing)
  {
    for (std::int32_t t : star)
    {
      if (c.contains(t, other)) continue;
      for (int i = 0; i < 4; ++i)
      {
        const std::int32_t n = c.neighbours[t][i];
        if (c.tets[t][i] == end || n < 0 || c.labels[n] == c.labels[t]) continue;
        if (c.contains(n, other)) continue; // dealt with from the ring
        if (n < t) continue;
        if (changing) gather(t, i);
        addMoved(t, i, c.labels[t], c.labels[n], t, i, changing);
      }
    }
  };
  facesAt(u, v, m_Star.tets, true);
  // Faces at v that stay as they are keep their points, and may take others.
  facesAt(v, u, m_StarOfV.tets, !(p == c.points[v]));
  for (std::int32_t t : m_Ring)
  {
    const int iu = c.indexOf(t, u), iv = c.indexOf(t, v);
    for (int i = 0; i < 4; ++i)
      if (c.neighbours[t][i] >= 0 && c.isInterface(t, i)) gather(t, i);
    const std::int32_t nu = c.neighbours[t][iv], nv = c.neighbours[t][iu];
    if (nu < 0 || nv < 0) return false;
    if (c.labels[nu] == c.labels[nv]) continue;
    int opposite = 0;
    while (c.neighbours[nu][opposite] != t) ++opposite;
    addMoved(t, iu, c.labels[nu], c.labels[nv], nu, opposite, true);
  }
  return changedSamplesStay();
}

double GuardedOperations::qualityAfterCollapse(std::int32_t u, std::int32_t v, const Vec3& p, double atLeast,
                                               double maximumRatio)
{
  constexpr double tooLong = std::numeric_limits<double>::lowest();
  for (const Neighbour& n : neighbours(u))
    if (n.vertex != v && !keepsLength(u, n.vertex, v, p, maximumRatio)) return tooLong;
  const double worst = measured(u).worst(p, atLeast, v);
  if (worst < atLeast || p == m_Complex.points[v]) return worst;
  for (std::int32_t t : starOfTarget(v))
    for (std::int32_t x : m_Complex.tets[t])
      if (x != u && x != v && !keepsLength(v, x, v, p, maximumRatio)) return tooLong;
  return std::min(worst, measured(v, m_StarOfV).worst(p, atLeast, u));
}

bool GuardedOperations::mayCollapse(std::int32_t u, std::int32_t v, bool moves) const
{
  const auto& c = m_Complex;
  if (c.locked[u]) return false;
  // The star of a locked vertex may show only some of its labels.
  return c.onInterface[u] ? c.onInterface[v] && !c.locked[v] : !moves || (!c.onInterface[v] && !c.locked[v]);
}

bool GuardedOperations::collapse(std::int32_t u, std::int32_t v, const Vec3& p, double minimumQuality,
                                 double maximumRatio)
{
  return mayCollapse(u, v, !(p == m_Complex.points[v])) &&
         qualityAfterCollapse(u, v, p, minimumQuality, maximumRatio) >= minimumQuality &&
         collapseWithin(u, v, p, minimumQuality);
}

bool GuardedOperations::collapseWithin(std::int32_t u, std::int32_t v, const Vec3& p, double minimumQuality)
{
  auto& c = m_Complex;
  const bool moves = !(p == c.points[v]), inside = !c.onInterface[u];
  const std::vector<std::int32_t>& star = this->star(u);
  if (!inside)
  {
    if (m_RefusedVertex != u) m_Refused.clear();
    m_RefusedVertex = u;
    if (std::find(m_Refused.begin(), m_Refused.end(), v) != m_Refused.end()) return false;
    starOfTarget(v);
    const auto seed = std::find_if(star.begin(), star.end(), [&](std::int32_t t) { return c.contains(t, v); });
    if (seed == star.end() || !c.ring(u, v, *seed, m_Ring, m_RingVertices) || !keepsTissues(u, v))
    {
      m_Refused.push_back(v);
      return false;
    }
    if (!collapseKeepsSamples(u, v, p) || !newFacesAreGood(minimumQuality) || spansGap(m_Changed, v, c.points[u]))
      return false;
    detachSamples(m_Changed);
  }
  c.collapse(u, v, star);
  changed();
  if (!inside && m_RingLosesLabels)
    for (std::int32_t x : m_RingVertices)
      if (!c.locked[x]) c.onInterface[x] = meetsLabels(this->star(x));
  if (moves)
  {
    c.points[v] = p;
    c.lengths[v] = m_Scale(p);
  }
  if (!inside) attachSamples();
  ++counts.collapses;
  return true;
}

// --- vertex move ----------------------------------------------------------------------------------------------------

const Sheet& GuardedOperations::sheet(std::int32_t v)
{
  if (m_SheetVertex != v) gatherSheet(m_Complex, v, star(v), m_SheetAt);
  m_SheetVertex = v;
  return m_SheetAt;
}

/// The faces of v's sheet as they would be with v at p.
void GuardedOperations::addMovedFaces(std::int32_t v, const Vec3& p)
{
  const auto& c = m_Complex;
  m_NewFaces.clear();
  for (const SheetFace& f : sheet(v).faces)
  {
    const auto at = [&](int k) { return f.vertices[k] == v ? p : c.points[f.vertices[k]]; };
    addNewFace(at(0), at(1), at(2), f.vertices, Label(f.labels), Label(f.labels >> 16), f.tet, f.face);
  }
}

/// Hands the points of the sheet of a vertex that has moved to their faces, and puts them in their order again.
void GuardedOperations::attachMoved()
{
  auto& [faces, points] = m_SheetAt;
  detachSamples(m_SheetAt);
  m_Holders.clear();
  for (const SheetFace& f : faces) m_Holders.push_back(f.holder);
  attach(points, m_Holders);
  for (SheetSample& point : points) point.from = point.to;
  std::stable_sort(points.begin(), points.end(),
                   [](const SheetSample& a, const SheetSample& b) { return a.from < b.from; });
}

std::optional<Vec3> GuardedOperations::nearestSample(std::int32_t v)
{
  const SheetSample* point = nearestPoint(sheet(v), m_Complex.points[v]).first;
  return point ? std::optional(point->position) : std::nullopt;
}

bool GuardedOperations::isSpike(std::int32_t v, double vertexDistance)
{
  const auto [point, distance2] = nearestPoint(sheet(v), m_Complex.points[v]);
  return point && distance2 > vertexDistance * vertexDistance * point->tolerance2;
}

bool GuardedOperations::growsSpike(std::int32_t v, const Vec3& p)
{
  if (m_VertexDistance == 0) return false;
  const auto [point, distance2] = nearestPoint(m_SheetAt, p);
  return point && distance2 > m_VertexDistance * m_VertexDistance * point->tolerance2 &&
         distance2 > nearestPoint(m_SheetAt, m_Complex.points[v]).second;
}

/// Whether the middle of an edge at v, longer than its target, would be out of vertexDistance of the samples of the new faces, and
/// farther than with v at `from`.
bool GuardedOperations::spansGap(const Sheet& sheet, std::int32_t v, const Vec3& from) const
{
  if (m_VertexDistance == 0) return false;
  for (const Face& f : m_NewFaces)
    for (int k = 0; k < 3; ++k)
    {
      const std::int32_t x = f.vertices[(k + 1) % 3];
      if (f.vertices[k] != v && x != v) continue;
      const Vec3 &a = f.corners[k], &b = f.corners[(k + 1) % 3];
      const double target = m_Complex.targetLength(f.vertices[k], x);
      if (squaredNorm(b - a) <= target * target) continue;
      const auto [point, distance2] = nearestPoint(sheet, 0.5 * (a + b));
      if (!point || distance2 <= m_VertexDistance * m_VertexDistance * point->tolerance2) continue;
      const Vec3 other = f.vertices[k] == v ? b : a;
      if (distance2 > nearestPoint(sheet, 0.5 * (from + other)).second) return true;
    }
  return false;
}

bool GuardedOperations::moveWithin(std::int32_t v, const Vec3& p)
{
  if (m_Complex.onInterface[v])
  {
    addMovedFaces(v, p);
    if (!samplesStay(m_SheetAt) || growsSpike(v, p) || spansGap(m_SheetAt, v, m_Complex.points[v])) return false;
    attachMoved();
  }
  place(v, p);
  ++counts.moves;
  return true;
}

/// Hands the samples of v's faces to the nearest of them as they are with v at p, however far.
void GuardedOperations::handToNearest(std::int32_t v, const Vec3& p)
{
  addMovedFaces(v, p);
  for (SheetSample& point : m_SheetAt.points) nearestFace(m_SheetAt, point);
  attachMoved();
}

void GuardedOperations::moveBack(std::int32_t v, const Vec3& p)
{
  if (m_Complex.onInterface[v]) handToNearest(v, p);
  place(v, p);
  --counts.moves;
}

void GuardedOperations::bringHome(std::int32_t v)
{
  if (!m_Complex.onInterface[v]) return;
  const Sheet& now = sheet(v);
  const auto isLost = [&](const SheetSample& point)
  { return squaredDistanceNow(now, point) > m_SquaredToleranceFactor * point.tolerance2; };
  if (std::none_of(now.points.begin(), now.points.end(), isLost)) return;
  handToNearest(v, m_Complex.points[v]);
}

void GuardedOperations::place(std::int32_t v, const Vec3& p)
{
  m_Complex.points[v] = p;
  m_Complex.lengths[v] = m_Scale(p);
  for (Star* star : { &m_Star, &m_StarOfV })
    if (star->vertex != v) star->isMeasured = false;
}

// --- edge removal ---------------------------------------------------------------------------------------------------

bool GuardedOperations::removeEdge(std::int32_t a, std::int32_t b, std::int32_t seed, double minimumQuality)
{
  auto& c = m_Complex;
  if (!c.ring(a, b, seed, m_Ring, m_RingVertices)) return false;
  const int n = int(m_Ring.size());
  if (n < 3 || n > maximumRing) return false;

  int cuts[2] = { 0, 0 }, changes = 0;
  for (int i = 0; i < n; ++i)
    if (c.labels[m_Ring[i]] != c.labels[m_Ring[(i + n - 1) % n]])
    {
      if (changes == 2) return false;
      cuts[changes++] = i;
    }
  // Rotate so that the ring begins at a cut: one polygon inside a label, two on the sheet between two labels.
  const int first = changes ? cuts[0] : 0, second = changes ? cuts[1] - cuts[0] : n;
  std::rotate(m_Ring.begin(), m_Ring.begin() + first, m_Ring.end());
  std::rotate(m_RingVertices.begin(), m_RingVertices.begin() + first, m_RingVertices.end());
  if (changes && (second < 2 || n - second < 2)) return false;

  const Vec3 pa = c.points[a], pb = c.points[b];
  const auto at = [&](int i) { return c.points[m_RingVertices[i % n]]; };
  std::vector<TetComplex::Tet> fresh;
  std::vector<Label> labels;
  double best[maximumRing + 1][maximumRing + 1];
  int choice[maximumRing + 1][maximumRing + 1];
  const auto triangulate = [&](int from, int to) // the polygon from, from + 1, ..., to
  {
    constexpr double none = -1; // all triangulations are flat or wound negatively: no better than what may be there
    const Label label = c.labels[m_Ring[from]];
    for (int i = from; i < to; ++i) best[i - from][i + 1 - from] = std::numeric_limits<double>::max();
    for (int gap = 2; gap <= to - from; ++gap)
      for (int i = from; i + gap <= to; ++i)
      {
        const int k = i + gap;
        double& value = best[i - from][k - from];
        value = none;
        for (int j = i + 1; j < k; ++j)
        {
          double q = std::min(best[i - from][j - from], best[j - from][k - from]);
          if (q <= value || q < minimumQuality) continue;
          q = std::min(q, lenient(label, worstSine2(at(i), at(j), at(k), pb)));
          if (q <= value || q < minimumQuality) continue;
          q = std::min(q, lenient(label, worstSine2(at(i), at(k), at(j), pa)));
          if (q > value) value = q, choice[i - from][k - from] = j;
        }
        if (gap == to - from && (value == none || value < minimumQuality)) return false;
      }
    const std::function<void(int, int)> emit = [&](int i, int k)
    {
      if (k - i < 2) return;
      const int j = choice[i - from][k - from];
      const std::int32_t vi = m_RingVertices[i % n], vj = m_RingVertices[j % n], vk = m_RingVertices[k % n];
      fresh.push_back({ vi, vj, vk, b });
      fresh.push_back({ vi, vk, vj, a });
      labels.insert(labels.end(), 2, label);
      emit(i, j);
      emit(j, k);
    };
    emit(from, to);
    return true;
  };

  clearSamples();
  if (!changes)
  {
    if (!triangulate(0, n - 1)) return false;
  }
  else
  {
    if (!triangulate(0, second) || !triangulate(second, n)) return false;
    for (int i : { 0, second })
      for (int k = 0; k < 4; ++k)
      {
        const std::int32_t t = m_Ring[i];
        if (c.neighbours[t][k] == m_Ring[(i + n - 1) % n]) gather(t, k);
      }
    const std::int32_t p = m_RingVertices[0], q = m_RingVertices[second];
    for (std::int32_t end : { a, b })
      addNewFace(c.points[end], c.points[p], c.points[q], { end, p, q }, c.labels[m_Ring[0]], c.labels[m_Ring[second]]);
    if (!newFacesAreGood(minimumQuality) || !changedSamplesStay()) return false;
    detachSamples(m_Changed);
  }
  const auto ids = c.replace(m_Ring, fresh, labels);
  changed();
  attachSamples(ids);
  ++counts.flips;
  return true;
}

// --- edge split -----------------------------------------------------------------------------------------------------

bool GuardedOperations::split(std::int32_t a, std::int32_t b, std::int32_t seed, const Vec3& p, double minimumQuality)
{
  auto& c = m_Complex;
  if (!c.ring(a, b, seed, m_Ring, m_RingVertices)) return false;
  for (std::int32_t t : m_Ring)
    if (lenient(t, c.qualityWith(t, a, p)) < minimumQuality || lenient(t, c.qualityWith(t, b, p)) < minimumQuality)
      return false;
  clearSamples();
  const std::int32_t m = std::int32_t(c.points.size()); // the new vertex's id, if it comes to be
  const std::size_t n = m_Ring.size();
  for (std::size_t i = 0; i < n; ++i)
  {
    const std::int32_t t = m_Ring[i], before = m_Ring[(i + n - 1) % n], x = m_RingVertices[i];
    if (c.labels[t] == c.labels[before]) continue;
    for (int k = 0; k < 4; ++k)
      if (c.neighbours[t][k] == before) gather(t, k);
    for (std::int32_t end : { a, b })
      addNewFace(c.points[end], p, c.points[x], { end, m, x }, c.labels[t], c.labels[before]);
  }
  if (!newFacesAreGood(minimumQuality) || !changedSamplesStay()) return false;
  detachSamples(m_Changed);
  c.addVertex(p, m_Scale(p), !m_NewFaces.empty());
  std::vector<TetComplex::Tet> fresh;
  std::vector<Label> labels;
  for (std::int32_t t : m_Ring)
    for (std::int32_t end : { a, b })
    {
      auto x = c.tets[t];
      x[c.indexOf(t, end)] = m;
      fresh.push_back(x);
      labels.push_back(c.labels[t]);
    }
  const auto ids = c.replace(m_Ring, fresh, labels);
  changed();
  attachSamples(ids);
  lastSplitVertex = m;
  ++counts.splits;
  return true;
}

void GuardedOperations::takeBackSplit(std::int32_t v, std::int32_t a)
{
  const double stray2 = m_LeastTolerance2, limit = m_MeanSquareLimit, vertexDistance = m_VertexDistance;
  m_LeastTolerance2 = m_MeanSquareLimit = std::numeric_limits<double>::max(); // it was so before
  m_VertexDistance = 0;
  const bool done = collapseWithin(v, a, m_Complex.points[a], 0);
  m_LeastTolerance2 = stray2;
  m_MeanSquareLimit = limit;
  m_VertexDistance = vertexDistance;
  assert(done);
  counts.collapses -= done;
  counts.splits -= done;
}

// --- relabelling ----------------------------------------------------------------------------------------------------

/// Whether t can leave `label`, or go over to it, without a change of that label's topology: what has the label and what has
/// not each meet t in one to three of its faces, and besides at these faces' edges and corners only. A last tetrahedron of
/// background among tissues may also go.
bool GuardedOperations::isSimple(std::int32_t t, Label label)
{
  const auto& c = m_Complex;
  std::array<int, 4> corners{}; // opposite what has the label, and from the end opposite what has not
  int shared = 0, rest = 4;
  for (int i = 0; i < 4; ++i) corners[c.labels[c.neighbours[t][i]] == label ? shared++ : --rest] = i;
  const auto meets = [&](int k, int l, bool has) // at that corner, or at the edge between two
  {
    const std::int32_t v = c.tets[t][corners[k]], w = c.tets[t][corners[l]];
    const auto& star = this->star(v);
    return std::any_of(star.begin(), star.end(),
                       [&](std::int32_t s) { return s != t && (c.labels[s] == label) == has && c.contains(s, w); });
  };
  if (shared == 0) return label == 0;
  if (shared == 1) return !meets(0, 0, true);
  if (shared == 3) return !meets(3, 3, false);
  return shared == 2 && !meets(0, 1, true) && !meets(2, 3, false);
}

/// Whether a corner of t, inside a label so far, would lie between two out of vertexDistance of the samples.
bool GuardedOperations::laysBare(std::int32_t t) const
{
  if (m_VertexDistance == 0) return false;
  for (const std::int32_t v : m_Complex.tets[t])
  {
    if (m_Complex.onInterface[v]) continue;
    const auto [point, distance2] = nearestPoint(m_Changed, m_Complex.points[v]);
    if (!point || distance2 > m_VertexDistance * m_VertexDistance * point->tolerance2) return true;
  }
  return false;
}

bool GuardedOperations::relabel(std::int32_t t, Label label, double minimumQuality, double mostLeft)
{
  auto& c = m_Complex;
  const TetComplex::Tet x = c.tets[t];
  const Label own = c.labels[t];
  if (label == own || lenient(label, c.quality(t)) < minimumQuality) return false;
  for (int i = 0; i < 4; ++i)
    if (c.neighbours[t][i] < 0 || c.locked[x[i]]) return false;
  if (!isSimple(t, own) || !isSimple(t, label)) return false;
  clearSamples();
  for (int i = 0; i < 4; ++i)
  {
    const Label beyond = c.labels[c.neighbours[t][i]];
    const std::array<std::int32_t, 3> ids{ x[(i + 1) & 3], x[(i + 2) & 3], x[(i + 3) & 3] };
    if (beyond != own) gather(t, i);
    if (beyond != label) addNewFace(c.points[ids[0]], c.points[ids[1]], c.points[ids[2]], ids, beyond, label);
  }
  if (!newFacesAreGood(minimumQuality) || !changedSamplesStay()) return false;
  if (mostLeft < anyShare && !comesNearer(m_Changed, mostLeft)) return false;
  if (laysBare(t)) return false;
  detachSamples(m_Changed);
  c.labels[t] = label;
  changed();
  for (std::int32_t v : x) c.onInterface[v] = meetsLabels(star(v));
  attachSamples({ t });
  ++counts.relabels;
  return true;
}

} // namespace surgicalmesher
