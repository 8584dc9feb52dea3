// SPDX-License-Identifier: Apache-2.0
#include "BlockSweep.h"
#include "Coarsening.h"
#include "ComplexInvariants.h"
#include "RandomMaps.h"
#include "Remesher.h"
#include "Triangle.h"

#include <gtest/gtest.h>
#include <vtkSMPTools.h>

#include <algorithm>
#include <atomic>
#include <mutex>
#include <stdexcept>
#include <tuple>

namespace surgicalmesher
{
namespace
{

using namespace test;

const SizingFunction scale = [](const Vec3& p) { return float(2 + 0.2 * p.x); };

/// A sample in the middle of each interface face.
BackgroundMesh ambientOf(const TissueMap& map)
{
  BackgroundMesh ambient;
  ambient.mesh = tetrahedraOf(map);
  for (const Vec3& p : ambient.mesh.points) ambient.lengths.push_back(scale(p));
  const TetComplex complex = complexOf(ambient.mesh, 1, 0.6f);
  const auto places = samplePlaces(complex);
  for (std::size_t e = 0; e < places.size(); ++e)
    ambient.samples.push_back({ complex.samples[e], places[e].tet, places[e].face });
  return ambient;
}

BackgroundMesh randomAmbient(unsigned seed, int labels)
{
  std::mt19937 random(seed);
  return ambientOf(randomWellComposedMap(random, { 6, 5, 7 }, labels));
}

std::array<double, 3> coordinates(const Vec3& p) { return { p.x, p.y, p.z }; }

/// Every tetrahedron by its corners' places, and every sample with the places of its face's corners.
auto contents(const BackgroundMesh& ambient)
{
  using Place = std::array<double, 3>;
  const auto& mesh = ambient.mesh;
  std::multiset<std::pair<std::array<Place, 4>, Label>> tets;
  std::multiset<std::tuple<Place, float, std::array<Place, 3>, Label>> samples;
  std::multiset<std::pair<Place, float>> points;
  for (std::size_t v = 0; v < mesh.points.size(); ++v)
    points.insert({ coordinates(mesh.points[v]), ambient.lengths[v] });
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t)
  {
    std::array<Place, 4> corners;
    for (int k = 0; k < 4; ++k) corners[k] = coordinates(mesh.points[mesh.tetrahedra[t][k]]);
    std::sort(corners.begin(), corners.end());
    tets.insert({ corners, mesh.labels[t] });
  }
  for (const auto& e : ambient.samples)
  {
    std::array<Place, 3> corners;
    for (int k = 0; k < 3; ++k)
      corners[k] = coordinates(mesh.points[mesh.tetrahedra[e.tetrahedron][(e.face + 1 + k) & 3]]);
    std::sort(corners.begin(), corners.end());
    samples.insert({ coordinates(e.position), e.tolerance, corners, mesh.labels[e.tetrahedron] });
  }
  return std::tuple(points, tets, samples);
}

/// The same arrays, to the last bit and in the same order.
bool identical(const BackgroundMesh& a, const BackgroundMesh& b)
{
  const auto sameSamples = [](const BackgroundMesh::Sample& x, const BackgroundMesh::Sample& y)
  {
    return x.position == y.position && x.tolerance == y.tolerance && x.tetrahedron == y.tetrahedron && x.face == y.face;
  };
  return a.mesh.points == b.mesh.points && a.mesh.tetrahedra == b.mesh.tetrahedra && a.mesh.labels == b.mesh.labels &&
         a.lengths == b.lengths &&
         std::equal(a.samples.begin(), a.samples.end(), b.samples.begin(), b.samples.end(), sameSamples);
}

void coarsen(TetComplex& block)
{
  GuardedOperations operations(block, scale);
  coarsenBlock(operations, 2.4, {});
}

BackgroundMesh coarsened(BackgroundMesh ambient, std::size_t tetrahedraPerBlock, int rounds = 3)
{
  for (int round = 0; round < rounds; ++round) sweepBlocks(ambient, round, tetrahedraPerBlock, coarsen);
  return ambient;
}

void expectSamplesOnTheirFaces(const BackgroundMesh& ambient)
{
  const auto neighbours = faceAdjacency(ambient.mesh);
  for (const auto& e : ambient.samples)
  {
    const std::int32_t n = neighbours.across[e.tetrahedron][e.face];
    ASSERT_GE(n, 0);
    EXPECT_GT(ambient.mesh.labels[e.tetrahedron], ambient.mesh.labels[n]);
    const auto [a, b, c] = faceKey(ambient.mesh.tetrahedra[e.tetrahedron], e.face);
    const auto& p = ambient.mesh.points;
    EXPECT_LE(squaredDistanceToTriangle(e.position, p[a], p[b], p[c]), e.tolerance * e.tolerance * (1 + 1e-6));
  }
}

/// Points on the hull of the mesh, in order.
std::set<std::array<double, 3>> hull(const TetMesh& mesh)
{
  std::set<std::array<double, 3>> found;
  const auto neighbours = faceAdjacency(mesh);
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t)
  {
    for (int i = 0; i < 4; ++i)
    {
      if (neighbours.across[t][i] >= 0) continue;
      for (std::int32_t v : faceKey(mesh.tetrahedra[t], i)) found.insert(coordinates(mesh.points[v]));
    }
  }
  return found;
}

} // namespace

