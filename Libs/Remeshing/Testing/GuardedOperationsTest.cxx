// SPDX-License-Identifier: Apache-2.0
#include "GuardedOperations.h"
#include "ComplexInvariants.h"
#include "MeshQuality.h"
#include "RandomMaps.h"
#include "Triangle.h"

#include <gtest/gtest.h>

#include <functional>
#include <set>

namespace surgicalmesher
{
namespace
{

using namespace test;

const SizingFunction unitScale = [](const Vec3&) { return 1.0f; };

/// No guard but those on topology and on positive volumes.
constexpr double anyQuality = 1e-8, anyLength = 1e6, anyDistance = 1e6;
constexpr double separatedFactor = 2; // see EnvelopeBounds

std::map<Label, Betti> topologyOf(const TetComplex& complex)
{
  return meshTopology(withBackgroundAsTissue(meshOf(complex)));
}

/// Whether every tissue's topology is the same. Of the background, pieces that tissues enclose may have gone.
bool isKept(const std::map<Label, Betti>& before, std::map<Label, Betti> after)
{
  constexpr Label background = 65535;
  Betti& then = after[background];
  const int pieces = before.at(background).components;
  if (then.components > pieces) return false;
  then.components = pieces;
  return after == before;
}

int backgroundPieces(const TetComplex& c)
{
  std::vector<std::uint8_t> seen(c.tets.size(), 0);
  std::vector<std::int32_t> open;
  int pieces = 0;
  for (std::int32_t first = 0; first < std::int32_t(c.tets.size()); ++first)
  {
    if (!c.alive(first) || c.labels[first] != 0 || seen[first]) continue;
    ++pieces;
    seen[first] = 1;
    for (open.push_back(first); !open.empty();)
    {
      const std::int32_t t = open.back();
      open.pop_back();
      for (std::int32_t n : c.neighbours[t])
        if (n >= 0 && c.labels[n] == 0 && !seen[n]) seen[n] = 1, open.push_back(n);
    }
  }
  return pieces;
}

void expectManifold(const TetComplex& complex)
{
  for (const auto& [label, tissue] : checkSurface(interfaceOf(withBackgroundAsTissue(meshOf(complex)))))
    EXPECT_TRUE(tissue.manifold()) << "label " << label;
}

/// An octahedron of four tetrahedra around its edge ab along x: a = 0, b = 1, p = 2 and q = 3 along y, top 4, bottom 5.
/// `labels` belong to the quarters (p, top), (top, q), (q, bottom), (bottom, p).
TetComplex octahedron(const std::array<Label, 4>& labels, float tolerance = 0.5f)
{
  TetMesh mesh;
  mesh.points = { { 1, 0, 0 }, { -1, 0, 0 }, { 0, 1, 0 }, { 0, -1, 0 }, { 0, 0, 1 }, { 0, 0, -1 } };
  mesh.tetrahedra = { { 0, 1, 2, 4 }, { 0, 1, 4, 3 }, { 0, 1, 3, 5 }, { 0, 1, 5, 2 } };
  for (auto& [a, b, c, d] : mesh.tetrahedra)
  {
    if (orient(mesh.points[a], mesh.points[b], mesh.points[c], mesh.points[d]) < 0) std::swap(c, d);
  }
  mesh.labels.assign(labels.begin(), labels.end());
  return complexOf(mesh, 1, tolerance);
}

/// The ends of the edge within the octahedron.
std::array<std::int32_t, 2> endsAlongX(const TetComplex& octahedron)
{
  std::array<std::int32_t, 2> ends{ -1, -1 };
  for (std::int32_t v = 0; v < 6; ++v)
  {
    if (octahedron.points[v].x > 0) ends[0] = v;
    if (octahedron.points[v].x < 0) ends[1] = v;
  }
  return ends;
}

TetComplex withoutSamples(const TetMesh& mesh)
{
  return TetComplex(mesh.points, std::vector<float>(mesh.points.size(), 1), mesh.tetrahedra, mesh.labels);
}

/// One operation somewhere, and what it was allowed to do.
struct Attempt
{
  bool done = false;
  double minimumQuality = 0;
  double maximumRatio = anyLength; ///< collapses
  std::int32_t u = -1, v = -1;     ///< collapses: u merged into v
  int backgroundPieces = 0;        ///< before
  std::string name;
};

/// Half of the time near the one before, where something has just changed.
Attempt attempt(GuardedOperations& operations, std::mt19937& random, const Attempt& last)
{
  TetComplex& c = operations.complex();
  const auto uniform = [&](double low, double high) { return low + (high - low) * (random() / 4294967296.0); };
  const auto nearby = [&](const Vec3& p, double vertexDistance)
  {
    return p + Vec3{ uniform(-vertexDistance, vertexDistance), uniform(-vertexDistance, vertexDistance),
                     uniform(-vertexDistance, vertexDistance) };
  };
  Attempt a;
  a.backgroundPieces = backgroundPieces(c);
  if (last.v >= 0 && c.vertexTet[last.v] >= 0 && random() % 2) a.u = last.v;
  while (a.u < 0 || c.vertexTet[a.u] < 0) a.u = std::int32_t(random() % c.points.size());
  const auto around = neighboursOf(c, a.u);
  a.v = around[random() % around.size()];
  a.minimumQuality = sine2OfDegrees(uniform(0.5, 15));
  const Vec3 from = c.points[a.u], to = c.points[a.v], middle = 0.5 * (from + to);
  const std::int32_t seed = tetrahedronAt(c, a.u, a.v);
  const auto kind = random() % 8;
  if (kind <= 1)
  {
    a.name = "collapse";
    a.maximumRatio = uniform(1, 4);
    const Vec3 p = random() % 2 ? to : random() % 2 ? middle : nearby(middle, 0.2);
    a.done = operations.collapse(a.u, a.v, p, a.minimumQuality, a.maximumRatio);
  }
  else if (kind == 2)
  {
    a.name = "move";
    a.done = operations.move(a.u, nearby(from, uniform(0.01, 0.4)), a.minimumQuality);
  }
  else if (kind == 3)
  {
    a.name = "removeEdge";
    a.done = operations.removeEdge(a.u, a.v, seed, a.minimumQuality);
  }
  else if (kind == 6 || kind == 7)
  {
    a.name = kind == 6 ? "swapEdge" : "removeLowEdge";
    std::vector<std::int32_t> ring, vertices;
    const double good = a.minimumQuality;
    if (c.ring(a.u, a.v, seed, ring, vertices)) a.minimumQuality = std::min(good, operations.worstQuality(ring));
    a.done = kind == 6 ? operations.swapEdge(a.u, a.v, seed, { good, 0.5, 1, 0.01 })
                       : operations.removeLowEdge(a.u, a.v, seed, good);
  }
  else if (kind == 4)
  {
    a.name = "relabel";
    const std::vector<std::int32_t> star = operations.star(a.u);
    for (std::size_t i = 0; i < star.size() && !a.done; ++i)
    {
      const std::int32_t n = c.neighbours[star[i]][random() % 4];
      a.done = n >= 0 && operations.relabel(star[i], c.labels[n], a.minimumQuality);
    }
  }
  else
  {
    a.name = "split";
    a.done =
      operations.split(a.u, a.v, seed, random() % 2 ? middle : nearby(middle, 0.1), a.minimumQuality).has_value();
  }
  return a;
}

constexpr double triangleWeight = 1;
using FaceVertices = std::array<std::int32_t, 3>;

/// Of every triangle between labels, by its vertices.
std::map<FaceVertices, std::array<Vec3, 3>> interfaceTriangles(const TetComplex& c)
{
  std::map<FaceVertices, std::array<Vec3, 3>> result;
  for (std::int32_t t = 0; t < std::int32_t(c.tets.size()); ++t)
    for (int i = 0; c.alive(t) && i < 4; ++i)
      if (c.neighbours[t][i] > t && c.isInterface(t, i))
      {
        const FaceVertices key = faceKey(c.tets[t], i);
        result[key] = { c.points[key[0]], c.points[key[1]], c.points[key[2]] };
      }
  return result;
}

std::set<FaceVertices> keysOf(const std::map<FaceVertices, std::array<Vec3, 3>>& triangles)
{
  std::set<FaceVertices> keys;
  for (const auto& triangle : triangles) keys.insert(triangle.first);
  return keys;
}

/// Every triangle between labels that is not as it was reaches the quality asked for.
void expectTriangleQuality(const std::map<FaceVertices, std::array<Vec3, 3>>& before, const TetComplex& c,
                           double minimumQuality)
{
  for (const auto& [key, p] : interfaceTriangles(c))
    if (const auto was = before.find(key); was == before.end() || !(was->second == p))
    {
      EXPECT_GE(triangleWeight * smallestSine2(p[0], p[1], p[2]), minimumQuality * (1 - 1e-9));
    }
}

/// Every tetrahedron that is not as it was reaches the quality asked for.
void expectQuality(const ComplexState& before, TetComplex& c, double minimumQuality)
{
  const GuardedOperations operations(c, [](const Vec3&) { return 1.0f; });
  for (std::int32_t t = 0; t < std::int32_t(c.tets.size()); ++t)
  {
    if (!c.alive(t)) continue;
    bool changed =
      std::size_t(t) >= before.tets.size() || before.tets[t] != c.tets[t] || before.labels[t] != c.labels[t];
    for (int k = 0; k < 4 && !changed; ++k) changed = !(before.points[c.tets[t][k]] == c.points[c.tets[t][k]]);
    EXPECT_TRUE(!changed || operations.quality(t) >= minimumQuality) << "tetrahedron " << t;
  }
}

/// A sample stays within its tolerance of faces of its label pair, or no farther than it was; or both labels
/// still have a boundary within the tolerance, if they have not vanished, and the pair faces within `separatedFactor`
/// times that, if any.
void expectSamplesKept(const std::vector<SamplePlace>& before, const TetComplex& c, bool backgroundVanished)
{
  const auto after = samplePlaces(c);
  for (std::size_t e = 0; e < before.size(); ++e)
  {
    if (before[e].tet < 0)
    {
      EXPECT_LT(after[e].tet, 0) << "samples " << e << " is back";
      continue;
    }
    const double tolerance = c.samples[e].tolerance;
    if (after[e].tet >= 0)
    {
      EXPECT_EQ(after[e].pair, before[e].pair) << "samples " << e;
      if (after[e].distance <= std::max(tolerance, before[e].distance) * (1 + 1e-6)) continue;
      EXPECT_LE(after[e].distance, separatedFactor * tolerance * (1 + 1e-6)) << "samples " << e;
    }
    for (Label label : before[e].pair)
    {
      if (label == 0 && backgroundVanished) continue;
      double nearest = anyDistance;
      for (std::int32_t t = 0; t < std::int32_t(c.tets.size()); ++t)
      {
        if (!c.alive(t) || c.labels[t] != label) continue;
        for (int i = 0; i < 4; ++i)
        {
          if (!c.isInterface(t, i)) continue;
          const auto [x, y, z] = faceKey(c.tets[t], i);
          const double d = squaredDistanceToTriangle(c.samples[e].position, c.points[x], c.points[y], c.points[z]);
          nearest = std::min(nearest, std::sqrt(d));
        }
      }
      EXPECT_LE(nearest, tolerance * (1 + 1e-6)) << "samples " << e << " of label " << label;
    }
  }
}

/// No edge at the merged vertex is too long, unless it was.
void expectLengths(const ComplexState& before, TetComplex& c, const Attempt& a)
{
  for (std::int32_t x : neighboursOf(c, a.v))
  {
    const double length = norm(c.points[x] - c.points[a.v]);
    const double was =
      std::max(norm(before.points[x] - before.points[a.u]), norm(before.points[x] - before.points[a.v]));
    EXPECT_LE(length, std::max(was, a.maximumRatio) * (1 + 1e-9));
  }
}

void expectGuarded(const ComplexState& before, const std::vector<SamplePlace>& places, GuardedOperations& operations,
                   const Attempt& a)
{
  TetComplex& c = operations.complex();
  if (!a.done)
  {
    EXPECT_TRUE(ComplexState(c) == before) << "refused, but changed something";
    return;
  }
  ASSERT_TRUE(isConsistent(c));
  expectQuality(before, c, a.minimumQuality);
  expectSamplesKept(places, c, backgroundPieces(c) < a.backgroundPieces);
  if (a.name == "collapse") expectLengths(before, c, a);
  for (std::size_t v = 0; v < before.points.size(); ++v)
  {
    if (!before.locked[v]) continue;
    EXPECT_TRUE(c.points[v] == before.points[v] && c.vertexTet[v] >= 0 && c.locked[v]) << "locked vertex " << v;
  }
}

long total(const OperationCounts& c) { return c.collapses + c.moves + c.flips + c.splits + c.relabels; }

/// What is known of vertices from before is true still: a dozen are asked about, over and over.
void expectKnownStars(GuardedOperations& operations, const EnvelopeBounds& bounds, std::mt19937& random)
{
  TetComplex& complex = operations.complex();
  GuardedOperations fresh(complex, unitScale, bounds);
  std::vector<std::int32_t> star;
  for (int n = 0; n < 3; ++n)
  {
    const auto v = std::int32_t(complex.points.size() / 2 + random() % 12);
    if (complex.vertexTet[v] < 0) continue;
    complex.star(v, star);
    EXPECT_EQ(operations.star(v), star);
    EXPECT_EQ(operations.qualityAt(v), fresh.qualityAt(v));
  }
}

} // namespace

/// Thousands of operations on random maps, legal and illegal ones.
class RandomOperations : public ::testing::TestWithParam<double>
{
};

TEST_P(RandomOperations, KeepEveryPromise)
{
  const double rmsLimit = GetParam();
  OperationCounts all;
  for (unsigned seed = 1; seed <= 8; ++seed)
  {
    std::mt19937 random(seed);
    const TissueMap map = randomWellComposedMap(random, { 4, 4, 4 }, 1 + int(seed % 4));
    TetComplex complex =
      complexOf(tetrahedraOf(map), 1, std::array<float, 3>{ 0.15f, 0.6f, float(anyDistance) }[seed % 3]);
    const EnvelopeBounds bounds{ rmsLimit, 1, seed % 2 ? triangleWeight : 0, 0, separatedFactor };
    GuardedOperations operations(complex, unitScale, bounds);
    const auto topology = topologyOf(complex);
    const double volume = volumeOf(meshOf(complex));
    const TetMesh start = meshOf(complex);
    long done = 0;
    Attempt last;
    for (int n = 0; n < 800; ++n)
    {
      const ComplexState before(complex);
      const auto places = samplePlaces(complex);
      const auto triangles = interfaceTriangles(complex);
      const OperationCounts counts = operations.counts();
      const Attempt a = attempt(operations, random, last);
      last = a;
      SCOPED_TRACE(a.name + " " + std::to_string(n) + " of seed " + std::to_string(seed));
      expectGuarded(before, places, operations, a);
      if (a.done && seed % 2) expectTriangleQuality(triangles, complex, a.minimumQuality);
      const OperationCounts now = operations.counts();
      EXPECT_EQ(total(now) - total(counts), a.done);
      if (a.name != "relabel" && a.name != "move")
      {
        const bool hasOtherTriangles = keysOf(triangles) != keysOf(interfaceTriangles(complex));
        EXPECT_EQ(now.t1 + now.t2 + now.t7 - counts.t1 - counts.t2 - counts.t7, hasOtherTriangles);
      }
      expectKnownStars(operations, bounds, random);
      if (a.done && ++done % 4 == 0)
      {
        EXPECT_TRUE(isKept(topology, topologyOf(complex)));
        expectManifold(complex);
        EXPECT_NEAR(volumeOf(meshOf(complex)), volume, 1e-9 * volume);
      }
      if (HasFailure()) return;
    }
    EXPECT_TRUE(isKept(topology, topologyOf(complex)));
    all.collapses += operations.counts().collapses;
    all.moves += operations.counts().moves;
    all.flips += operations.counts().flips;
    all.splits += operations.counts().splits;
    all.relabels += operations.counts().relabels;
    all.t1 += operations.counts().t1;
    all.t2 += operations.counts().t2;
    all.t7 += operations.counts().t7;
  }
  for (const auto& [ofInterface, ofAll] :
       { std::pair{ all.t1, all.collapses }, { all.t2, all.splits }, { all.t7, all.flips } })
  {
    EXPECT_GT(ofInterface, 0);
    EXPECT_LT(ofInterface, ofAll);
  }
  EXPECT_GT(all.collapses, 80);
  EXPECT_GT(all.moves, 80);
  EXPECT_GT(all.flips, 40);
  EXPECT_GT(all.splits, 80);
  EXPECT_GT(all.relabels, 80);
}

TEST(GuardedOperations, CountTrianglesBetweenLabelsAtTheirVertices)
{
  constexpr double weight = 0.3; // most triangles are worse than their tetrahedra then
  std::mt19937 random(1);
  TetComplex complex = complexOf(tetrahedraOf(randomWellComposedMap(random, { 4, 4, 4 }, 3)), 1, 0.6f);
  const auto triangles = interfaceTriangles(complex);
  GuardedOperations plain(complex, [](const Vec3&) { return 1.0f; });
  GuardedOperations weighted(complex, [](const Vec3&) { return 1.0f; }, { 0.5, 1, weight });
  long decisive = 0;
  for (std::int32_t v = 0; v < std::int32_t(complex.points.size()); ++v)
  {
    const double ofTetrahedra = plain.qualityAt(v);
    double expected = ofTetrahedra;
    for (const auto& [key, p] : triangles)
      if (std::find(key.begin(), key.end(), v) != key.end())
        expected = std::min(expected, weight * smallestSine2(p[0], p[1], p[2]));
    EXPECT_NEAR(weighted.qualityAt(v), expected, 1e-12) << "vertex " << v;
    decisive += expected < ofTetrahedra;
  }
  EXPECT_GT(decisive, 100);
}

TEST(GuardedOperations, RelabelBesideAThirdLabel)
{
  long done = 0;
  for (unsigned seed = 1; seed <= 4; ++seed)
  {
    std::mt19937 random(seed);
    TetComplex complex = complexOf(tetrahedraOf(randomWellComposedMap(random, { 4, 4, 4 }, 3)), 1, float(anyDistance));
    GuardedOperations operations(complex, [](const Vec3&) { return 1.0f; }, { anyDistance });
    const auto topology = topologyOf(complex);
    for (std::int32_t t = 0; t < std::int32_t(complex.tets.size()); ++t)
    {
      std::set<Label> beyond;
      for (const std::int32_t n : complex.neighbours[t]) beyond.insert(n < 0 ? Label(0) : complex.labels[n]);
      if (beyond.size() < 3 || !beyond.count(complex.labels[t])) continue;
      for (const Label label : beyond)
      {
        if (!operations.relabel(t, label, 0)) continue;
        ++done;
        EXPECT_EQ(complex.labels[t], label);
        EXPECT_TRUE(isKept(topology, topologyOf(complex)));
        expectManifold(complex);
        break;
      }
      if (HasFailure()) return;
    }
    ASSERT_TRUE(isConsistent(complex));
  }
  EXPECT_GT(done, 10);
}

TEST(GuardedOperations, MakeNoBackgroundInsideTissues)
{
  std::mt19937 random(1);
  TetComplex complex = complexOf(tetrahedraOf(randomWellComposedMap(random, { 4, 4, 4 }, 3)), 1, float(anyDistance));
  GuardedOperations operations(complex, [](const Vec3&) { return 1.0f; }, { anyDistance });
  long tried = 0;
  for (std::int32_t t = 0; t < std::int32_t(complex.tets.size()); ++t)
  {
    const auto& around = complex.neighbours[t];
    if (complex.labels[t] == 0 ||
        std::any_of(around.begin(), around.end(), [&](std::int32_t n) { return n < 0 || complex.labels[n] == 0; }))
      continue;
    ++tried;
    EXPECT_FALSE(operations.relabel(t, 0, 0)) << t;
  }
  EXPECT_GT(tried, 100);
}

TEST(GuardedOperations, LetNoVertexLeaveItsSamplesByMoreThanTheBound)
{
  constexpr double vertexDistance = 1.5;
  std::mt19937 random(1);
  TetComplex complex = complexOf(tetrahedraOf(randomWellComposedMap(random, { 4, 4, 4 }, 3)), 1, 0.6f);
  const auto uniform = [&] { return random() / 2147483648.0 - 1; };
  long done = 0, refused = 0;
  for (std::int32_t v = 0; v < std::int32_t(complex.points.size()); ++v)
  {
    if (complex.locked[v] || !complex.onInterface[v]) continue;
    GuardedOperations bounded(complex, [](const Vec3&) { return 1.0f; },
                              { anyDistance, anyDistance, 0, vertexDistance });
    const bool wasSpike = bounded.isSpike(v, vertexDistance);
    const Vec3 from = complex.points[v], to = from + Vec3{ uniform(), uniform(), uniform() };
    if (bounded.qualityAt(v, to, 0) < 0) continue;
    if (bounded.move(v, to, 0))
    {
      ++done;
      EXPECT_TRUE(wasSpike || !bounded.isSpike(v, vertexDistance)) << "vertex " << v;
    }
    else ++refused;
  }
  EXPECT_GT(done, 10);
  EXPECT_GT(refused, 0);
}

TEST(GuardedOperations, LetNoLongEdgeSpanAGapWiderThanTheBound)
{
  constexpr double vertexDistance = 0.9;
  constexpr float length = 0.8f, tolerance = 0.6f;
  const auto lengthAt = [=](const Vec3&) { return length; };
  std::mt19937 random(2);
  TetComplex complex = complexOf(tetrahedraOf(randomWellComposedMap(random, { 4, 4, 4 }, 3)), length, tolerance);
  const auto uniform = [&] { return random() / 2147483648.0 - 1; };
  const auto gaps = [&](GuardedOperations& operations, std::int32_t v) // in tolerances, of the edges at v
  {
    std::map<std::int32_t, double> result;
    const Sheet& sheet = operations.sheet(v);
    for (const SheetFace& f : sheet.faces)
      for (std::int32_t x : f.vertices)
      {
        if (x == v) continue;
        double& nearest = result[x] = HUGE_VAL;
        const Vec3 middle = 0.5 * (complex.points[x] + complex.points[v]);
        for (const SheetSample& p : sheet.samples) nearest = std::min(nearest, norm(p.position - middle) / tolerance);
      }
    return result;
  };
  long done = 0, refused = 0;
  for (std::int32_t v = 0; v < std::int32_t(complex.points.size()); ++v)
  {
    if (complex.locked[v] || !complex.onInterface[v]) continue;
    GuardedOperations bounded(complex, lengthAt, { anyDistance, anyDistance, 0, vertexDistance });
    const Vec3 to = complex.points[v] + 0.7 * Vec3{ uniform(), uniform(), uniform() };
    const auto before = gaps(bounded, v);
    const bool moves = bounded.move(v, to, 0);
    GuardedOperations now(complex, lengthAt, { anyDistance, anyDistance });
    if (!moves && !now.move(v, to, 0)) continue;
    (moves ? done : refused) += 1;
    bool spans = now.isSpike(v, vertexDistance);
    for (const auto& [x, gap] : gaps(now, v))
    {
      if (norm(complex.points[x] - to) <= length) continue;
      spans |= gap > vertexDistance;
      EXPECT_TRUE(!moves || gap <= std::max(vertexDistance, before.at(x)) * (1 + 1e-6)) << "edge " << v << ' ' << x;
    }
    EXPECT_TRUE(moves || spans) << "vertex " << v;
  }
  EXPECT_GT(done, 10);
  EXPECT_GT(refused, 3);
}

TEST(GuardedOperations, LayNoVertexBareBeyondTheBound)
{
  constexpr double vertexDistance = 0.9;
  constexpr float tolerance = 0.6f;
  std::map<bool, long> laidBare; // with a bound, and without one
  for (const bool isBounded : { true, false })
  {
    std::mt19937 random(3);
    TetComplex complex = complexOf(tetrahedraOf(randomWellComposedMap(random, { 5, 5, 5 }, 1)), 1, tolerance);
    GuardedOperations operations(complex, [](const Vec3&) { return 1.0f; },
                                 { anyDistance, anyDistance, 0, isBounded ? vertexDistance : 0 });
    for (std::int32_t t = 0; t < std::int32_t(complex.tets.size()); ++t)
    {
      const std::vector<bool> before(complex.onInterface.begin(), complex.onInterface.end());
      for (int i = 0; i < 4; ++i)
        if (const std::int32_t n = complex.neighbours[t][i]; n >= 0 && operations.relabel(t, complex.labels[n], 0))
          for (std::int32_t v : complex.tets[t])
          {
            if (before[v] || !complex.onInterface[v]) continue;
            const auto nearest = operations.nearestSampleOf(v);
            laidBare[isBounded] +=
              nearest && norm(*nearest - complex.points[v]) > vertexDistance * tolerance * (1 + 1e-6);
          }
    }
    EXPECT_GT(operations.counts().relabels, 20);
  }
  EXPECT_EQ(laidBare[true], 0);
  EXPECT_GT(laidBare[false], 0);
}

INSTANTIATE_TEST_SUITE_P(LooseAndStrict, RandomOperations, ::testing::Values(anyDistance, 0.4));

namespace
{

struct Shape
{
  std::string name;
  TissueMap map;
};

std::vector<Shape> shapes()
{
  const auto within = [](int x, int low, int high) { return low <= x && x <= high; };
  return {
    { "voxel", paintedMap({ 3, 3, 3 }, [](int i, int j, int k) { return i == 1 && j == 1 && k == 1; }) },
    { "plate", paintedMap({ 5, 5, 3 }, [](int, int, int k) { return k == 1; }) },
    { "torus", paintedMap({ 5, 5, 3 }, [=](int i, int j, int k)
                          { return k == 1 && within(i, 1, 3) && within(j, 1, 3) && !(i == 2 && j == 2); }) },
    { "two tissues that touch", paintedMap({ 6, 4, 4 }, [=](int i, int j, int k)
                                           { return within(j, 1, 2) && within(k, 1, 2) ? (i < 3 ? 1 : 2) : 0; }) },
    { "two tissues with a gap of one voxel",
      paintedMap({ 7, 4, 4 }, [=](int i, int j, int k)
                 { return within(j, 1, 2) && within(k, 1, 2) && i != 3 ? (i < 3 ? 1 : 2) : 0; }) },
    { "core within a shell within a cavity",
      paintedMap({ 7, 7, 7 },
                 [](int i, int j, int k)
                 {
                   const int r = std::max({ std::abs(i - 3), std::abs(j - 3), std::abs(k - 3) });
                   return r == 0 ? 2 : r == 1 ? 0 : r == 2 ? 1 : 0;
                 }) },
    { "four tissues around a point",
      paintedMap({ 4, 4, 4 }, [](int i, int j, int k) { return k < 2   ? 1
                                                               : i < 2 ? 2
                                                               : j < 2 ? 3
                                                                       : 4; }) },
    { "column through a plate",
      paintedMap({ 5, 5, 5 }, [](int i, int j, int k) { return i == 2 && j == 2 ? 2
                                                               : k == 2         ? 1
                                                                                : 0; }) },
  };
}

} // namespace

/// Whatever can be collapsed is, with no samples to hold the surface: what is left still has every tissue as it was.
TEST(Collapse, CannotPinchOpenOrSwallowATissue)
{
  for (const Shape& shape : shapes())
  {
    SCOPED_TRACE(shape.name);
    ASSERT_TRUE(wellComposed(shape.map));
    TetComplex complex = withoutSamples(tetrahedraOf(shape.map));
    GuardedOperations operations(complex, unitScale);
    const auto topology = topologyOf(complex);
    const std::size_t start = meshOf(complex).tetrahedra.size();
    for (bool any = true; any;)
    {
      any = false;
      for (std::int32_t u = 0; u < std::int32_t(complex.points.size()); ++u)
      {
        if (complex.vertexTet[u] < 0) continue;
        for (std::int32_t v : neighboursOf(complex, u))
        {
          const Vec3 to = complex.points[v], middle = 0.5 * (complex.points[u] + to);
          if (!operations.collapse(u, v, to, anyQuality, anyLength) &&
              !operations.collapse(u, v, middle, anyQuality, anyLength))
            continue;
          any = true;
          if (operations.counts().collapses % 4 != 0) break;
          ASSERT_TRUE(isKept(topology, topologyOf(complex))) << u << " into " << v;
          break;
        }
      }
    }
    ASSERT_TRUE(isConsistent(complex));
    EXPECT_TRUE(isKept(topology, topologyOf(complex)));
    expectManifold(complex);
    EXPECT_LT(meshOf(complex).tetrahedra.size(), start * 3 / 4) << "it is coarser";
  }
}

/// What merging u into v at p would make of the complex.
TetMesh merged(const TetComplex& c, std::int32_t u, std::int32_t v, const Vec3& p)
{
  TetMesh mesh;
  mesh.points = c.points;
  mesh.points[v] = p;
  for (std::int32_t t = 0; t < std::int32_t(c.tets.size()); ++t)
  {
    if (!c.alive(t) || (c.contains(t, u) && c.contains(t, v))) continue;
    mesh.tetrahedra.push_back(c.tets[t]);
    std::replace(mesh.tetrahedra.back().begin(), mesh.tetrahedra.back().end(), u, v);
    mesh.labels.push_back(c.labels[t]);
  }
  return withBackgroundAsTissue(mesh);
}

bool allPositive(const TetMesh& mesh)
{
  return std::all_of(mesh.tetrahedra.begin(), mesh.tetrahedra.end(),
                     [&](const auto& t)
                     {
                       const auto at = [&](int i) { return mesh.points[t[i]]; };
                       return worstSine2(at(0), at(1), at(2), at(3)) > anyQuality;
                     });
}

bool allManifold(const TetMesh& mesh)
{
  const auto tissues = checkSurface(interfaceOf(mesh));
  return std::all_of(tissues.begin(), tissues.end(), [](const auto& tissue) { return tissue.second.manifold(); });
}

/// Along the interface, what looks at the stars of two vertices finds neither more nor less than what looks at
/// everything.
TEST(Collapse, HappensWhereverEveryTissueStaysAsItWas)
{
  int allowed = 0, refused = 0;
  for (unsigned seed = 1; seed <= 40; ++seed)
  {
    std::mt19937 random(seed);
    TetComplex complex = withoutSamples(tetrahedraOf(randomWellComposedMap(random, { 4, 4, 4 }, 1 + int(seed % 5))));
    GuardedOperations operations(complex, unitScale);
    const auto topology = topologyOf(complex);
    for (int n = 0; n < 400; ++n)
    {
      const std::int32_t u = std::int32_t(random() % complex.points.size());
      if (complex.vertexTet[u] < 0) continue;
      const auto around = operations.neighbours(u);
      const auto [v, alongInterface] = around[random() % around.size()];
      if (!alongInterface || complex.locked[u] || complex.locked[v]) continue;
      const Vec3 to = complex.points[v], p = random() % 2 ? to : 0.5 * (complex.points[u] + to);
      const TetMesh mesh = merged(complex, u, v, p);
      if (!allPositive(mesh)) continue;
      const bool keepsAll = isKept(topology, meshTopology(mesh)) && allManifold(mesh);
      ASSERT_EQ(operations.collapse(u, v, p, 0, anyLength), keepsAll) << u << " into " << v << " of seed " << seed;
      ++(keepsAll ? allowed : refused);
      ASSERT_TRUE(isConsistent(complex));
    }
  }
  EXPECT_GT(allowed, 1000);
  EXPECT_GT(refused, 100);
}

/// The tetrahedron in the middle of a block.
std::size_t middleOf(const TetMesh& mesh)
{
  std::size_t inner = 0;
  double least = 1e9;
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t)
  {
    double far = 0;
    for (std::int32_t v : mesh.tetrahedra[t]) far = std::max(far, norm(mesh.points[v] - Vec3{ 0.5, 0.5, 0.5 }));
    if (far < least) least = far, inner = t;
  }
  return inner;
}

