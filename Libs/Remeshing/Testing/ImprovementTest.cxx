// SPDX-License-Identifier: Apache-2.0
#include "Improvement.h"
#include "Bending.h"
#include "Coarsening.h"
#include "ComplexInvariants.h"
#include "EdgeSwaps.h"
#include "EvenLengths.h"
#include "HeightRaising.h"
#include "InterfaceRelabelling.h"
#include "MeshQuality.h"
#include "Polishing.h"
#include "RandomMaps.h"
#include "Relaxation.h"
#include "Schedule.h"
#include "SpikeRemoval.h"
#include "StiffPairs.h"
#include "TetrahedraImprovement.h"
#include "TissueOffsets.h"
#include "VertexSteps.h"

#include <gtest/gtest.h>
#include <vtkSMPTools.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <set>
#include <stdexcept>
#include <tuple>

namespace surgicalmesher
{
namespace
{

using namespace test;

const SizingFunction scale = [](const Vec3&) { return 1.5f; };

/// Shaken so that bad angles are about, yet positive.
TetMesh shaken(TetMesh mesh, std::mt19937& random, double vertexDistance)
{
  TetComplex complex = complexOf(mesh);
  const auto uniform = [&] { return random() / 2147483648.0 - 1; };
  std::vector<std::int32_t> star;
  for (std::int32_t v = 0; v < std::int32_t(mesh.points.size()); ++v)
  {
    if (complex.locked[v]) continue;
    complex.star(v, star);
    const Vec3 p = complex.points[v] + vertexDistance * Vec3{ uniform(), uniform(), uniform() };
    if (std::all_of(star.begin(), star.end(), [&](std::int32_t t) { return complex.qualityWith(t, v, p) > 1e-4; }))
      complex.points[v] = p;
  }
  mesh.points = complex.points;
  return mesh;
}

double worstOf(const TetMesh& mesh)
{
  double worst = 1;
  for (const auto& [a, b, c, d] : mesh.tetrahedra)
    worst = std::min(worst, worstSine2(mesh.points[a], mesh.points[b], mesh.points[c], mesh.points[d]));
  return worst;
}

/// Runs `work` on shaken random lattices and checks what no work on a block may break.
void expectPromisesKept(double worstMayFallTo, bool mustImprove, const std::function<void(GuardedOperations&)>& work)
{
  int improved = 0;
  for (unsigned seed = 1; seed <= 10; ++seed)
  {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    const TissueMap map = randomWellComposedMap(random, { 5, 5, 5 }, 1 + int(seed % 4));
    TetComplex complex = complexOf(shaken(tetrahedraOf(map), random, 0.35), 1.5f, 0.4f);
    GuardedOperations operations(complex, scale);
    const double before = worstQuality(operations, complex);
    const auto topology = meshTopology(withBackgroundAsTissue(meshOf(complex)));
    const double volume = volumeOf(meshOf(complex));
    const ComplexState start(complex);
    const auto places = samplePlaces(complex);
    work(operations);
    ASSERT_TRUE(isConsistent(complex));
    EXPECT_GE(worstQuality(operations, complex), std::min(before, worstMayFallTo));
    improved += worstQuality(operations, complex) > before;
    EXPECT_EQ(meshTopology(withBackgroundAsTissue(meshOf(complex))), topology);
    EXPECT_NEAR(volumeOf(meshOf(complex)), volume, 1e-9 * volume);
    for (const auto& [label, tissue] : checkSurface(interfaceOf(withBackgroundAsTissue(meshOf(complex)))))
      EXPECT_TRUE(tissue.manifold()) << "label " << label;
    for (std::size_t v = 0; v < start.points.size(); ++v)
      EXPECT_TRUE(!start.locked[v] || complex.points[v] == start.points[v]);
    const auto after = samplePlaces(complex);
    for (std::size_t e = 0; e < places.size(); ++e)
    {
      if (after[e].tet < 0) continue;
      EXPECT_EQ(after[e].pair, places[e].pair);
      EXPECT_LE(after[e].distance, std::max<double>(places[e].distance, complex.samples[e].tolerance) * (1 + 1e-6));
    }
  }
  EXPECT_TRUE(improved == 10 || !mustImprove) << improved << " of 10";
}

} // namespace

TEST(Relaxation, KeepsEveryPromiseAndAnglesGoodEnough)
{
  const RelaxationOptions options;
  expectPromisesKept(sine2OfDegrees(options.goodAngle), false,
                     [&](GuardedOperations& operations) { relaxBlock(operations, options); });
}

TEST(Improvement, KeepsEveryPromiseAndRaisesTheWorstAngle)
{
  expectPromisesKept(1, true, [](GuardedOperations& operations) { improveBlock(operations); });
}

TEST(Heights, KeepEveryPromiseAndTheLeastRises)
{
  const auto leastOf = [](const TetComplex& complex)
  {
    const TetMesh mesh = meshOf(complex);
    double least = 1e9;
    for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t)
    {
      const auto& [a, b, c, d] = mesh.tetrahedra[t];
      if (mesh.labels[t] == 0) continue;
      least = std::min(least, leastHeight(mesh.points[a], mesh.points[b], mesh.points[c], mesh.points[d]));
    }
    return least;
  };
  HeightOptions options;
  options.height = 0.5;
  int raised = 0;
  const auto raise = [&](GuardedOperations& operations)
  {
    const double before = leastOf(operations.complex());
    raiseHeightsOfBlock(operations, options);
    EXPECT_GE(leastOf(operations.complex()), before);
    raised += leastOf(operations.complex()) > 1.1 * before;
  };
  expectPromisesKept(sine2OfDegrees(options.goodAngle), false, raise);
  EXPECT_GE(raised, 9);
}

