// SPDX-License-Identifier: Apache-2.0
#include "VolumeBalance.h"
#include "ComplexInvariants.h"
#include "MeshQuality.h"
#include "RandomMaps.h"
#include "Remesher.h"

#include <gtest/gtest.h>

#include <cmath>

namespace surgicalmesher
{
namespace
{

using namespace test;

const SizingFunction unit = [](const Vec3&) { return 1.0f; };

/// Three slabs side by side, without samples.
BackgroundMesh slabs()
{
  BackgroundMesh background;
  background.mesh = tetrahedraOf(paintedMap({ 6, 6, 9 }, [](int, int, int k) { return 1 + k / 3; }));
  background.lengths.assign(background.mesh.points.size(), 1);
  background.neighbours = faceAdjacency(background.mesh).across;
  return background;
}

} // namespace

TEST(VolumeBalance, OffsetsBringEveryTissueToItsVolume)
{
  std::map<Label, double> wanted = volumesOf(slabs().mesh);
  wanted.erase(0);
  wanted[1] *= 1.03, wanted[2] *= 0.95;
  const VolumeBalance balance(wanted, 0.5);
  constexpr std::size_t rounds = 5;
  Remesher remesher(slabs(), unit, {}, {}, rounds);
  for (std::size_t round = 0; round < rounds; ++round)
    remesher.run(
      { "offset", { { EnvelopeBounds(), { OffsetTissues{ { balance.offsets(remesher.background()) } } } } } });
  const std::map<Label, double> volumes = volumesOf(remesher.background().mesh);
  for (const auto& [label, volume] : wanted) EXPECT_NEAR(volumes.at(label) / volume, 1, 0.002) << "label " << label;
}

TEST(VolumeBalance, RestoringInOneBlockBringsEveryTissueToItsVolume)
{
  std::map<Label, double> wanted = volumesOf(slabs().mesh);
  wanted.erase(0);
  wanted[1] *= 1.02, wanted[2] *= 0.97;
  Remesher remesher(slabs(), unit);
  const RestoreVolumes restore{ { VolumeBalance(wanted, 0.5), 0, 5 } };
  remesher.run({ "volumes", { { EnvelopeBounds(), { restore } } }, true });
  const std::map<Label, double> volumes = volumesOf(remesher.background().mesh);
  for (const auto& [label, volume] : wanted) EXPECT_NEAR(volumes.at(label) / volume, 1, 0.002) << "label " << label;
}

TEST(VolumeBalance, NothingMovesWhereEveryTissueLacksLittle)
{
  const BackgroundMesh before = slabs();
  std::map<Label, double> wanted = volumesOf(before.mesh);
  wanted.erase(0);
  for (auto& [label, volume] : wanted) volume *= 1.0004;
  Remesher remesher(before, unit);
  const RestoreVolumes restore{ { VolumeBalance(wanted, 0.5), 0.0005 } };
  remesher.run({ "volumes", { { EnvelopeBounds(), { restore } } }, true });
  EXPECT_EQ(remesher.counts().moves, 0u);
}

TEST(VolumeBalance, AComplexAsksForTheOffsetsOfItsMesh)
{
  const BackgroundMesh background = slabs();
  const TetMesh& mesh = background.mesh;
  std::map<Label, double> wanted = volumesOf(mesh);
  wanted.erase(0);
  wanted[1] *= 1.03;
  const VolumeBalance balance(wanted, 0.5);
  TetComplex complex(mesh.points, background.lengths, mesh.tetrahedra, mesh.labels);
  EXPECT_EQ(balance.offsets(complex), balance.offsets(background));
  const auto& last = mesh.tetrahedra.back();
  complex.tets.push_back({ -1, last[1], last[2], last[3] }); // a dead one
  complex.neighbours.push_back({ -1, -1, -1, -1 });
  complex.labels.push_back(1);
  EXPECT_EQ(balance.offsets(complex), balance.offsets(background));
}

TEST(VolumeBalance, OffsetsAreBounded)
{
  const BackgroundMesh background = slabs();
  std::map<Label, double> wanted = volumesOf(background.mesh);
  wanted[2] *= 3;
  const TissueOffsets offsets = VolumeBalance(wanted, 0.2).offsets(background);
  EXPECT_EQ(offsets.at(2), 0.2);
  for (const auto& [label, way] : offsets) EXPECT_LE(std::abs(way), 0.2) << "label " << label;
}

TEST(VolumeBalance, OffsetsAreOfTissuesThatLackEnough)
{
  const BackgroundMesh background = slabs();
  std::map<Label, double> wanted = volumesOf(background.mesh);
  wanted.erase(0);
  wanted[1] *= 1.03, wanted[2] *= 0.999;
  const TissueOffsets offsets = VolumeBalance(wanted, 0.5).offsets(background, 0.01);
  ASSERT_EQ(offsets.count(1), 1u);
  const double area = 6 * 6 * 2 + 4 * 6 * 3, lacking = 6 * 6 * 3 * 0.03;
  for (const auto& [label, way] : offsets) EXPECT_NEAR(way, label == 1 ? 1.3 * lacking / area : 0, 1e-9) << label;
}

} // namespace surgicalmesher