/// A last tetrahedron of background between tissues may go, by a collapse and by taking a label; within one it is a
/// cavity.
TEST(GuardedOperations, LetBackgroundVanishBetweenTissuesOnly)
{
  for (const Label other : { Label(1), Label(2) })
  {
    TetMesh mesh = tetrahedraOf(paintedMap({ 2, 2, 2 }, [](int, int, int) { return 0; }));
    const std::size_t pocket = middleOf(mesh);
    const double middle = 0.5 * (mesh.points[mesh.tetrahedra[pocket][0]].x + mesh.points[mesh.tetrahedra[pocket][1]].x);
    for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t)
    {
      double sum = 0;
      for (std::int32_t v : mesh.tetrahedra[t]) sum += mesh.points[v].x;
      mesh.labels[t] = t == pocket ? Label(0) : sum < 4 * middle ? Label(1) : other;
    }
    int collapses = 0;
    for (std::int32_t u : mesh.tetrahedra[pocket])
      for (std::int32_t v : mesh.tetrahedra[pocket])
      {
        TetComplex complex = complexOf(mesh, 1, 2.0f);
        GuardedOperations operations(complex, unitScale, { anyDistance });
        if (u == v || !operations.collapse(u, v, complex.points[v], anyQuality, anyLength)) continue;
        ++collapses;
        EXPECT_EQ(backgroundPieces(complex), 0);
        ASSERT_TRUE(isConsistent(complex));
        EXPECT_TRUE(isKept(meshTopology(withBackgroundAsTissue(mesh)), topologyOf(complex)));
      }
    TetComplex complex = complexOf(mesh, 1, 2.0f);
    GuardedOperations operations(complex, unitScale, { anyDistance });
    EXPECT_EQ(collapses > 0, other == 2);
    EXPECT_EQ(operations.relabel(std::int32_t(pocket), 1, anyQuality), other == 2);
    ASSERT_TRUE(isConsistent(complex));
  }
}