TEST(EdgeSwaps, KeepEveryPromiseAndRaiseTheMeanAngle)
{
  const auto meanOf = [](const TetComplex& complex)
  {
    double sum = 0, count = 0;
    for (std::int32_t t = 0; t < std::int32_t(complex.tets.size()); ++t)
      if (complex.alive(t) && complex.labels[t] != 0) sum += std::sqrt(complex.quality(t)), ++count;
    return sum / count;
  };
  const SwapOptions options;
  int raised = 0;
  const auto swap = [&](GuardedOperations& operations)
  {
    const double before = meanOf(operations.complex());
    swapEdgesOfBlock(operations, options);
    EXPECT_GT(operations.counts().flips, 0);
    EXPECT_GE(meanOf(operations.complex()), before);
    raised += meanOf(operations.complex()) > 1.02 * before;
  };
  expectPromisesKept(sine2OfDegrees(options.goodAngle), false, swap);
  EXPECT_EQ(raised, 10);
}

/// Sum over the edges of two triangles of length times angle.
double bendingOfInterface(const TetComplex& complex)
{
  const SurfaceComplex surface = interfaceOf(meshOf(complex));
  std::map<std::array<std::int32_t, 2>, std::vector<std::int32_t>> apexes;
  for (const auto& t : surface.triangles)
    for (int k = 0; k < 3; ++k)
    {
      const auto [a, b] = std::minmax(t[k], t[(k + 1) % 3]);
      apexes[{ a, b }].push_back(t[(k + 2) % 3]);
    }
  double sum = 0;
  for (const auto& [ends, others] : apexes)
  {
    if (others.size() != 2) continue;
    const Vec3 &from = surface.points[ends[0]], edge = surface.points[ends[1]] - from;
    sum += norm(edge) * deflection(edge, surface.points[others[0]] - from, surface.points[others[1]] - from);
  }
  return sum;
}

TEST(EdgeSwaps, LeaveASheetFlatterIfAskedFor)
{
  const TissueMap halves = paintedMap({ 8, 8, 8 }, [](int, int, int k) { return k < 4 ? 1 : 2; });
  std::mt19937 random(1);
  const TetMesh rough = shaken(tetrahedraOf(halves), random, 0.35);
  std::vector<double> after;
  for (const double smoothness : { 0.0, 3.0 })
  {
    TetComplex complex = complexOf(rough, 1.5f, 0.4f);
    GuardedOperations operations(complex, scale);
    swapEdgesOfBlock(operations, { 5, smoothness });
    ASSERT_TRUE(isConsistent(complex));
    after.push_back(bendingOfInterface(complex));
  }
  EXPECT_LT(after[1], 0.97 * after[0]);
}

TEST(EdgeSwaps, FindNothingMoreTheSecondTime)
{
  TetComplex complex = complexOf(tetrahedraOf(paintedMap({ 6, 6, 6 }, [](int, int, int) { return 1; })), 1.5f);
  GuardedOperations operations(complex, scale);
  swapEdgesOfBlock(operations);
  const long flips = operations.counts().flips;
  swapEdgesOfBlock(operations);
  EXPECT_EQ(operations.counts().flips, flips);
}

/// Whether edge ab of t could be swapped, were nothing remembered.
bool isSwappable(TetComplex complex, std::int32_t t, std::int32_t a, std::int32_t b,
                 const GuardedOperations::SwapGoal& goal)
{
  return GuardedOperations(complex, scale).swapEdge(a, b, t, goal);
}

TEST(EdgeSwaps, RememberOnlyWhatIsStillRefused)
{
  const GuardedOperations::SwapGoal goal{ sine2OfDegrees(5), 0.75, 3, 0.03 };
  int known = 0, done = 0;
  for (const int labels : { 1, 2 })
  {
    const TissueMap map = paintedMap({ 5, 5, 5 }, [&](int, int, int k) { return k < 2 ? 1 : labels; });
    std::mt19937 random(1);
    TetComplex complex = complexOf(shaken(tetrahedraOf(map), random, 0.35), 1.5f, 0.4f);
    GuardedOperations operations(complex, scale);
    SwapRefusals refusals(complex.tets.size());
    for (std::int32_t t = 0; t < std::int32_t(complex.tets.size()); ++t)
      for (const auto& e : kEdgeCorners)
      {
        if (!complex.alive(t)) break;
        const std::int32_t a = complex.tets[t][e[0]], b = complex.tets[t][e[1]];
        std::vector<std::int32_t> ring, vertices;
        const bool isKnown = complex.ring(a, b, t, ring, vertices) && refusals.contains(complex, a, b, ring);
        const bool isDone = operations.swapEdge(a, b, t, goal, &refusals);
        known += isKnown;
        done += isDone;
        EXPECT_FALSE(isKnown && (isDone || isSwappable(complex, t, a, b, goal))) << "edge " << a << " " << b;
      }
    EXPECT_TRUE(isConsistent(complex));
  }
  EXPECT_GT(known, 1000);
  EXPECT_GT(done, 100);
}

