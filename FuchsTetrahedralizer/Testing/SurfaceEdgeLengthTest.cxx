#include "SurfaceEdgeLength.h"
#include "AmbientMatch.h"
#include "Errors.h"
#include "FaceNeighbours.h"
#include "Shapes.h"
#include "VoxelMesh.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace surgicalmesher
{
namespace
{

TEST(EdgeLengthFromPoints, IsThatOfTheNearestPoint)
{
  const EdgeLength length = edgeLengthFromPoints({ { 0, 0, 0 }, { 10, 0, 0 }, { 0, 10, 0 } }, { 1, 2, 3 });
  EXPECT_EQ(length({ 4.9, 0, 0 }), 1);
  EXPECT_EQ(length({ 5.1, 0, 0 }), 2);
  EXPECT_EQ(length({ -50, 90, 3 }), 3);
}

TEST(RequireCover, NamesTheFirstPointOutside)
{
  ScaleField scale;
  scale.grid.size = { 2, 2, 2 };
  scale.grid.spacing = { 10, 10, 10 };
  scale.lengths.assign(8, 1);
  EXPECT_NO_THROW(requireCover(scale, { { -5.4, -5, -5 }, { 15, 15, 15.4 } }, "scale.nrrd"));
  try
  {
    requireCover(scale, { { 0, 0, 0 }, { 0, 15.6, 0 } }, "scale.nrrd");
    FAIL();
  }
  catch (const InputError& error)
  {
    EXPECT_NE(std::string(error.what()).find("(0, 15.6, 0) mm"), std::string::npos) << error.what();
  }
}

TEST(RequireInterfacesAre, AcceptsOnlyTheAmbientsOwnSurface)
{
  const TetraMesh ambient = test::tetrahedraOf(test::paintedMap({ 4, 3, 3 }, [](int i, int, int) { return i % 3; }));
  SurfaceComplex surface = interfaceOf(ambient);
  EXPECT_NO_THROW(requireInterfacesAre(surface, "s.vtp", ambient, "a.vtu"));
  SurfaceComplex renumbered = surface;
  std::reverse(renumbered.triangles.begin(), renumbered.triangles.end());
  std::reverse(renumbered.labels.begin(), renumbered.labels.end());
  for (std::size_t t = 0; t < renumbered.triangles.size(); ++t)
  {
    std::swap(renumbered.triangles[t][0], renumbered.triangles[t][1]);
    std::swap(renumbered.labels[t][0], renumbered.labels[t][1]);
  }
  EXPECT_NO_THROW(requireInterfacesAre(renumbered, "s.vtp", ambient, "a.vtu")) << "the same, told differently";

  SurfaceComplex moved = surface, relabelled = surface, missing = surface;
  moved.points[5].x += 1e-9;
  relabelled.labels[3] = { 7, 0 };
  missing.triangles.pop_back();
  missing.labels.pop_back();
  for (const SurfaceComplex& other : { moved, relabelled, missing })
  {
    EXPECT_THROW(requireInterfacesAre(other, "s.vtp", ambient, "a.vtu"), InputError);
  }
}

} // namespace
} // namespace surgicalmesher
