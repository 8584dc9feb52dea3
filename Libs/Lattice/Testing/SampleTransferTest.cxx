// SPDX-License-Identifier: Apache-2.0
#include "SampleTransfer.h"

#include "RandomMaps.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace surgicalmesher
{
namespace
{

using namespace test;
using Sample = BackgroundMesh::Sample;

constexpr double edgeLength = 4;

double length(const Vec3&) { return edgeLength; }

KuhnLattice latticeOf(const TissueMap& map) { return kuhnLattice(map, uniformScale(edgeLength), {}); }

/// Of `blocks`, with the samples of `map`.
KuhnLattice latticeOf(const TissueMap& map, const TissueMap& blocks, const SampleTransferOptions& options = {})
{
  return latticeWithSamplesOf(map, blocks, uniformScale(edgeLength), length, options);
}

/// A wall across x: label 1 below it, 2 above.
TissueMap walled(int at)
{
  return paintedMap({ 16, 12, 12 }, [&](int i, int, int) { return i < at ? 1 : 2; });
}

bool isBefore(const Sample& a, const Sample& b)
{
  const Vec3 &p = a.position, &q = b.position;
  return std::tie(p.x, p.y, p.z) < std::tie(q.x, q.y, q.z);
}

std::vector<Sample> sorted(std::vector<Sample> samples)
{
  std::sort(samples.begin(), samples.end(), isBefore);
  return samples;
}

/// The labels of the faces that hold the samples, the larger first.
std::vector<std::pair<Label, Label>> heldBetween(const KuhnLattice& lattice)
{
  const TetMesh& mesh = lattice.background.mesh;
  const AcrossFaces across = faceAdjacency(mesh).across;
  std::vector<std::pair<Label, Label>> result;
  for (const Sample& sample : lattice.background.samples)
  {
    const std::int32_t beyond = across[sample.tetrahedron][sample.face];
    result.emplace_back(mesh.labels[sample.tetrahedron], beyond < 0 ? Label(0) : mesh.labels[beyond]);
  }
  return result;
}

TEST(SampleTransfer, keepsAllOfTheSameMap)
{
  std::mt19937 random(11);
  for (int n = 0; n < 10; ++n)
  {
    const TissueMap map = randomWellComposedMap(random, { 9, 8, 10 }, 3);
    const KuhnLattice before = latticeOf(map), after = latticeOf(map, map);
    ASSERT_EQ(after.background.samples.size(), before.background.samples.size());
    for (std::size_t i = 0; i < after.background.samples.size(); ++i)
    {
      EXPECT_EQ(after.background.samples[i].position, before.background.samples[i].position);
      EXPECT_EQ(after.background.samples[i].tetrahedron, before.background.samples[i].tetrahedron);
    }
  }
}

TEST(SampleTransfer, placesThoseOfTheMapOnTheWallOfTheBlocks)
{
  const TissueMap map = walled(7), blocks = walled(8);
  const KuhnLattice lattice = latticeOf(map, blocks);
  const std::vector<Sample> wanted = sorted(latticeOf(map).background.samples);
  const std::vector<Sample> found = sorted(lattice.background.samples);
  ASSERT_EQ(found.size(), wanted.size());
  for (std::size_t i = 0; i < found.size(); ++i) EXPECT_EQ(found[i].position, wanted[i].position);
  const auto labels = heldBetween(lattice);
  for (std::size_t i = 0; i < labels.size(); ++i)
    if (lattice.background.samples[i].position.x == 6.5)
    {
      EXPECT_EQ(labels[i], std::pair(Label(2), Label(1)));
    }
}

TEST(SampleTransfer, leavesOutWhatTheBlocksHaveNoFaceFor)
{
  const TissueMap blocks = paintedMap({ 16, 12, 12 }, [](int, int, int) { return 1; });
  const KuhnLattice lattice = latticeOf(walled(8), blocks);
  for (const auto& labels : heldBetween(lattice)) EXPECT_EQ(labels, std::pair(Label(1), Label(0)));
  for (const Sample& sample : lattice.background.samples)
    EXPECT_LT(sample.position.x, 8); // the others lie between 2 and the outside
}

TEST(SampleTransfer, thinsEvenly)
{
  // A wall at i = 20, one at i = 30 with fewer samples.
  const TissueMap map = paintedMap({ 40, 60, 60 }, [](int i, int, int) { return i < 20 ? 1 : i < 30 ? 2 : 3; });
  const auto perTriangle = [](const VoxelFace& face, double at)
  {
    EXPECT_EQ(at, edgeLength);
    return face.lower[0] < 25 ? 3. : 1.5;
  };
  const double share = 3 / (0.25 * std::sqrt(3.0) * edgeLength * edgeLength);
  const KuhnLattice lattice = latticeOf(map, map, { perTriangle });
  constexpr std::size_t side = 10;
  std::array<int, 36> near{}, far{}; // on squares of the walls
  const auto row = [](double x) { return std::size_t(x) / side; };
  for (const Sample& sample : lattice.background.samples)
  {
    const std::size_t square = row(sample.position.y) + 6 * row(sample.position.z);
    if (sample.position.x == 19.5) ++near[square];
    if (sample.position.x == 29.5) ++far[square];
  }
  const double wanted = share * double(side * side);
  for (const int count : near) EXPECT_NEAR(count, wanted, 0.15 * wanted);
  for (const int count : far) EXPECT_NEAR(count, 0.5 * wanted, 0.15 * 0.5 * wanted);
}

} // namespace
} // namespace surgicalmesher