/// Along the diagonal: Kuhn's lattice becomes Fuchs's.
void halve(TetMesh& mesh)
{
  for (Vec3& p : mesh.points) p -= (p.x + p.y + p.z) / 6 * Vec3{ 1, 1, 1 };
}

/// Fuchs's lattice of one tissue, one vertex in five moved.
TetMesh latticeWithFaults(std::mt19937& random)
{
  TetMesh mesh = tetrahedraOf(paintedMap({ 6, 6, 6 }, [](int, int, int) { return 1; }));
  halve(mesh);
  const TetMesh moved = shaken(mesh, random, 0.3);
  for (std::size_t v = 0; v < mesh.points.size(); ++v)
    if (random() % 5 == 0) mesh.points[v] = moved.points[v];
  return mesh;
}

std::vector<std::int32_t> wholeVertices(GuardedOperations& operations)
{
  std::vector<std::int32_t> result;
  for (std::int32_t v = 0; v < std::int32_t(operations.complex().points.size()); ++v)
    if (operations.complex().vertexTet[v] >= 0 && isWhole(operations, v)) result.push_back(v);
  return result;
}

TEST(EdgeSwaps, SpareTheLatticesVerticesIfAskedFor)
{
  int lost = 0, flips = 0;
  for (unsigned seed = 1; seed <= 5; ++seed)
    for (const bool spares : { true, false })
    {
      std::mt19937 random(seed);
      TetComplex complex = complexOf(latticeWithFaults(random));
      GuardedOperations operations(complex, scale);
      const std::vector<std::int32_t> whole = wholeVertices(operations);
      ASSERT_GT(whole.size(), 10u);
      swapEdgesOfBlock(operations, { 5, 3, spares });
      const auto isLost = [&](std::int32_t v) { return !isWhole(operations, v); };
      if (!spares) lost += int(std::count_if(whole.begin(), whole.end(), isLost));
      else EXPECT_TRUE(std::none_of(whole.begin(), whole.end(), isLost)) << "seed " << seed;
      if (spares) flips += int(operations.counts().flips);
    }
  EXPECT_GT(flips, 0);
  EXPECT_GT(lost, 0) << "nothing to spare";
}

/// Of all pairs of neighbours in tissues.
double largestPairEigenvalue(const TetComplex& complex)
{
  std::set<std::pair<std::int32_t, std::int32_t>> pairs;
  for (std::int32_t t = 0; t < std::int32_t(complex.tets.size()); ++t)
    if (complex.alive(t) && complex.labels[t] != 0)
      for (const auto& [i, k] : kEdgeCorners) pairs.insert(std::minmax(complex.tets[t][i], complex.tets[t][k]));
  double largest = 0;
  for (const auto& [a, b] : pairs) largest = std::max(largest, pairEigenvalue(complex, a, b));
  return largest;
}

TEST(StiffPairs, KeepEveryPromiseAndTheLargestEigenvalueFalls)
{
  const StiffPairOptions options;
  int fallen = 0;
  const auto soften = [&](GuardedOperations& operations)
  {
    const double before = largestPairEigenvalue(operations.complex());
    softenPairsOfBlock(operations, options);
    const double after = largestPairEigenvalue(operations.complex());
    EXPECT_LE(after, 1.05 * before); // pairs of neighbours of what moves may become stiffer
    fallen += after < 0.95 * before;
  };
  expectPromisesKept(sine2OfDegrees(options.goodAngle), false, soften);
  EXPECT_GE(fallen, 8);
}

TEST(StiffPairs, AreSoftenedBeforeHeightsAreRaisedWhateverTheMesh)
{
  for (const auto& sweeps : { sweepsForRawMesh(28.5, 1), sweepsForImprovedMesh(28.5, 1), sweepsForCurves(28.5, 1) })
  {
    const std::vector<Stage>& stages = sweeps.back().sweep.stages;
    ASSERT_GE(stages.size(), 3u);
    const Stage* const last = &stages[stages.size() - 3];
    EXPECT_TRUE(std::holds_alternative<SoftenPairs>(last[0].passes.front()));
    for (const std::size_t k : { 1, 2 }) EXPECT_TRUE(std::holds_alternative<RaiseHeights>(last[k].passes.front()));
    EXPECT_EQ(last[1].bounds.toleranceFactor, 1);
    EXPECT_GT(last[2].bounds.toleranceFactor, 1) << "heights leave the tolerance where they did not rise within it";
    EXPECT_TRUE(sweeps.back().sweep.whole);
  }
}

