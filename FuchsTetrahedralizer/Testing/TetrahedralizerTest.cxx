// SPDX-License-Identifier: Apache-2.0
// The driver: from a surface, or from background tetrahedra, to a mesh with all that it carries.

#include "Tetrahedralizer.h"
#include "Errors.h"
#include "FaceAdjacency.h"
#include "InteriorRefill.h"
#include "MapPreparation.h"
#include "MeshChecks.h"
#include "ScaleMaps.h"
#include "Shapes.h"
#include "SurfacePreparation.h"
#include "TetrahedraImprovement.h"
#include "TissueMapIO.h"
#include "TissueMesher.h"
#include "VoxelMesh.h"
#include "WorstAngle.h"

#include <gtest/gtest.h>

#include <fstream>

namespace surgicalmesher
{
namespace
{

using namespace test;

constexpr double shortest = 1.2, longest = 2;

/// Fine near x = 0 alone, so that there is a child.
double lengthAt(const Vec3& p) { return p.x < 3 ? shortest : longest; }

TetMesh twoTissues()
{
  return tetrahedraOf(paintedMap({ 12, 6, 6 }, [](int i, int j, int) { return i < 9 && j < 3 ? 1 : 2; }));
}

TetrahedralizerInput inputOf(const TetMesh& background, bool withBackground)
{
  TetrahedralizerInput input;
  input.name = "two tissues";
  input.surface = interfaceOf(background);
  input.tissues[1].isNullDisplacement = true;
  if (withBackground)
  {
    input.background.emplace();
    input.background->mesh = background;
  }
  else input.surface = fillableSurface(input.surface, lengthAt, input.name).surface;
  return input;
}

TEST(TetrahedralizeTissues, KeepsTissuesAndDescribesEveryTetrahedronFromBothStarts)
{
  const TetMesh before = twoTissues();
  for (const bool withBackground : { false, true })
  {
    SCOPED_TRACE(withBackground);
    const FiniteElementMesh result =
      tetrahedralizeTissues(inputOf(before, withBackground), lengthsOf(lengthAt), TetrahedralizerOptions{});
    const MeshFile& content = result.content;
    EXPECT_EQ(meshTopology(content.mesh), meshTopology(before));
    EXPECT_EQ(result.division.children, 1);
    ASSERT_EQ(content.targetEdgeLength.size(), content.mesh.points.size());
    ASSERT_EQ(content.subMeshInterface.size(), content.mesh.points.size());
    ASSERT_EQ(content.subMesh.size(), content.mesh.tetrahedra.size());
    ASSERT_EQ(content.constitutive.size(), content.mesh.tetrahedra.size());
    for (std::size_t t = 0; t < content.mesh.labels.size(); ++t)
    {
      ASSERT_NE(content.mesh.labels[t], 0);
      ASSERT_EQ(content.constitutive[t] == 2, content.mesh.labels[t] == 1) << "held still, whatever its sub-mesh";
    }
  }
}

/// Voxels cut into tetrahedra of 45 degrees, which the lattice does not have beside walls of steps.
TEST(TetrahedralizeTissues, FillsATissueAsItWasWhereTheLatticeLeavesWorseAngles)
{
  const TetMesh before = tetrahedraOf(paintedMap(
    { 9, 9, 9 }, [](int i, int j, int k) { return std::abs(i - 4) + std::abs(j - 4) + std::abs(k - 4) < 6 ? 1 : 0; }));
  const auto length = [](const Vec3&) { return 1.2; };
  TetrahedraImprovementOptions aim;
  aim.targetAngle = 44;
  aim.isImproved = true;
  TetMesh lattice = withLatticeInside(before, tissuesWithRoom(before, length), length, "octahedron");
  improveTetrahedra(lattice, length, aim);
  TetrahedralizerInput input = inputOf(before, true);
  input.background->targetAngle = aim.targetAngle;
  const TetMesh mesh = tetrahedralizeTissues(input, lengthsOf(length), {}).content.mesh;
  EXPECT_LT(worstAngle(lattice), 0.9 * aim.targetAngle);
  EXPECT_GT(worstAngle(mesh), 0.95 * aim.targetAngle);
}

TEST(TetrahedralizeTissues, GivesACopyElsewhereTheSameMeshInTheFrameOfItsScale)
{
  const TetMesh before = twoTissues();
  ScaleField scale = uniformScale(1.6);
  ScaleField elsewhere = scale;
  elsewhere.grid.axes = { Vec3{ 0, 1, 0 }, Vec3{ -1, 0, 0 }, Vec3{ 0, 0, 1 } };
  elsewhere.grid.origin = { 32, -64, 128 };
  TetMesh moved = before;
  for (Vec3& p : moved.points) p = elsewhere.grid.gridToWorld(scale.grid.worldToGrid(p));
  const TetMesh here = tetrahedralizeTissues(inputOf(before, true), lengthsOf(scale), {}).content.mesh;
  const TetMesh there = tetrahedralizeTissues(inputOf(moved, true), lengthsOf(elsewhere), {}).content.mesh;
  EXPECT_EQ(here.labels, there.labels);
  EXPECT_EQ(here.tetrahedra, there.tetrahedra);
}

TEST(TetrahedralizeTissues, LeavesNoBadAngleWhereElementsAreLongerThanTissuesAreWide)
{
  const std::string file = "/usr/share/mricron/templates/brodmann.nii.gz";
  if (!std::ifstream(file)) GTEST_SKIP() << "Debian's mricron-data is not installed";
  TissueMap map = readTissueMap(file);
  prepareMap(map, {});
  const ScaleField scale = radialScale(map.grid, { 0, -20, -5 }, 8, 40, 10, 25);
  TissueMap inFrame = map;
  inFrame.grid = inOwnFrame(map.grid);
  TetrahedralizerInput input;
  input.name = file;
  input.background.emplace();
  input.background->mesh = meshTissues(inFrame, inFrameOf(map.grid, scale), {}).background.mesh;
  for (Vec3& p : input.background->mesh.points) p = map.grid.gridToWorld(p);
  input.surface = interfaceOf(input.background->mesh);
  const TetMesh mesh = tetrahedralizeTissues(std::move(input), lengthsOf(scale), {}).content.mesh;
  EXPECT_GT(worstAngle(mesh), 23);
}

TEST(FillableSurface, MakesTissuesOfClosedShellsAndRefusesWhatCannotBeFilled)
{
  SurfaceComplex unlabelled = sphere({}, 8, 2);
  unlabelled.labels.clear();
  const FillableSurface prepared = fillableSurface(
    unlabelled, [](const Vec3&) { return 3; }, "sphere");
  EXPECT_EQ(prepared.surface.labels.size(), prepared.surface.triangles.size());
  EXPECT_FALSE(prepared.soleLabel);
  EXPECT_THROW(fillableSurface(
                 unlabelled, [](const Vec3&) { return 30; }, "hardly millimetres"),
               InputError);
  EXPECT_THROW(fillableSurface(
                 unlabelled, [](const Vec3&) { return 1e-5; }, "beyond any memory"),
               InputError);
  SurfaceComplex open = sphere({}, 8, 2);
  open.triangles.pop_back();
  open.labels.pop_back();
  EXPECT_THROW(fillableSurface(
                 open, [](const Vec3&) { return 3; }, "open"),
               InputError);
}

TEST(FillableSurface, TakesTheNeighboursOfASoleTissueForOutside)
{
  const SurfaceComplex alone = sphere({}, 8, 2, 7, 5);
  const FillableSurface prepared = fillableSurface(
    alone, [](const Vec3&) { return 3; }, "sphere");
  EXPECT_EQ(prepared.soleLabel, Label(7));
  for (const auto& sides : prepared.surface.labels) EXPECT_EQ(sides[1], 0);
}

} // namespace
} // namespace surgicalmesher