TEST(Collapse, KeepsATissueOfOneTetrahedron)
{
  TetMesh mesh = tetrahedraOf(paintedMap({ 2, 2, 2 }, [](int, int, int) { return 0; }));
  const std::size_t inner = middleOf(mesh);
  mesh.labels[inner] = 1;
  TetComplex complex = withoutSamples(mesh);
  GuardedOperations operations(complex, unitScale);
  const auto corners = mesh.tetrahedra[inner];
  for (std::int32_t u : corners)
  {
    for (std::int32_t v : corners)
    {
      if (u == v) continue;
      for (const Vec3& p : { complex.points[v], 0.5 * (complex.points[u] + complex.points[v]), complex.points[u] })
        EXPECT_FALSE(operations.collapse(u, v, p, anyQuality, anyLength));
    }
  }
}

/// The boundary of a tissue shaped like a tetrahedron has no edge that may go, even if the tissue has a vertex inside.
TEST(Collapse, KeepsATissueShapedLikeATetrahedron)
{
  TetMesh mesh = tetrahedraOf(paintedMap({ 2, 2, 2 }, [](int, int, int) { return 0; }), 2);
  const std::size_t inner = middleOf(mesh);
  const auto corners = mesh.tetrahedra[inner];
  const auto centre = std::int32_t(mesh.points.size());
  Vec3 sum;
  for (std::int32_t v : corners) sum += mesh.points[v];
  mesh.points.push_back(sum / 4);
  for (int i = 0; i < 4; ++i)
  {
    auto tet = corners;
    tet[i] = centre;
    if (i == 0) mesh.tetrahedra[inner] = tet;
    else mesh.tetrahedra.push_back(tet);
    mesh.labels.resize(mesh.tetrahedra.size(), 1);
  }
  mesh.labels[inner] = 1;
  TetComplex complex = withoutSamples(mesh);
  ASSERT_TRUE(isConsistent(complex));
  GuardedOperations operations(complex, unitScale);
  const auto topology = topologyOf(complex);
  for (std::int32_t u : corners)
  {
    for (std::int32_t v : corners)
    {
      EXPECT_FALSE(u != v && operations.collapse(u, v, complex.points[v], anyQuality, anyLength));
    }
    EXPECT_FALSE(operations.collapse(u, centre, complex.points[centre], anyQuality, anyLength)) << "off the boundary";
  }
  EXPECT_TRUE(operations.collapse(centre, corners[0], complex.points[corners[0]], anyQuality, anyLength));
  EXPECT_TRUE(isConsistent(complex));
  EXPECT_TRUE(isKept(topology, topologyOf(complex)));
}