TEST(StiffPairs, AreMeasuredWhateverTheSizeOfElements)
{
  std::mt19937 random(1);
  TetMesh mesh = shaken(tetrahedraOf(paintedMap({ 3, 3, 3 }, [](int, int, int) { return 1; })), random, 0.3);
  const double value = largestPairEigenvalue(complexOf(mesh));
  for (Vec3& p : mesh.points) p = 7.0 * p;
  EXPECT_NEAR(largestPairEigenvalue(complexOf(mesh)), value, 1e-9 * value);
  EXPECT_GT(value, 1);
  EXPECT_LE(value, 6); // the trace
}

TEST(StiffPairs, AreNoneInsideTheLattice)
{
  TetMesh mesh = tetrahedraOf(paintedMap({ 4, 4, 4 }, [](int, int, int) { return 1; }));
  halve(mesh);
  const TetComplex complex = complexOf(mesh);
  int inside = 0;
  for (std::int32_t t = 0; t < std::int32_t(complex.tets.size()); ++t)
    for (const auto& [i, k] : kEdgeCorners)
    {
      const std::int32_t a = complex.tets[t][i], b = complex.tets[t][k];
      if (complex.labels[t] == 0 || complex.onInterface[a] || complex.onInterface[b]) continue;
      EXPECT_LT(pairEigenvalue(complex, a, b), StiffPairOptions().eigenvalue);
      ++inside;
    }
  EXPECT_GT(inside, 100);
}

TEST(TissueOffsets, KeepEveryPromise)
{
  const TissueOffsetOptions options{ { { 1, 0.1 }, { 2, -0.05 } } };
  expectPromisesKept(sine2OfDegrees(options.goodAngle), false,
                     [&](GuardedOperations& operations)
                     {
                       offsetTissuesOfBlock(operations, options);
                       EXPECT_GT(operations.counts().moves, 0);
                     });
}

TEST(TissueOffsets, MoveAWallByTheDifference)
{
  const TissueMap halves = paintedMap({ 6, 6, 6 }, [](int, int, int k) { return k < 3 ? 1 : 2; });
  TetComplex complex = complexOf(tetrahedraOf(halves), 1.5f, 0.4f);
  const ComplexState before(complex);
  GuardedOperations operations(complex, scale);
  offsetTissuesOfBlock(operations, { { { 1, 0.05 }, { 2, -0.03 } } });
  ASSERT_TRUE(isConsistent(complex));
  int ofWall = 0;
  for (std::size_t v = 0; v < before.points.size(); ++v)
  {
    const Vec3 p = before.points[v];
    if (std::abs(p.z - 2.5) > 0.01 || std::max(std::abs(p.x - 2.5), std::abs(p.y - 2.5)) > 2.9) continue;
    EXPECT_NEAR(complex.points[v].z - p.z, 0.08, 0.01); // a spring holds it a little
    ++ofWall;
  }
  EXPECT_EQ(ofWall, 25);
}

TEST(Heights, OfATissueThatIsThinItselfAreLeft)
{
  const auto rod = [](int i, int j, int) { return i >= 2 && i < 4 && j >= 2 && j < 4 ? 1 : 0; };
  TetComplex complex = complexOf(tetrahedraOf(paintedMap({ 6, 6, 30 }, rod)), 3, 1); // its tolerances are wide
  GuardedOperations operations(complex, [](const Vec3&) { return 3.0f; });
  HeightOptions options;
  options.height = 1.2; // the rod's are all half of that
  raiseHeightsOfBlock(operations, options);
  EXPECT_EQ(operations.counts().moves + operations.counts().collapses + operations.counts().flips, 0);
}

/// Puts p, near the middle of a face, in its place; the last point then.
void splitFace(TetMesh& mesh, std::int32_t t, int face, const Vec3& p)
{
  const std::int32_t across = faceAdjacency(mesh).across[t][face], v = std::int32_t(mesh.points.size());
  const std::array<std::int32_t, 3> corners = faceKey(mesh.tetrahedra[t], face);
  mesh.points.push_back(p);
  for (const std::int32_t s : { t, across })
  {
    const TetComplex::Tet old = mesh.tetrahedra[s];
    for (int k = 0; k < 3; ++k)
    {
      TetComplex::Tet part = old;
      std::replace(part.begin(), part.end(), corners[k], v);
      if (k == 0) mesh.tetrahedra[s] = part;
      else
      {
        mesh.tetrahedra.push_back(part);
        mesh.labels.push_back(mesh.labels[s]);
      }
    }
  }
}

