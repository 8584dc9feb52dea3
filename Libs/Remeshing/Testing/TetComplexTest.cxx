// SPDX-License-Identifier: Apache-2.0
#include "TetComplex.h"
#include "ComplexInvariants.h"
#include "RandomMaps.h"

#include <gtest/gtest.h>

#include <utility>

namespace surgicalmesher
{
namespace
{

using namespace test;

TetMesh randomLattice(std::mt19937& random) { return tetrahedraOf(randomWellComposedMap(random, { 3, 4, 3 }, 3)); }

/// Only the tetrahedra below the plane x = `at`, as a block is cut out of a mesh.
TetMesh blockOf(const TetMesh& mesh, double at)
{
  TetMesh block;
  std::vector<std::int32_t> ids(mesh.points.size(), -1);
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t)
  {
    auto tet = mesh.tetrahedra[t];
    if (std::any_of(tet.begin(), tet.end(), [&](std::int32_t v) { return mesh.points[v].x > at; })) continue;
    for (std::int32_t& v : tet)
    {
      if (ids[v] < 0)
      {
        ids[v] = std::int32_t(block.points.size());
        block.points.push_back(mesh.points[v]);
      }
      v = ids[v];
    }
    block.tetrahedra.push_back(tet);
    block.labels.push_back(mesh.labels[t]);
  }
  return block;
}

std::set<std::int32_t> asSet(const std::vector<std::int32_t>& list) { return { list.begin(), list.end() }; }

/// Tetrahedra that have both vertices, by looking at all.
std::set<std::int32_t> havingBoth(const TetComplex& complex, std::int32_t a, std::int32_t b)
{
  std::set<std::int32_t> found;
  for (std::int32_t t = 0; t < std::int32_t(complex.tets.size()); ++t)
  {
    if (complex.alive(t) && complex.contains(t, a) && complex.contains(t, b)) found.insert(t);
  }
  return found;
}

bool onBorder(const TetComplex& complex, std::int32_t a, std::int32_t b)
{
  for (std::int32_t t : havingBoth(complex, a, b))
  {
    for (int i = 0; i < 4; ++i)
    {
      if (complex.neighbours[t][i] < 0 && complex.tets[t][i] != a && complex.tets[t][i] != b) return true;
    }
  }
  return false;
}

void expectRing(TetComplex& complex, std::int32_t a, std::int32_t b)
{
  const auto expected = havingBoth(complex, a, b);
  std::vector<std::int32_t> ring, vertices;
  for (std::int32_t seed : expected)
  {
    ASSERT_EQ(complex.ring(a, b, seed, ring, vertices), !onBorder(complex, a, b));
    if (onBorder(complex, a, b)) continue;
    EXPECT_EQ(ring[0], seed);
    EXPECT_EQ(asSet(ring), expected);
    const std::size_t n = ring.size();
    ASSERT_EQ(n, expected.size()) << "each once";
    ASSERT_EQ(vertices.size(), n);
    for (std::size_t i = 0; i < n; ++i)
    {
      EXPECT_TRUE(complex.contains(ring[i], vertices[i]));
      EXPECT_TRUE(complex.contains(ring[(i + n - 1) % n], vertices[i]));
      EXPECT_GT(orient(complex.points[a], complex.points[b], complex.points[vertices[i]],
                       complex.points[vertices[(i + 1) % n]]),
                0)
        << "one way round";
    }
  }
}

/// A face inside the complex between two tetrahedra whose union is strictly convex across it.
bool convexPair(const TetComplex& c, std::int32_t t, int i)
{
  const std::int32_t n = c.neighbours[t][i];
  if (n < 0) return false;
  const std::int32_t top = c.tets[t][i];
  std::int32_t bottom = -1;
  for (std::int32_t v : c.tets[n])
  {
    if (!c.contains(t, v)) bottom = v;
  }
  for (int k = 1; k < 4; ++k)
  {
    auto tet = c.tets[t];
    tet[(i + k) & 3] = bottom;
    if (!(orient(c.points[tet[0]], c.points[tet[1]], c.points[tet[2]], c.points[tet[3]]) > 1e-9)) return false;
  }
  return top != bottom;
}

} // namespace

TEST(TetComplex, ANewOneIsConsistentAndLockedOnItsBorder)
{
  std::mt19937 random(1);
  for (int trial = 0; trial < 10; ++trial)
  {
    const TetMesh mesh = randomLattice(random);
    const TetComplex complex = complexOf(mesh);
    ASSERT_TRUE(isConsistent(complex));
    EXPECT_EQ(attachedSamples(complex), complex.samples.size());
    const auto neighbours = faceAdjacency(mesh);
    std::vector<std::uint8_t> border(mesh.points.size(), 0);
    for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t)
    {
      for (int i = 0; i < 4; ++i)
      {
        EXPECT_EQ(complex.neighbours[t][i], neighbours.across[t][i]);
        if (neighbours.across[t][i] >= 0) continue;
        for (int k = 1; k < 4; ++k) border[mesh.tetrahedra[t][(i + k) & 3]] = 1;
      }
    }
    EXPECT_EQ(complex.locked, border);
  }
}