TEST(Collapse, MakesNoEdgeLongerThanAllowed)
{
  TetComplex complex = complexOf(tetrahedraOf(paintedMap({ 4, 4, 4 }, [](int, int, int) { return 0; })));
  GuardedOperations operations(complex, unitScale);
  std::int32_t u = -1;
  for (std::int32_t v = 0; v < std::int32_t(complex.points.size()); ++v)
  {
    if (norm(complex.points[v] - Vec3{ 1.5, 1.5, 1.5 }) < 1e-9) u = v;
  }
  ASSERT_GE(u, 0);
  const auto around = neighboursOf(complex, u);
  // The longest edges at u are sqrt(3); any collapse onto a neighbour makes one of 2 or more.
  for (std::int32_t v : around)
  {
    const ComplexState before(complex);
    EXPECT_FALSE(operations.collapse(u, v, complex.points[v], anyQuality, 1.75));
    EXPECT_TRUE(ComplexState(complex) == before);
  }
  EXPECT_TRUE(std::any_of(around.begin(), around.end(),
                          [&](std::int32_t v)
                          { return operations.collapse(u, v, complex.points[v], anyQuality, 3.5); }));
}

TEST(EdgeRemoval, TurnsTheSheetsDiagonalBetweenTwoLabels)
{
  TetComplex complex = octahedron({ 1, 1, 0, 0 });
  ASSERT_TRUE(isConsistent(complex));
  ASSERT_EQ(complex.samples.size(), 2u);
  GuardedOperations operations(complex, unitScale);
  const auto volumes = volumesOf(meshOf(complex));
  ASSERT_TRUE(operations.removeEdge(0, 1, 0, anyQuality));
  ASSERT_TRUE(isConsistent(complex));
  EXPECT_EQ(operations.counts().flips, 1);
  EXPECT_EQ(tetrahedronAt(complex, 0, 1), -1);
  const std::int32_t seed = tetrahedronAt(complex, 2, 3);
  ASSERT_GE(seed, 0);
  for (const auto& [label, volume] : volumesOf(meshOf(complex))) EXPECT_NEAR(volume, volumes.at(label), 1e-12);
  for (const SamplePlace& place : samplePlaces(complex))
  {
    ASSERT_GE(place.tet, 0);
    EXPECT_EQ(place.pair, (std::array<Label, 2>{ 0, 1 }));
    EXPECT_NEAR(place.distance, 0, 1e-12);
    EXPECT_EQ(complex.tets[place.tet][place.face], 4) << "the sheet lies below the top";
  }
  ASSERT_TRUE(operations.removeEdge(2, 3, seed, anyQuality)) << "and back";
  EXPECT_GE(tetrahedronAt(complex, 0, 1), 0);
  EXPECT_TRUE(isConsistent(complex));
}