/// A vertex in a triangle of a wall between two tissues would go far between the samples of its three triangles.
TEST(Heights, TipsStay)
{
  TetMesh mesh = tetrahedraOf(paintedMap({ 6, 6, 6 }, [](int, int, int k) { return k < 3 ? 1 : 2; }));
  const std::vector<InterfaceFace> faces = interfaceFaces(mesh);
  const auto fromMiddle = [&](const InterfaceFace& f)
  {
    const auto [a, b, c] = faceKey(mesh.tetrahedra[f.tetrahedron], f.face);
    return norm((mesh.points[a] + mesh.points[b] + mesh.points[c]) / 3.0 - Vec3{ 2.4, 2.3, 2.5 });
  };
  const InterfaceFace middle =
    *std::min_element(faces.begin(), faces.end(),
                      [&](const InterfaceFace& f, const InterfaceFace& g) { return fromMiddle(f) < fromMiddle(g); });
  const auto [a, b, c] = faceKey(mesh.tetrahedra[middle.tetrahedron], middle.face);
  const Vec3 tip = (2 * mesh.points[a] + mesh.points[b] + mesh.points[c]) / 4.0;
  mesh.labels[middle.tetrahedron] = 3; // the triangle's edges part three tissues, and stay
  splitFace(mesh, middle.tetrahedron, middle.face, tip);
  TetComplex complex = complexOf(mesh, 1.5f, 1);
  for (std::uint8_t& locked : complex.locked) locked = true;
  const auto v = std::int32_t(mesh.points.size()) - 1;
  complex.locked[v] = false;
  GuardedOperations operations(complex, scale);
  ASSERT_EQ(operations.sheet(v).faces.size(), 3u);
  HeightOptions options;
  options.height = 1;
  options.goodAngle = 1;
  options.longEdge = 0; // no collapse: it would do as well
  raiseHeightsOfBlock(operations, options);
  ASSERT_GE(complex.vertexTet[v], 0);
  EXPECT_EQ(complex.points[v], tip);
}

TEST(Heights, AreLeftWhereTheyAreHighEnough)
{
  TetComplex complex = complexOf(tetrahedraOf(paintedMap({ 6, 6, 6 }, [](int, int, int) { return 1; })), 1.5f);
  GuardedOperations operations(complex, scale);
  HeightOptions options;
  options.height = 0.4; // the lattice's are 0.5 and more
  raiseHeightsOfBlock(operations, options);
  EXPECT_EQ(operations.counts().moves + operations.counts().collapses, 0);
}

TEST(Improvement, HeldInterfaceStaysAsItIs)
{
  for (unsigned seed = 1; seed <= 6; ++seed)
  {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    const TissueMap map = randomWellComposedMap(random, { 6, 6, 6 }, 1 + int(seed % 2));
    TetComplex complex = complexOf(shaken(tetrahedraOf(map), random, 0.35), 1.5f, 0.4f);
    const auto placed = [&]
    {
      const SurfaceComplex surface = interfaceOf(meshOf(complex));
      std::vector<std::array<Vec3, 3>> triangles;
      for (const auto& [a, b, c] : surface.triangles)
        triangles.push_back({ surface.points[a], surface.points[b], surface.points[c] });
      const auto before = [](const Vec3& p, const Vec3& q)
      { return std::tie(p.x, p.y, p.z) < std::tie(q.x, q.y, q.z); };
      for (auto& t : triangles) std::rotate(t.begin(), std::min_element(t.begin(), t.end(), before), t.end());
      std::sort(triangles.begin(), triangles.end(),
                [&](const auto& s, const auto& t)
                { return std::lexicographical_compare(s.begin(), s.end(), t.begin(), t.end(), before); });
      return triangles;
    };
    const auto start = placed();
    GuardedOperations operations(complex, scale, { .interfaceHeld = true });
    ImprovementOptions options;
    options.targetAngle = 40;
    options.splitEdge = 0.5;
    options.together = 10;
    coarsenBlock(operations, 1e9, {});
    relaxBlock(operations);
    polishBlock(operations);
    improveBlock(operations, options);
    HeightOptions heights;
    heights.height = 1;
    raiseHeightsOfBlock(operations, heights);
    ASSERT_TRUE(isConsistent(complex));
    EXPECT_EQ(placed(), start);
    EXPECT_GT(operations.counts().moves + operations.counts().flips + operations.counts().splits, 0);
  }
}

TEST(Improvement, MovingTogetherKeepsEveryPromiseAndGetsFarther)
{
  const auto sumOfWorst = [](int together, bool split, int patience)
  {
    double sum = 0;
    expectPromisesKept(1, true,
                       [&](GuardedOperations& operations)
                       {
                         ImprovementOptions options;
                         options.split = split;
                         options.splitEdge = 1e9; // by itself no split is good enough
                         options.targetAngle = 40;
                         options.together = together;
                         options.patience = patience;
                         improveBlock(operations, options);
                         sum += worstQuality(operations, operations.complex());
                       });
    return sum;
  };
  const double alone = sumOfWorst(0, false, 0), together = sumOfWorst(20, false, 3);
  EXPECT_GT(together, alone);
  EXPECT_GT(sumOfWorst(20, true, 3), alone);
  EXPECT_GT(sumOfWorst(20, false, 20), together);
}

/// Edges of even length, those inside a label counted as evenLengthsOfBlock does.
double evenEdges(const TetComplex& c, GuardedOperations& operations)
{
  double sum = 0;
  for (std::int32_t v = 0; v < std::int32_t(c.points.size()); ++v)
  {
    if (c.vertexTet[v] < 0) continue;
    for (const auto& n : operations.neighbours(v))
    {
      const double ratio = norm(c.points[n.vertex] - c.points[v]) / c.targetLength(v, n.vertex);
      if (n.vertex > v && ratio >= shortestEven && ratio <= longestEven) sum += n.alongInterface ? 1 : insideLabel;
    }
  }
  return sum;
}