TEST(BlockSweep, WithNothingToDoNothingChanges)
{
  for (unsigned seed = 1; seed <= 4; ++seed)
  {
    const BackgroundMesh before = randomAmbient(seed, 3);
    ASSERT_FALSE(before.samples.empty());
    for (std::size_t size : { 1u, 2u, 3u, 50u, 700u, 1000000u })
    {
      for (int round = 0; round < 3; ++round)
      {
        BackgroundMesh after = before;
        sweepBlocks(after, round, size, [](TetComplex&) {});
        EXPECT_EQ(contents(after), contents(before)) << "blocks of " << size << ", round " << round;
      }
    }
  }
}

TEST(BlockSweep, EveryTetrahedronIsInOneConsistentBlockOfTheSizeAllowed)
{
  BackgroundMesh ambient = randomAmbient(5, 3);
  std::mutex mutex;
  std::size_t tetrahedra = 0, samples = 0;
  double most = 0;
  sweepBlocks(ambient, 1, 300,
              [&](TetComplex& block)
              {
                const std::lock_guard<std::mutex> lock(mutex);
                EXPECT_TRUE(isConsistent(block));
                EXPECT_EQ(attachedSamples(block), block.samples.size());
                tetrahedra += block.tets.size();
                samples += block.samples.size();
                double cost = 0;
                for (const Label label : block.labels) cost += label == 0 ? backgroundCost : 1;
                most = std::max(most, cost);
              });
  EXPECT_EQ(tetrahedra, ambient.mesh.tetrahedra.size());
  EXPECT_EQ(samples, ambient.samples.size());
  EXPECT_LE(most, 300);
}

TEST(BlockSweep, CoarseningBlockwiseKeepsTissuesHullAndSamples)
{
  for (unsigned seed = 1; seed <= 4; ++seed)
  {
    const BackgroundMesh before = randomAmbient(seed, 1); // of two labels: they cannot cease to touch
    const BackgroundMesh after = coarsened(before, 300);
    EXPECT_LT(after.mesh.tetrahedra.size(), before.mesh.tetrahedra.size());
    requireSound(after.mesh, "coarsening");
    EXPECT_EQ(meshTopology(withBackgroundAsTissue(after.mesh)), meshTopology(withBackgroundAsTissue(before.mesh)));
    EXPECT_NEAR(volumeOf(after.mesh), volumeOf(before.mesh), 1e-9 * volumeOf(before.mesh));
    EXPECT_EQ(hull(after.mesh), hull(before.mesh));
    EXPECT_EQ(after.samples.size(), before.samples.size());
    EXPECT_EQ(after.lengths.size(), after.mesh.points.size());
    expectSamplesOnTheirFaces(after);
  }
}

TEST(BlockSweep, NeighboursAreThoseOfTheMeshWhateverTheBlocks)
{
  const BackgroundMesh before = randomAmbient(5, 3);
  for (std::size_t size : { 1u, 50u, 300u, 1000000u })
  {
    BackgroundMesh ambient = before;
    for (int round = 0; round < 3; ++round)
    {
      sweepBlocks(ambient, round, size, coarsen);
      EXPECT_EQ(ambient.neighbours, faceAdjacency(ambient.mesh).across) << "blocks of " << size << ", round " << round;
    }
  }
}

TEST(BlockSweep, GivenNeighboursLeadToTheSameMesh)
{
  BackgroundMesh given = randomAmbient(4, 3), found = given;
  for (int round = 0; round < 3; ++round)
  {
    sweepBlocks(given, round, 300, coarsen);
    found.neighbours.clear();
    sweepBlocks(found, round, 300, coarsen);
    EXPECT_TRUE(identical(given, found)) << "round " << round;
  }
}

TEST(BlockSweep, BytesDoNotDependOnThreadsNorOnTheRun)
{
  const BackgroundMesh before = randomAmbient(6, 4);
  vtkSMPTools::Initialize(1);
  const BackgroundMesh alone = coarsened(before, 200);
  EXPECT_TRUE(identical(alone, coarsened(before, 200)));
  vtkSMPTools::Initialize(2);
  for (int run = 0; run < 3; ++run) EXPECT_TRUE(identical(alone, coarsened(before, 200)));
  vtkSMPTools::Initialize(0);
}