TEST(EdgeRemoval, HappensWithinALabelAndOnASheetAndNowhereElse)
{
  for (int code = 0; code < 256; ++code)
  {
    const std::array<Label, 4> labels{ Label(code & 3), Label(code >> 2 & 3), Label(code >> 4 & 3), Label(code >> 6) };
    int changes = 0;
    for (int i = 0; i < 4; ++i) changes += labels[i] != labels[(i + 1) % 4];
    // Of two labels, each needs two neighbouring quarters: with one it would lose its edge, and with it its way round.
    const bool halves = changes == 2 && labels[0] != labels[2] && labels[1] != labels[3];
    TetComplex complex = octahedron(labels);
    for (auto& heads : complex.sampleHeads) heads.fill(-1); // nothing but the labels decides
    GuardedOperations operations(complex, unitScale);
    const ComplexState before(complex);
    const bool expected = changes == 0 || halves;
    EXPECT_EQ(operations.removeEdge(0, 1, 0, anyQuality), expected) << "labels " << code;
    EXPECT_EQ(ComplexState(complex) == before, !expected) << "labels " << code;
    EXPECT_TRUE(isConsistent(complex));
  }
}

TEST(EdgeRemoval, RefusesWhatQualityOrSamplesForbid)
{
  TetComplex complex = octahedron({ 1, 1, 2, 2 });
  const double same = complex.quality(0); // by symmetry that of every tetrahedron, before and after
  {
    GuardedOperations operations(complex, unitScale);
    EXPECT_FALSE(operations.removeEdge(0, 1, 0, same * 1.01));
    EXPECT_FALSE(operations.removeEdge(0, 1, 0)) << "no better than now";
  }
  // With the ends of ab lifted, the other diagonal passes below the samples of the old sheet.
  TetMesh mesh = meshOf(octahedron({ 1, 1, 2, 2 }));
  for (Vec3& p : mesh.points)
  {
    if (p.x != 0) p.z += 0.2;
  }
  for (float tolerance : { 0.01f, 0.5f })
  {
    TetComplex bent = complexOf(mesh, 1, tolerance);
    GuardedOperations operations(bent, unitScale);
    const auto [a, b] = endsAlongX(bent);
    EXPECT_EQ(operations.removeEdge(a, b, tetrahedronAt(bent, a, b), anyQuality), tolerance > 0.1f);
  }
}

