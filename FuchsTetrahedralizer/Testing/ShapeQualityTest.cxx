// SPDX-License-Identifier: Apache-2.0
// From label maps and surfaces to tetrahedra through every stage: what angles simple shapes get, and what the lattice's
// tetrahedra look like where nothing disturbs them.

#include "FaceAdjacency.h"
#include "MapPreparation.h"
#include "MeshChecks.h"
#include "MeshQuality.h"
#include "SurfaceTetrahedralization.h"
#include "TetrahedraImprovement.h"
#include "TissueMesher.h"
#include "VoxelMesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace surgicalmesher
{
namespace
{

using namespace test;

struct Shape
{
  std::string name;
  TissueMap map;
};

std::vector<Shape> shapes()
{
  const auto radius = [](int i, int j, int k) { return std::hypot(i - 8, j - 8, k - 8); };
  std::vector<Shape> shapes{
    { "sphere", paintedMap({ 17, 17, 17 }, [=](int i, int j, int k) { return radius(i, j, k) <= 7; }) },
    { "torus", paintedMap({ 21, 21, 9 }, [](int i, int j, int k)
                          { return std::hypot(std::hypot(i - 10, j - 10) - 6.5, k - 4) <= 2.7; }) },
    { "nested spheres", paintedMap({ 17, 17, 17 },
                                   [=](int i, int j, int k)
                                   {
                                     const double r = radius(i, j, k);
                                     return r <= 2 ? 3 : r <= 5 ? 2 : r <= 7.5 ? 1 : 0;
                                   }) },
    { "two touching cubes", paintedMap({ 14, 8, 8 },
                                       [](int i, int j, int k)
                                       {
                                         const bool outside = i < 2 || i > 11 || j < 2 || j > 5 || k < 2 || k > 5;
                                         return outside ? 0 : 1 + (i > 6);
                                       }) },
    { "slab of one voxel", paintedMap({ 16, 16, 5 }, [](int, int, int k) { return k == 2; }) },
    { "three tissues around a curve",
      paintedMap({ 14, 14, 10 }, [](int i, int j, int) { return i < 7   ? 1
                                                                : j < 7 ? 2
                                                                        : 3; }) },
    { "voxel", paintedMap({ 3, 3, 3 }, [](int i, int j, int k) { return i == 1 && j == 1 && k == 1; }) },
  };
  for (Shape& shape : shapes) prepareMap(shape.map, {});
  return shapes;
}

/// Degrees, of the tissues.
Distribution anglesOf(const TetMesh& mesh) { return assessQuality(withoutOutside(mesh), {}, {}).whole.dihedral; }

/// The middle of the most frequent bin between two values.
double modeOf(const Histogram& histogram, double from, double to)
{
  const double width = (histogram.high - histogram.low) / double(histogram.counts.size());
  std::size_t best = 0;
  double mode = 0;
  for (std::size_t bin = 0; bin < histogram.counts.size(); ++bin)
  {
    const double middle = histogram.low + (double(bin) + 0.5) * width;
    if (middle < from || middle > to || histogram.counts[bin] <= best) continue;
    best = histogram.counts[bin];
    mode = middle;
  }
  return mode;
}

/// The tetrahedra of `mesh` all of whose corners are in the cube of half edge `reach` around the origin.
TetMesh coreOf(const TetMesh& mesh, double reach)
{
  TetMesh core = mesh;
  for (std::size_t t = 0; t < core.labels.size(); ++t)
  {
    for (const std::int32_t id : core.tetrahedra[t])
    {
      for (int axis = 0; axis < 3; ++axis)
      {
        if (std::abs(core.points[id][axis]) > reach) core.labels[t] = 0;
      }
    }
  }
  return withoutOutside(core);
}

/// Share of the points inside a tissue that have 24 tetrahedra.
double shareWithLatticeValence(const TetMesh& mesh)
{
  std::vector<int> valence(mesh.points.size(), 0);
  for (const auto& tetrahedron : mesh.tetrahedra)
    for (const std::int32_t id : tetrahedron) ++valence[id];
  std::vector<std::int32_t> onSurface;
  interfaceOf(mesh, &onSurface);
  for (const std::int32_t id : onSurface) valence[id] = 0;
  const auto inner = double(std::count_if(valence.begin(), valence.end(), [](int v) { return v > 0; }));
  return double(std::count(valence.begin(), valence.end(), 24)) / inner;
}

/// A cube of edge `size` mm around the origin, its triangles of legs 1 mm.
SurfaceComplex cube(int size)
{
  SurfaceComplex surface = interfaceOf(tetrahedraOf(paintedMap({ size, size, size }, [](int, int, int) { return 1; })));
  const double middle = 0.5 * (size - 1);
  for (Vec3& p : surface.points) p = p - Vec3{ middle, middle, middle };
  return surface;
}

void expectGoodAngles(const TetMesh& mesh)
{
  const Distribution angles = anglesOf(mesh);
  EXPECT_GE(angles.minimum, 25);
  EXPECT_LE(angles.maximum, 155);
}

} // namespace

/// Neither what coarsening leaves off the boundary, nor what repairs and raised heights push off it.
TEST(ShapeQuality, NoVertexOfABallIsFarOff)
{
  constexpr double radius = 14, middle = 18; // heights raised four tolerances off took a vertex 0.37 off here
  TissueMap map = paintedMap({ 37, 37, 37 },
                             [](int i, int j, int k) {
                               return squaredNorm(Vec3{ i - middle, j - middle, k - middle }) <= radius * radius;
                             });
  prepareMap(map, {});
  for (const double length : { 1.5, 2.0 })
  {
    const auto scale = [&](const Vec3&) { return float(length); };
    TetMesh mesh =
      fillWithTetrahedra(interfaceOf(meshTissues(map, uniformScale(length), {}).background.mesh), scale, "ball");
    TetrahedraImprovementOptions options;
    options.isImproved = true;
    improveTetrahedra(mesh, scale, options);
    double farthest = 0;
    for (const Vec3& p : interfaceOf(withoutOutside(mesh)).points)
      farthest = std::max(farthest, std::abs(norm(p - Vec3{ middle, middle, middle }) - radius));
    EXPECT_LT(farthest, 0.35) << length;
  }
}

TEST(ShapeQuality, NoAngleIsBadWhateverTheStart)
{
  for (const Shape& shape : shapes())
  {
    for (const double length : { 1.5, 4.0 })
    {
      SCOPED_TRACE(shape.name + " at " + std::to_string(length) + " mm");
      const auto scale = [&](const Vec3&) { return float(length); };
      TetMesh ambient = meshTissues(shape.map, uniformScale(length), {}).background.mesh;
      const auto topology = meshTopology(ambient);
      TetMesh delaunay = fillWithTetrahedra(interfaceOf(ambient), scale, shape.name);
      for (TetMesh* mesh : { &ambient, &delaunay })
      {
        SCOPED_TRACE(mesh == &ambient ? "from ambient tetrahedra" : "from constrained Delaunay");
        improveTetrahedra(*mesh, scale);
        requireSound(*mesh, shape.name);
        EXPECT_EQ(meshTopology(*mesh), topology);
        expectGoodAngles(*mesh);
      }
    }
  }
}

TEST(ShapeQuality, TheLatticeSurvivesAwayFromSurfaces)
{
  const auto scale = [](const Vec3&) { return 1.2f; };
  TetMesh mesh = fillWithTetrahedra(cube(16), scale, "cube");
  improveTetrahedra(mesh, scale);
  const MeshQuality all = assessQuality(withoutOutside(mesh), {}, scale);
  const MeshQuality core = assessQuality(coreOf(mesh, 8 - 2 * 1.2), {}, scale);
  ASSERT_GT(core.whole.tetrahedra, 2000u);
  for (const MeshQuality* quality : { &all, &core })
  {
    SCOPED_TRACE(quality == &all ? "everywhere" : "two edges away from the surface");
    EXPECT_EQ(std::floor(modeOf(quality->valence, 0, 60)), 24);
    EXPECT_NEAR(modeOf(quality->dihedral, 0, 75), 60, 2);
    EXPECT_NEAR(modeOf(quality->dihedral, 75, 180), 90, 2);
    EXPECT_NEAR(modeOf(quality->edgeOverTarget, 0, 2.5), 1, 0.1);
    EXPECT_NEAR(quality->whole.edgeOverTarget.mean, 1, 0.03);
  }
  EXPECT_EQ(core.whole.valence.minimum, 24);
  EXPECT_EQ(core.whole.valence.maximum, 24);
  EXPECT_GT(core.whole.dihedral.minimum, 57);
  EXPECT_LT(core.whole.dihedral.maximum, 93);
}

TEST(ShapeQuality, TheLatticeSurvivesGrading)
{
  const auto scale = [](const Vec3& p) { return float(0.9 + 0.12 * std::max(0.0, norm(p) - 2)); };
  TetMesh mesh = fillWithTetrahedra(cube(20), scale, "cube");
  improveTetrahedra(mesh, scale);
  const TetMesh tissue = withoutOutside(mesh);
  const MeshQuality quality = assessQuality(tissue, {}, scale);
  EXPECT_GT(shareWithLatticeValence(tissue), 0.4);
  EXPECT_NEAR(modeOf(quality.dihedral, 50, 75), 60, 2);
  EXPECT_NEAR(modeOf(quality.dihedral, 80, 100), 90, 2);
  expectGoodAngles(mesh);
}

} // namespace surgicalmesher