TEST(TetComplex, StarAndRingAreThoseFoundByLookingAtAll)
{
  std::mt19937 random(2);
  TetComplex complex = complexOf(randomLattice(random));
  std::vector<std::int32_t> star, same;
  TetComplex::Marks marks{ std::vector<std::uint32_t>(complex.tets.size(), 0) };
  for (std::int32_t v = 0; v < std::int32_t(complex.points.size()); ++v)
  {
    complex.star(v, star);
    std::as_const(complex).star(v, same, marks);
    EXPECT_EQ(star, same);
    EXPECT_EQ(asSet(star), havingBoth(complex, v, v));
    EXPECT_EQ(asSet(star).size(), star.size());
    if (v % 7 == 0)
    {
      for (std::int32_t x : neighboursOf(complex, v)) expectRing(complex, v, x);
    }
  }
}

TEST(TetComplex, CornersAndInterfaceFacesAreThoseFoundByLookingAtAll)
{
  std::mt19937 random(31);
  for (int round = 0; round < 20; ++round)
  {
    const TetMesh mesh = blockOf(randomLattice(random), 1.5);
    const TetComplex c(mesh.points, std::vector<float>(mesh.points.size(), 1), mesh.tetrahedra, mesh.labels);
    for (std::int32_t t = 0; t < std::int32_t(c.tets.size()); ++t)
    {
      const auto& x = c.tets[t];
      for (std::int32_t v = 0; v < std::int32_t(c.points.size()); ++v)
        EXPECT_EQ(c.contains(t, v), std::count(x.begin(), x.end(), v) == 1);
      for (int i = 0; i < 4; ++i)
      {
        const auto& [a, b, d] = TetComplex::otherCorners[i];
        EXPECT_EQ(c.indexOf(t, x[i]), i);
        EXPECT_EQ(c.fourthVertex(t, x[a], x[b], x[d]), x[i]);
        EXPECT_EQ(c.isInterfaceOfLesser(t, i), c.isInterface(t, i) && t < c.neighbours[t][i]);
      }
    }
  }
}

TEST(TetComplex, InterfaceFacesAtAVertexAreFoundOnceEach)
{
  std::mt19937 random(5);
  const TetComplex c = complexOf(randomLattice(random));
  TetComplex::Marks marks{ std::vector<std::uint32_t>(c.tets.size(), 0) };
  std::vector<std::int32_t> star;
  std::vector<TetComplex::FaceOfTet> faces;
  std::size_t found = 0;
  for (std::int32_t v = 0; v < std::int32_t(c.points.size()); ++v)
  {
    c.star(v, star, marks);
    c.interfaceFaces(v, star, faces);
    std::size_t sides = 0; // each face has two
    for (const std::int32_t t : star)
      for (int i = 0; i < 4; ++i) sides += c.isInterface(t, i) && c.tets[t][i] != v;
    EXPECT_EQ(2 * faces.size(), sides) << "at vertex " << v;
    for (const auto& [t, i] : faces)
    {
      EXPECT_TRUE(c.isInterface(t, i));
      EXPECT_TRUE(c.contains(t, v) && c.tets[t][i] != v);
      EXPECT_LT(t, c.neighbours[t][i]);
    }
    found += faces.size();
  }
  EXPECT_GT(found, 100u);
}

TEST(TetComplex, HolderIsTheSideOfTheLargerLabel)
{
  std::mt19937 random(3);
  const TetComplex complex = complexOf(randomLattice(random));
  int faces = 0;
  for (std::int32_t t = 0; t < std::int32_t(complex.tets.size()); ++t)
  {
    for (int i = 0; i < 4; ++i)
    {
      if (!complex.isInterface(t, i)) continue;
      ++faces;
      const auto [h, j] = complex.holder(t, i);
      EXPECT_EQ(faceKey(complex.tets[h], j), faceKey(complex.tets[t], i));
      EXPECT_EQ(complex.labels[h], std::max(complex.labels[t], complex.labels[complex.neighbours[t][i]]));
    }
  }
  EXPECT_GT(faces, 0);
}