TEST(EdgeRemoval, IsToBeatTheWorstAroundTheEdgeIfNoQualityIsAskedFor)
{
  const TetMesh regular = meshOf(octahedron({ 1, 1, 1, 1 }));
  for (const auto& [stretch, expected] : { std::pair(2.0, true), std::pair(0.5, false) })
  {
    TetMesh mesh = regular;
    for (Vec3& p : mesh.points) p.x *= stretch;
    TetComplex complex = complexOf(mesh);
    GuardedOperations operations(complex, unitScale);
    const auto [a, b] = endsAlongX(complex);
    EXPECT_EQ(operations.removeEdge(a, b, tetrahedronAt(complex, a, b)), expected) << stretch;
  }
}

TEST(EdgeRemoval, NeedsAPositiveTriangulationWhateverQualityIsAskedFor)
{
  // Both ends of the edge lie below the triangle around it.
  TetMesh mesh;
  mesh.points = { { 0, 0, 0 }, { 0, 0, 1 }, { 1, 0, 5 }, { -0.5, 0.8, 5 }, { -0.5, -0.8, 5 } };
  mesh.tetrahedra = { { 0, 1, 2, 3 }, { 0, 1, 3, 4 }, { 0, 1, 4, 2 } };
  for (const Label label : { Label(0), Label(1) })
  {
    mesh.labels.assign(3, label);
    TetComplex complex = complexOf(mesh);
    ASSERT_TRUE(isConsistent(complex));
    GuardedOperations operations(complex, unitScale);
    EXPECT_FALSE(operations.removeEdge(0, 1, 0, -100)); // as beside a flat tetrahedron
    EXPECT_EQ(operations.counts().flips, 0);
  }
}

/// Sum over the tissues' tetrahedra of the sines of their worst angles, above `usualSine`.
double sumOfSines(const TetComplex& c, double usualSine)
{
  double sum = 0;
  for (std::int32_t t = 0; t < std::int32_t(c.tets.size()); ++t)
    if (c.alive(t) && c.labels[t] != 0) sum += std::sqrt(std::max(0.0, c.quality(t))) - usualSine;
  return sum;
}

double leastHeight(const TetComplex& c)
{
  double least = 1e9;
  for (std::int32_t t = 0; t < std::int32_t(c.tets.size()); ++t)
    if (const auto& x = c.tets[t]; c.alive(t) && c.labels[t] != 0)
      least = std::min(least, leastHeight(c.points[x[0]], c.points[x[1]], c.points[x[2]], c.points[x[3]]));
  return least;
}

TEST(EdgeSwap, HappensForALargerSumOfSinesAlone)
{
  constexpr double usualSine = 0.7, leastGain = 0.01;
  int done = 0;
  for (double width = 0.5; width < 2; width += 0.1)
  {
    SCOPED_TRACE(width);
    const auto stretched = [&](int axis) // the edge lies along the first
    {
      TetMesh mesh = meshOf(octahedron({ 1, 1, 1, 1 }));
      for (Vec3& p : mesh.points) p[axis] *= width;
      return withoutSamples(mesh);
    };
    TetComplex complex = stretched(0);
    const double before = sumOfSines(complex, usualSine), otherwise = sumOfSines(stretched(1), usualSine);
    GuardedOperations operations(complex, unitScale);
    const auto [a, b] = endsAlongX(complex);
    const bool swapped =
      operations.swapEdge(a, b, tetrahedronAt(complex, a, b), { anyQuality, usualSine, 0, leastGain });
    EXPECT_EQ(swapped, otherwise > before + leastGain);
    EXPECT_NEAR(sumOfSines(complex, usualSine), swapped ? otherwise : before, 1e-12);
    EXPECT_TRUE(isConsistent(complex));
    done += swapped;
  }
  EXPECT_GT(done, 3);
  EXPECT_LT(done, 13);
}