TEST(BlockSweep, RoundsFreeWhatOthersLock)
{
  const BackgroundMesh before = ambientOf(paintedMap({ 18, 18, 18 }, [](int, int, int) { return 0; }));
  const auto outer = hull(before.mesh);
  std::array<std::set<std::array<double, 3>>, 3> locked;
  for (int round = 0; round < 3; ++round)
  {
    BackgroundMesh ambient = before;
    std::mutex mutex;
    sweepBlocks(ambient, round, 12000,
                [&](TetComplex& block)
                {
                  const std::lock_guard<std::mutex> lock(mutex);
                  for (std::size_t v = 0; v < block.points.size(); ++v)
                  {
                    const auto p = coordinates(block.points[v]);
                    if (block.locked[v] && !outer.count(p)) locked[round].insert(p);
                  }
                });
    EXPECT_FALSE(locked[round].empty());
  }
  std::size_t always = 0;
  for (const auto& p : locked[0]) always += locked[1].count(p) && locked[2].count(p);
  EXPECT_LT(always, locked[0].size() / 5);
}

TEST(BlockSweep, AThrowPropagatesAndLeavesTheMeshAsItWas)
{
  const BackgroundMesh before = randomAmbient(7, 2);
  for (int threads : { 1, 2 })
  {
    vtkSMPTools::Initialize(threads);
    BackgroundMesh ambient = before;
    std::atomic<int> blocks{ 0 };
    const auto fail = [&](TetComplex& block)
    {
      coarsen(block);
      GuardedOperations operations(block, scale);
      for (std::int32_t v = 0; v < std::int32_t(block.points.size()); ++v)
      {
        if (block.vertexTet[v] >= 0) operations.move(v, block.points[v] + Vec3{ 0.01, 0, 0 }, 1e-6);
      }
      if (++blocks == 4) throw std::runtime_error("the fourth");
    };
    EXPECT_THROW(sweepBlocks(ambient, 0, 200, fail), std::runtime_error);
    EXPECT_TRUE(identical(ambient, before));
    const auto cancel = [](double fraction, const std::string&)
    {
      if (fraction > 0.5) throw std::logic_error("cancelled");
    };
    EXPECT_THROW(sweepBlocks(ambient, 0, 200, coarsen, cancel), std::logic_error);
    EXPECT_TRUE(identical(ambient, before));
  }
  vtkSMPTools::Initialize(0);
}

TEST(BlockSweep, FairBlocksOfASmallMeshAreSmaller)
{
  const auto defaultSizeOf = [](std::size_t tissue, std::size_t background)
  {
    TetMesh mesh;
    mesh.labels.assign(tissue, 7);
    mesh.labels.resize(tissue + background, 0);
    return defaultBlockSize(mesh);
  };
  const std::size_t large = defaultSizeOf(1000000, 0), small = defaultSizeOf(40000, 0);
  EXPECT_LT(2 * small, 40000u);
  EXPECT_LT(2 * small, large);
  EXPECT_EQ(defaultSizeOf(40000, 50000), small) << "background is worth little";
  EXPECT_EQ(defaultSizeOf(40000, 100000), large);
}

TEST(BlockSweep, ProgressRisesWithinItsRange)
{
  BackgroundMesh ambient = randomAmbient(8, 2);
  double last = 0;
  int calls = 0;
  sweepBlocks(
    ambient, 0, 300, [](TetComplex&) {},
    [&](double fraction, const std::string&)
    {
      EXPECT_GE(fraction, last);
      EXPECT_LE(fraction, 1);
      last = fraction;
      ++calls;
    });
  EXPECT_GT(calls, 3);
}

TEST(BlockSweep, AWholeSweepReportsItsStagesAndEndsBetweenThem)
{
  const BackgroundMesh before = randomAmbient(8, 2);
  const Stage stage{ {}, { Coarsen{ 2, {} } } };
  const Sweep sweep{ "three stages", { stage, stage, stage }, true };
  std::vector<double> fractions;
  Remesher all(before, scale, {}, [&](double fraction, const std::string&) { fractions.push_back(fraction); });
  all.run(sweep);
  EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()));
  for (const double share : { 1 / 3.0, 2 / 3.0 })
    EXPECT_NE(std::find(fractions.begin(), fractions.end(), share), fractions.end()) << share;

  const auto cancel = [](double fraction, const std::string&)
  {
    if (fraction > 0.5) throw std::runtime_error("cancelled");
  };
  Remesher cancelled(before, scale, {}, cancel);
  EXPECT_THROW(cancelled.run(sweep), std::runtime_error);
  EXPECT_TRUE(identical(cancelled.background(), before));
}

} // namespace surgicalmesher