TEST(TetComplex, ReplacingTwoByThreeAndBackKeepsItConsistent)
{
  std::mt19937 random(4);
  TetMesh mesh = randomLattice(random);
  std::uniform_real_distribution<double> shift(-0.1, 0.1);
  for (Vec3& p : mesh.points) p += Vec3{ shift(random), shift(random), shift(random) };
  TetComplex complex = complexOf(mesh);
  ASSERT_TRUE(isConsistent(complex));
  const double volume = volumeOf(meshOf(complex));
  const std::size_t samples = attachedSamples(complex);
  int replaced = 0;
  for (int trial = 0; trial < 4000 && replaced < 60; ++trial)
  {
    const auto t = std::int32_t(random() % complex.tets.size());
    const int i = int(random() % 4);
    if (!complex.alive(t) || !convexPair(complex, t, i)) continue;
    const std::int32_t n = complex.neighbours[t][i];
    if (complex.labels[n] != complex.labels[t]) continue;
    const std::int32_t top = complex.tets[t][i];
    std::int32_t bottom = -1;
    for (std::int32_t v : complex.tets[n])
    {
      if (!complex.contains(t, v)) bottom = v;
    }
    std::vector<TetComplex::Tet> three;
    for (int k = 1; k < 4; ++k)
    {
      three.push_back(complex.tets[t]);
      three.back()[(i + k) & 3] = bottom;
    }
    const std::vector<TetComplex::Tet> two{ complex.tets[t], complex.tets[n] };
    const Label label = complex.labels[t];
    const auto ids = complex.replace({ t, n }, three, { label, label, label });
    ++replaced;
    ASSERT_EQ(ids.size(), 3u);
    ASSERT_TRUE(isConsistent(complex));
    EXPECT_EQ(havingBoth(complex, top, bottom), asSet(ids));
    expectRing(complex, top, bottom);
    if (replaced % 2)
    {
      complex.replace(ids, two, { label, label });
      ASSERT_TRUE(isConsistent(complex));
    }
    EXPECT_NEAR(volumeOf(meshOf(complex)), volume, 1e-9 * volume);
    EXPECT_EQ(attachedSamples(complex), samples) << "nothing happened to an interface face";
  }
  EXPECT_EQ(replaced, 60);
}

TEST(TetComplex, CollapsingInsideALabelKeepsItConsistent)
{
  std::mt19937 random(5);
  const TissueMap map = paintedMap({ 5, 5, 5 }, [](int i, int, int) { return i < 3 ? 1 : 2; });
  TetComplex complex = complexOf(tetrahedraOf(map));
  const double volume = volumeOf(meshOf(complex));
  std::vector<std::int32_t> star;
  int collapsed = 0;
  for (int trial = 0; trial < 3000; ++trial)
  {
    const auto u = std::int32_t(random() % complex.points.size());
    if (complex.vertexTet[u] < 0 || complex.locked[u]) continue;
    complex.star(u, star);
    const auto around = neighboursOf(complex, u);
    const std::int32_t v = around[random() % around.size()];
    if (!std::all_of(star.begin(), star.end(),
                     [&](std::int32_t t)
                     {
                       return complex.labels[t] == complex.labels[star[0]] &&
                              (complex.contains(t, v) || complex.qualityWith(t, u, complex.points[v]) > 1e-3);
                     }))
      continue;
    complex.collapse(u, v, star);
    ++collapsed;
    ASSERT_TRUE(isConsistent(complex));
    EXPECT_EQ(complex.vertexTet[u], -1);
    EXPECT_NEAR(volumeOf(meshOf(complex)), volume, 1e-9 * volume);
    EXPECT_EQ(attachedSamples(complex), complex.samples.size());
  }
  EXPECT_GT(collapsed, 20);
}

/// The samples of a face between two blocks hangs on the block with the larger label, which sees no tetrahedron beyond.
TEST(TetComplex, SamplesOnABlocksBorderOutliveChangesBesideThem)
{
  const TissueMap map = paintedMap({ 3, 5, 5 }, [](int, int, int) { return 1; });
  const TetMesh mesh = blockOf(tetrahedraOf(map, 0), 2.5);
  TetComplex complex(mesh.points, std::vector<float>(mesh.points.size(), 1), mesh.tetrahedra, mesh.labels);
  for (std::int32_t t = 0; t < std::int32_t(complex.tets.size()); ++t)
  {
    for (int i = 0; i < 4; ++i)
    {
      if (complex.neighbours[t][i] >= 0) continue;
      const auto [a, b, c] = faceKey(complex.tets[t], i);
      complex.addSample(t, i, (complex.points[a] + complex.points[b] + complex.points[c]) / 3, 0.5f);
    }
  }
  ASSERT_TRUE(isConsistent(complex));
  ASSERT_EQ(attachedSamples(complex), complex.samples.size());
  GuardedOperations operations(complex, [](const Vec3&) { return 1.0f; });
  for (std::int32_t u = 0; u < std::int32_t(complex.points.size()); ++u)
  {
    if (complex.vertexTet[u] < 0) continue;
    for (std::int32_t v : neighboursOf(complex, u))
    {
      if (operations.collapse(u, v, complex.points[v], 1e-3, 10)) break;
      const std::int32_t seed = tetrahedronAt(complex, u, v);
      operations.removeEdge(u, v, seed, 1e-3);
    }
    ASSERT_TRUE(isConsistent(complex));
    ASSERT_EQ(attachedSamples(complex), complex.samples.size()) << "at vertex " << u;
  }
  EXPECT_GT(operations.counts().collapses, 0);
  EXPECT_GT(operations.counts().flips, 0);
  for (const SamplePlace& place : samplePlaces(complex)) EXPECT_NEAR(place.distance, 0, 1e-12);
}

} // namespace surgicalmesher