TEST(EdgeSwap, BetweenTwoLabelsLeavesNoVertexWithThreeTriangles)
{
  TetMesh mesh = meshOf(octahedron({ 1, 1, 2, 2 }));
  for (Vec3& p : mesh.points) p.x *= 1.6;
  TetComplex complex = withoutSamples(mesh);
  GuardedOperations operations(complex, unitScale);
  const auto [a, b] = endsAlongX(complex);
  const std::int32_t seed = tetrahedronAt(complex, a, b);
  EXPECT_FALSE(operations.swapEdge(a, b, seed, { anyQuality, 0.7, 1, -100 }));
  EXPECT_TRUE(operations.removeEdge(a, b, seed, anyQuality)) << "all else allows it";
}

TEST(EdgeRemoval, RaisesTheLeastHeightOrDoesNothing)
{
  int done = 0;
  for (double width = 0.5; width < 2; width += 0.1)
  {
    TetMesh mesh = meshOf(octahedron({ 1, 1, 1, 1 }));
    for (Vec3& p : mesh.points)
    {
      p.x *= width;
      if (p.z > 0) p.z *= 0.8;
    }
    TetComplex complex = withoutSamples(mesh);
    GuardedOperations operations(complex, unitScale);
    const auto [a, b] = endsAlongX(complex);
    const double before = leastHeight(complex);
    const bool removed = operations.removeLowEdge(a, b, tetrahedronAt(complex, a, b), anyQuality);
    EXPECT_EQ(leastHeight(complex) > before, removed);
    done += removed;
  }
  EXPECT_GT(done, 3);
}

TEST(EdgeRemoval, RefusesAnEdgeOnTheBorder)
{
  TetComplex complex = octahedron({ 1, 1, 0, 0 });
  GuardedOperations operations(complex, unitScale);
  EXPECT_FALSE(operations.removeEdge(0, 4, 0, 0));
  EXPECT_FALSE(operations.split(0, 4, 0, { 0.5, 0, 0.5 }, 0));
}

TEST(Split, OnTheEdgeKeepsEveryVolume)
{
  TetComplex complex = octahedron({ 1, 2, 0, 0 });
  GuardedOperations operations(complex, unitScale);
  const auto volumes = volumesOf(meshOf(complex));
  const auto newVertex = operations.split(0, 1, 0, { 0.25, 0, 0 }, anyQuality);
  ASSERT_TRUE(newVertex);
  ASSERT_TRUE(isConsistent(complex));
  EXPECT_EQ(meshOf(complex).tetrahedra.size(), 8u);
  EXPECT_EQ(complex.points.size(), 7u);
  EXPECT_EQ(*newVertex, 6);
  EXPECT_EQ(complex.lengths[6], 1.0f);
  for (const auto& [label, volume] : volumesOf(meshOf(complex))) EXPECT_NEAR(volume, volumes.at(label), 1e-12);
  EXPECT_EQ(attachedSamples(complex), complex.samples.size());
  for (const SamplePlace& place : samplePlaces(complex)) EXPECT_NEAR(place.distance, 0, 1e-12);
}

TEST(Split, OutsideTheRingIsRefused)
{
  TetComplex complex = octahedron({ 1, 1, 0, 0 }, float(anyDistance));
  GuardedOperations operations(complex, unitScale, { anyDistance });
  const ComplexState before(complex);
  EXPECT_FALSE(operations.split(0, 1, 0, { 0, 0, 1.1 }, anyQuality));
  EXPECT_FALSE(operations.split(0, 1, 0, { 1, 0, 0 }, anyQuality)) << "at one end";
  EXPECT_TRUE(ComplexState(complex) == before);
}

TEST(Split, TakenBackLeavesTheComplexAsItWas)
{
  const auto contents = [](const TetComplex& complex)
  {
    std::set<std::pair<TetComplex::Tet, Label>> result;
    for (std::int32_t t = 0; t < std::int32_t(complex.tets.size()); ++t)
    {
      if (!complex.alive(t)) continue;
      TetComplex::Tet sorted = complex.tets[t];
      std::sort(sorted.begin(), sorted.end());
      result.insert({ sorted, complex.labels[t] });
    }
    return result;
  };
  std::mt19937 random(7);
  int splits = 0;
  for (int map = 0; map < 4; ++map)
  {
    TetComplex complex = complexOf(tetrahedraOf(randomWellComposedMap(random, { 4, 4, 4 }, 3)), 1, 0.01f);
    GuardedOperations operations(complex, unitScale, { anyDistance, 1, 0, 0.3 });
    const auto before = contents(complex);
    const auto places = samplePlaces(complex);
    const std::int32_t points = std::int32_t(complex.points.size());
    for (std::int32_t a = 0; a < points; ++a)
      for (const std::int32_t b : neighboursOf(complex, a))
      {
        const Vec3 middle = 0.5 * (complex.points[a] + complex.points[b]);
        if (complex.locked[a]) continue;
        const auto v = operations.split(a, b, tetrahedronAt(complex, a, b), middle, anyQuality);
        if (!v) continue;
        ++splits;
        operations.takeBackSplit(*v, a);
        ASSERT_TRUE(contents(complex) == before) << "edge " << a << " " << b;
      }
    ASSERT_TRUE(isConsistent(complex));
    EXPECT_EQ(operations.counts().splits, 0);
    EXPECT_EQ(operations.counts().collapses, 0);
    const auto after = samplePlaces(complex);
    for (std::size_t e = 0; e < places.size(); ++e)
    {
      EXPECT_EQ(after[e].pair, places[e].pair);
      EXPECT_NEAR(after[e].distance, places[e].distance, 1e-9);
    }
  }
  EXPECT_GT(splits, 1000);
}

TEST(Move, KeepsSamplesWithinToleranceAndTheirMeanSquareBelowTheLimit)
{
  // The sample lies nearly two thirds of the move away from the lifted faces.
  const Vec3 lifted{ 0, 0, 0.3 };
  for (const auto& [tolerance, rmsLimit, allowed] : { std::tuple(0.5f, 0.5, true),
                                                      { 0.5f, 0.1, false },
                                                      { 0.05f, anyDistance, false },
                                                      { 0.21f, anyDistance, true } })
  {
    TetComplex complex = octahedron({ 1, 1, 0, 0 }, tolerance);
    GuardedOperations operations(complex, unitScale, { rmsLimit });
    const auto v = operations.split(0, 1, 0, {}, anyQuality);
    ASSERT_TRUE(v);
    const ComplexState before(complex);
    EXPECT_EQ(operations.move(*v, lifted, anyQuality), allowed) << "tolerance " << tolerance << ", limit " << rmsLimit;
    EXPECT_EQ(ComplexState(complex) == before, !allowed);
    EXPECT_TRUE(operations.move(*v, { 0.1, 0.1, 0 }, anyQuality)) << "within the sheet";
  }
}

TEST(Move, MayComeCloserFromBeyondTheTolerance)
{
  TetComplex complex = octahedron({ 1, 1, 0, 0 }, 0.5f);
  GuardedOperations operations(complex, unitScale, { anyDistance });
  const auto newVertex = operations.split(0, 1, 0, {}, anyQuality);
  ASSERT_TRUE(newVertex);
  const std::int32_t v = *newVertex;
  ASSERT_TRUE(operations.move(v, { 0, 0, 0.4 }, anyQuality));
  for (BoundarySample& e : complex.samples) e.tolerance = 0.01f;
  GuardedOperations strict(complex, unitScale, { anyDistance });
  EXPECT_FALSE(strict.move(v, { 0, 0, 0.45 }, anyQuality));
  EXPECT_TRUE(strict.move(v, { 0, 0, 0.3 }, anyQuality));
}