TEST(Improvement, LeavingCrowdsKeepsEveryPromiseAndTriesLess)
{
  const auto movesAndWorst = [](double crowd)
  {
    std::pair<std::size_t, double> sums{ 0, 0 };
    expectPromisesKept(1, true,
                       [&](GuardedOperations& operations)
                       {
                         ImprovementOptions options;
                         options.splitEdge = 0.8;
                         options.together = 20;
                         options.crowd = crowd;
                         improveBlock(operations, options);
                         sums.first += operations.counts().moves;
                         sums.second += worstQuality(operations, operations.complex());
                       });
    return sums;
  };
  const auto left = movesAndWorst(0.07);
  EXPECT_LT(left.first, movesAndWorst(1).first);
  EXPECT_EQ(movesAndWorst(0.07), left);
}

TEST(EdgeLengths, KeepEveryPromiseAndBecomeMoreEven)
{
  double before = 0, after = 0;
  expectPromisesKept(sine2OfDegrees(usualAngle), false,
                     [&](GuardedOperations& operations)
                     {
                       const double start = evenEdges(operations.complex(), operations);
                       evenLengthsOfBlock(operations);
                       const double end = evenEdges(operations.complex(), operations);
                       EXPECT_GE(end, start - 1e-9);
                       EXPECT_EQ(operations.counts().collapses + operations.counts().splits + operations.counts().flips,
                                 0);
                       before += start;
                       after += end;
                     });
  EXPECT_GT(after, 1.01 * before);
}

TEST(EdgeLengths, StayWhereTheTargetIsSmall)
{
  std::mt19937 random(1);
  TetComplex complex =
    complexOf(shaken(tetrahedraOf(randomWellComposedMap(random, { 5, 5, 5 }, 3)), random, 0.35), 1.5f);
  const ComplexState before(complex);
  GuardedOperations operations(complex, scale);
  EdgeLengthOptions options;
  options.from = 1.6;
  evenLengthsOfBlock(operations, options);
  EXPECT_EQ(before.points, complex.points);
  options.from = 1.5;
  evenLengthsOfBlock(operations, options);
  EXPECT_GT(operations.counts().moves, 0);
}

TEST(Improvement, WithoutSplitsAddsNoVertex)
{
  ImprovementOptions options;
  options.split = false;
  expectPromisesKept(1, true,
                     [&](GuardedOperations& operations)
                     {
                       const std::size_t vertices = operations.complex().points.size();
                       improveBlock(operations, options);
                       EXPECT_EQ(operations.counts().splits, 0);
                       EXPECT_EQ(operations.complex().points.size(), vertices);
                     });
}

TEST(Improvement, LeavesAGoodLatticeAlone)
{
  TetComplex complex =
    complexOf(tetrahedraOf(paintedMap({ 4, 4, 4 }, [](int i, int, int) { return i < 2 ? 1 : 2; })), 1.5f);
  GuardedOperations operations(complex, scale);
  const ComplexState before(complex);
  improveBlock(operations); // all angles of the lattice are 45 degrees or more
  EXPECT_TRUE(ComplexState(complex) == before);
}

TEST(Relaxation, BringsADisturbedSheetBackToItsSamples)
{
  std::mt19937 random(3);
  const auto uniform = [&] { return random() / 2147483648.0 - 1; };
  TetComplex complex = complexOf(tetrahedraOf(paintedMap({ 6, 6, 6 }, [](int, int, int k) { return k < 3; })), 1.5f, 1);
  const auto rms = [&]
  {
    double sum = 0;
    const auto places = samplePlaces(complex);
    for (const SamplePlace& p : places) sum += p.distance * p.distance;
    return std::sqrt(sum / double(places.size()));
  };
  GuardedOperations operations(complex, scale);
  for (std::int32_t v = 0; v < std::int32_t(complex.points.size()); ++v)
    operations.move(v, complex.points[v] + 0.3 * Vec3{ uniform(), uniform(), uniform() }, sine2OfDegrees(5));
  const double before = rms();
  ASSERT_GT(before, 0.03);
  for (int i = 0; i < 5; ++i) relaxBlock(operations);
  EXPECT_LT(rms(), before / 4);
}

TEST(Coarsening, KeepsEveryPromiseAndTheAngleAsked)
{
  CoarseningOptions options;
  expectPromisesKept(sine2OfDegrees(options.minimumAngle), false,
                     [&](GuardedOperations& operations)
                     {
                       const std::size_t before = meshOf(operations.complex()).tetrahedra.size();
                       coarsenBlock(operations, 3, options);
                       EXPECT_LT(meshOf(operations.complex()).tetrahedra.size(), before);
                     });
}

TEST(MeshImprovement, KeepsTissuesAndHullAndRaisesTheWorstAngle)
{
  for (unsigned seed = 1; seed <= 4; ++seed)
  {
    std::mt19937 random(seed);
    const TissueMap map = randomWellComposedMap(random, { 6, 6, 6 }, 3);
    const TetMesh before = shaken(tetrahedraOf(map), random, 0.35);
    TetMesh after = before;
    improveTetrahedra(after, scale);
    requireSound(after, "improvement");
    EXPECT_GT(worstOf(withoutOutside(after)), worstOf(withoutOutside(before)));
    EXPECT_EQ(meshTopology(withBackgroundAsTissue(after)), meshTopology(withBackgroundAsTissue(before)));
    EXPECT_NEAR(volumeOf(after), volumeOf(before), 1e-9 * volumeOf(before));
  }
}

void relabelAtRandom(GuardedOperations& operations, std::mt19937& random)
{
  const TetComplex& c = operations.complex();
  for (int n = 0; n < 300; ++n)
  {
    const auto t = std::int32_t(random() % c.tets.size());
    if (const std::int32_t across = c.neighbours[t][n % 4]; across >= 0) operations.relabel(t, c.labels[across], 0);
  }
}

TEST(Relabelling, BringsTheSurfaceBackToItsSamples)
{
  constexpr float anyDistance = 10;
  const auto sumOfSquares = [](const TetComplex& complex)
  {
    double sum = 0;
    for (const auto& place : samplePlaces(complex))
      if (place.tet >= 0) sum += place.distance * place.distance;
    return sum;
  };
  for (unsigned seed = 1; seed <= 10; ++seed)
  {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    const TissueMap map = randomWellComposedMap(random, { 5, 5, 5 }, 1 + int(seed % 4));
    TetComplex complex = complexOf(tetrahedraOf(map), 1.5f, anyDistance);
    const auto topology = meshTopology(withBackgroundAsTissue(meshOf(complex)));
    GuardedOperations operations(complex, scale, { 1 });
    relabelAtRandom(operations, random);
    const double before = sumOfSquares(complex);
    ASSERT_GT(before, 0.1);
    relabelBlock(operations, 0, 0.9);
    EXPECT_LT(sumOfSquares(complex), 0.8 * before);
    EXPECT_EQ(meshTopology(withBackgroundAsTissue(meshOf(complex))), topology);
    ASSERT_TRUE(isConsistent(complex));
  }
}

/// How far each spike of a block stands off its samples.
std::vector<double> depthsOfSpikes(GuardedOperations& operations, double vertexDistance)
{
  const TetComplex& c = operations.complex();
  std::vector<double> depths;
  for (std::int32_t v = 0; v < std::int32_t(c.points.size()); ++v)
    if (c.vertexTet[v] >= 0 && !c.locked[v] && c.onInterface[v] && operations.isSpike(v, vertexDistance))
      depths.push_back(norm(*operations.nearestSampleOf(v) - c.points[v]));
  return depths;
}