TEST(Move, TakenBackLeavesPlaceAndDistancesAsTheyWere)
{
  TetComplex complex = octahedron({ 1, 1, 0, 0 }, 0.5f);
  GuardedOperations operations(complex, unitScale, { anyDistance });
  const auto newVertex = operations.split(0, 1, 0, {}, anyQuality);
  ASSERT_TRUE(newVertex);
  const std::int32_t v = *newVertex;
  ASSERT_TRUE(operations.move(v, { 0, 0, 0.1 }, anyQuality));
  const auto before = samplePlaces(complex);
  const long moves = operations.counts().moves;
  ASSERT_TRUE(operations.move(v, { 0.2, 0, 0.2 }, anyQuality));
  ASSERT_TRUE(operations.move(v, { 0.2, 0.1, 0.3 }, anyQuality));
  for (BoundarySample& e : complex.samples) e.tolerance = 0.001f; // nothing is asked of the way back
  operations.moveBack(v, { 0.2, 0, 0.2 });
  operations.moveBack(v, { 0, 0, 0.1 });
  EXPECT_TRUE(complex.points[v] == (Vec3{ 0, 0, 0.1 }));
  EXPECT_EQ(operations.counts().moves, moves);
  ASSERT_TRUE(isConsistent(complex));
  const auto after = samplePlaces(complex);
  ASSERT_EQ(after.size(), before.size());
  for (std::size_t e = 0; e < before.size(); ++e)
  {
    EXPECT_EQ(after[e].pair, before[e].pair);
    EXPECT_LE(after[e].distance, before[e].distance * (1 + 1e-9));
  }
}

TEST(Move, ManyTakenBackLeaveNoSampleBeyondItsTolerance)
{
  constexpr float tolerance = 0.3f;
  std::map<bool, long> lost; // with samples brought home, and without
  for (const bool isBroughtHome : { true, false })
    for (unsigned seed = 1; seed <= 100; ++seed)
    {
      std::mt19937 random(seed);
      const TissueMap map = randomWellComposedMap(random, { 4, 4, 4 }, 1 + int(seed % 3));
      TetComplex complex = complexOf(tetrahedraOf(map), 1, tolerance);
      GuardedOperations operations(complex, unitScale, { anyDistance });
      const auto uniform = [&] { return random() / 2147483648.0 - 1; };
      std::vector<std::pair<std::int32_t, Vec3>> moves;
      std::set<std::int32_t> moved;
      for (int n = 0; n < 3000; ++n)
      {
        const auto v = std::int32_t(random() % complex.points.size());
        const Vec3 from = complex.points[v], to = from + Vec3{ uniform(), uniform(), uniform() };
        if (!operations.move(v, to, anyQuality)) continue;
        moves.push_back({ v, from });
        moved.insert(v);
      }
      for (auto m = moves.rbegin(); m != moves.rend(); ++m) operations.moveBack(m->first, m->second);
      if (isBroughtHome)
        for (const std::int32_t v : moved) operations.reassignSamples(v);
      EXPECT_EQ(operations.counts().moves, 0);
      ASSERT_TRUE(isConsistent(complex));
      for (const SamplePlace& place : samplePlaces(complex))
        lost[isBroughtHome] += place.distance > tolerance * (1 + 1e-6);
    }
  EXPECT_EQ(lost[true], 0);
  EXPECT_GT(lost[false], 0);
}

/// The sample that refused last is asked first, whosever it was.
TEST(Move, IsAllowedOrRefusedWhateverWasRefusedBefore)
{
  std::mt19937 random(1);
  TetComplex fresh = complexOf(tetrahedraOf(randomWellComposedMap(random, { 8, 8, 8 }, 3)), 1, 0.3f);
  TetComplex experienced = fresh;
  const EnvelopeBounds bounds{ .rmsLimit = 0.6, .vertexDistance = 1.4 };
  GuardedOperations operations(experienced, unitScale, bounds);
  std::uniform_real_distribution<double> uniform(-0.3, 0.3);
  std::size_t allowed = 0, refused = 0;
  for (std::int32_t v = 0; v < std::int32_t(fresh.points.size()); ++v)
  {
    if (!fresh.onInterface[v] || fresh.locked[v]) continue;
    for (int trial = 0; trial < 10; ++trial)
    {
      const Vec3 p = fresh.points[v] + Vec3{ uniform(random), uniform(random), uniform(random) };
      const bool moves = GuardedOperations(fresh, unitScale, bounds).move(v, p, anyQuality);
      ASSERT_EQ(operations.move(v, p, anyQuality), moves) << "vertex " << v << ", trial " << trial;
      ++(moves ? allowed : refused);
    }
  }
  EXPECT_TRUE(ComplexState(experienced) == ComplexState(fresh));
  EXPECT_GT(allowed, 100u);
  EXPECT_GT(refused, 100u);
}

TEST(LockedVertices, NeverMoveOrGo)
{
  TetComplex complex = complexOf(tetrahedraOf(paintedMap({ 3, 3, 3 }, [](int i, int, int) { return i < 2; })));
  std::fill(complex.locked.begin(), complex.locked.end(), std::uint8_t(1));
  GuardedOperations operations(complex, unitScale, { anyDistance });
  const ComplexState before(complex);
  for (std::int32_t u = 0; u < std::int32_t(complex.points.size()); ++u)
  {
    EXPECT_FALSE(operations.move(u, complex.points[u] + Vec3{ 0.01, 0.01, 0.01 }, anyQuality));
    for (std::int32_t v : neighboursOf(complex, u))
    {
      EXPECT_FALSE(operations.collapse(u, v, complex.points[v], anyQuality, anyLength));
      EXPECT_FALSE(operations.collapse(u, v, 0.5 * (complex.points[u] + complex.points[v]), anyQuality, anyLength));
    }
  }
  EXPECT_TRUE(ComplexState(complex) == before);
}

TEST(Quality, OfBackgroundIsTakenLeniently)
{
  TetComplex complex = octahedron({ 1, 1, 0, 0 });
  GuardedOperations operations(complex, unitScale);
  EXPECT_EQ(operations.quality(0), complex.quality(0));
  EXPECT_EQ(operations.quality(2), backgroundLeniency * complex.quality(2));
  EXPECT_EQ(operations.worstQuality({ 0, 2 }), std::min(operations.quality(0), operations.quality(2)));
}

TEST(DistanceToTriangle, IsThatOfTheNearestOfManyOfItsPoints)
{
  std::mt19937 random(7);
  const auto uniform = [&] { return random() / 2147483648.0 - 1; };
  const auto anyPoint = [&] { return Vec3{ uniform(), uniform(), uniform() }; };
  for (int trial = 0; trial < 200; ++trial)
  {
    const Vec3 a = anyPoint(), b = anyPoint(), c = anyPoint(), p = 2 * anyPoint();
    const double distance = std::sqrt(squaredDistanceToTriangle(p, a, b, c));
    constexpr int n = 60;
    double nearest = 10;
    for (int i = 0; i <= n; ++i)
    {
      for (int j = 0; i + j <= n; ++j) nearest = std::min(nearest, norm(p - (i * a + j * b + (n - i - j) * c) / n));
    }
    EXPECT_LE(distance, nearest + 1e-12);
    EXPECT_GE(distance, nearest - 3.0 / n);
  }
}

} // namespace surgicalmesher