double sumOf(const std::vector<double>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

TEST(Spikes, AreCutWhereTopologyAllowsAndElseDrawnIn)
{
  std::size_t before = 0, cut = 0;
  double left = 0, drawnIn = 0;
  for (const double pullAngle : { 0, 1 })
  {
    const SpikeOptions options{ 1.2, 8, 1, pullAngle, 0 };
    expectPromisesKept(0, false,
                       [&](GuardedOperations& operations)
                       {
                         const std::size_t spikes = depthsOfSpikes(operations, options.vertexDistance).size();
                         cutSpikesOfBlock(operations, options);
                         const auto after = depthsOfSpikes(operations, options.vertexDistance);
                         EXPECT_LE(after.size(), spikes);
                         (pullAngle > 0 ? drawnIn : left) += sumOf(after);
                         before += spikes;
                         cut += spikes - after.size();
                       });
  }
  EXPECT_GT(before, 0u);
  EXPECT_GT(cut, 0u);
  EXPECT_LT(drawnIn, left);
}

TEST(Spikes, LeaveNoSampleFartherOffThanTheyWere)
{
  const auto leftWith = [](double maximumDistance)
  {
    std::size_t left = 0;
    for (unsigned seed = 1; seed <= 10; ++seed)
    {
      std::mt19937 random(seed);
      const TissueMap map = randomWellComposedMap(random, { 5, 5, 5 }, 1 + int(seed % 4));
      TetComplex complex = complexOf(tetrahedraOf(map), 1.5f, 0.2f);
      GuardedOperations unguarded(complex, scale, { 1, 100 });
      relabelAtRandom(unguarded, random);
      GuardedOperations operations(complex, scale, { 1 });
      const SpikeOptions options{ 1.2, 8, 1, 0, maximumDistance };
      const auto depths = depthsOfSpikes(operations, options.vertexDistance);
      const double deepest = depths.empty() ? 0 : *std::max_element(depths.begin(), depths.end());
      const auto places = samplePlaces(complex);
      cutSpikesOfBlock(operations, options);
      const auto after = samplePlaces(complex);
      for (std::size_t e = 0; e < places.size(); ++e)
      {
        const double most = std::max({ places[e].distance, 0.2, std::min(deepest, maximumDistance) });
        EXPECT_LE(after[e].tet < 0 ? 0 : after[e].distance, most * (1 + 1e-6));
      }
      left += depthsOfSpikes(operations, options.vertexDistance).size();
    }
    return left;
  };
  EXPECT_LT(leftWith(10), leftWith(0));
}

TEST(Spikes, StandOffTheWallAndNotOnlyOffSamplesFarApart)
{
  constexpr double vertexDistance = 1.4;
  const auto twoSlabs = [](int, int, int k) { return k < 3 ? 1 : 2; };
  TetComplex complex = complexOf(tetrahedraOf(paintedMap({ 6, 6, 6 }, twoSlabs)), 1, 0.1f);
  GuardedOperations operations(complex, scale, { 1, 100 });
  const auto isInWall = [&](std::int32_t v)
  {
    const auto& faces = operations.sheet(v).faces;
    const auto isBetween = [](const SheetFace& f) { return f.labels == labelPair(1, 2); };
    return !complex.locked[v] && complex.onInterface[v] && std::all_of(faces.begin(), faces.end(), isBetween);
  };
  std::vector<std::int32_t> wall;
  for (std::int32_t v = 0; v < std::int32_t(complex.points.size()); ++v)
    if (isInWall(v)) wall.push_back(v);
  ASSERT_FALSE(wall.empty());
  for (const std::int32_t v : wall) EXPECT_TRUE(operations.isSpike(v, vertexDistance)) << "the samples know no plane";
  const std::array<float, 3> acrossOfRadius2{ 0, 0, 0.5f };
  complex.sampleNormals.assign(complex.samples.size(), acrossOfRadius2);
  for (const std::int32_t v : wall)
  {
    EXPECT_FALSE(operations.isSpike(v, vertexDistance));
    ASSERT_TRUE(operations.move(v, complex.points[v] + Vec3{ 0, 0, 0.3 }, 0));
    EXPECT_TRUE(operations.isSpike(v, vertexDistance));
    ASSERT_TRUE(operations.move(v, complex.points[v] - Vec3{ 0, 0, 0.3 }, 0));
  }
}

TEST(Trimming, KeepsEveryPromiseAndLeavesFewerTips)
{
  const auto tips = [](GuardedOperations& operations)
  {
    const TetComplex& c = operations.complex();
    long count = 0;
    for (std::int32_t v = 0; v < std::int32_t(c.points.size()); ++v)
    {
      if (c.vertexTet[v] < 0) continue;
      const auto& star = operations.star(v);
      const auto tissue = std::count_if(star.begin(), star.end(), [&](std::int32_t t) { return c.labels[t] != 0; });
      count += tissue > 0 && tissue <= 5;
    }
    return count;
  };
  long before = 0, after = 0, relabels = 0;
  expectPromisesKept(1, false,
                     [&](GuardedOperations& operations)
                     {
                       before += tips(operations);
                       removeEarsOfBlock(operations, 5);
                       after += tips(operations);
                       relabels += operations.counts().relabels;
                     });
  EXPECT_GT(relabels, 0);
  EXPECT_LT(after, before);
}

// What repairs of the surface cost a tissue comes back, within what is worth it.
TEST(MeshImprovement, TissuesOfAnImprovedSurfaceKeepTheirVolumes)
{
  TetrahedraImprovementOptions options;
  options.isImproved = true;
  for (unsigned seed = 1; seed <= 4; ++seed)
  {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    const TetMesh before = shaken(tetrahedraOf(randomWellComposedMap(random, { 8, 8, 8 }, 3)), random, 0.35);
    TetMesh after = before;
    improveTetrahedra(after, scale, options);
    requireSound(after, "improvement");
    EXPECT_EQ(meshTopology(withBackgroundAsTissue(after)), meshTopology(withBackgroundAsTissue(before)));
    EXPECT_GT(worstOf(withoutOutside(after)), worstOf(withoutOutside(before)));
    const std::map<Label, double> volumes = volumesOf(after);
    for (const auto& [label, volume] : volumesOf(before)) // up to 0.014 otherwise
      EXPECT_NEAR(volumes.at(label) / volume, 1, 0.005) << "label " << label;
  }
}

TEST(MeshImprovement, BytesDoNotDependOnThreadsAndCancellingLeavesTheMesh)
{
  std::mt19937 random(9);
  const TetMesh before = shaken(tetrahedraOf(randomWellComposedMap(random, { 6, 6, 6 }, 3)), random, 0.35);
  std::vector<TetMesh> results;
  for (int threads : { 1, 2, 2 })
  {
    vtkSMPTools::Initialize(threads);
    results.push_back(before);
    improveTetrahedra(results.back(), scale);
    EXPECT_EQ(results.back().points, results[0].points);
    EXPECT_EQ(results.back().tetrahedra, results[0].tetrahedra);
    EXPECT_EQ(results.back().labels, results[0].labels);
  }
  vtkSMPTools::Initialize(0);
  TetMesh cancelled = before;
  const auto cancel = [](double fraction, const std::string&)
  {
    if (fraction > 0.5) throw std::runtime_error("cancelled");
  };
  EXPECT_THROW(improveTetrahedra(cancelled, scale, {}, cancel), std::runtime_error);
  EXPECT_EQ(cancelled.points, before.points);
  EXPECT_EQ(cancelled.tetrahedra, before.tetrahedra);
}

} // namespace surgicalmesher
