// SPDX-License-Identifier: Apache-2.0
#include "ExecutableTest.h"
#include "MeshChecks.h"
#include "MeshIO.h"
#include "TissueMapIO.h"
#include "VoxelMesh.h"

#include <rapidjson/document.h>

#include <filesystem>

using namespace surgicalmesher;
using namespace surgicalmesher::test;

namespace
{

/// A ball of tissue 3 in a thick shell of bone, 2, with a hole; air outside.
class BalloonSurfaceCLI : public ExecutableTest
{
protected:
  BalloonSurfaceCLI() : ExecutableTest(BALLOONSURFACECLI) {}

  void SetUp() override
  {
    map = paintedMap({ 30, 28, 28 },
                     [](int i, int j, int k)
                     {
                       const Vec3 p{ i - 14.0, j - 13.0, k - 13.0 };
                       if (p.x > 0 && std::hypot(p.y, p.z) <= 2) return 0;
                       return norm(p) <= 8 ? 3 : norm(p) <= 11 ? 2 : 0;
                     });
    map.grid.origin = { 5, -9, 30 };
    folder.write("map.nrrd", nrrd("uint16", nrrdGeometry(map.grid), map.labels));
    folder.write("names.ctbl", "2 bone 200 200 180 255\n3 brain 255 200 150 255\n");
    writeSeeds("seeds.mrk.json", { { "cavity", centre() + Vec3{ 2, 1, 0 } } });
  }

  Vec3 centre() const { return map.grid.origin + Vec3{ 14, 13, 13 }; }

  void writeSeeds(const std::string& name, const std::vector<std::pair<std::string, Vec3>>& seeds) const
  {
    std::string points;
    for (const auto& [label, p] : seeds)
      points += std::string(points.empty() ? "" : ",") + "{\"label\":\"" + label + "\",\"position\":[" +
                std::to_string(p.x) + "," + std::to_string(p.y) + "," + std::to_string(p.z) + "]}";
    folder.write(name, "{\"markups\":[{\"type\":\"Fiducial\",\"coordinateSystem\":\"LPS\",\"controlPoints\":[" +
                         points + "]}]}");
  }

  TissueMap map;
};

} // namespace

TEST_F(BalloonSurfaceCLI, MakesACompartmentOfWhatAHoledWallEncloses)
{
  expectDone("--seeds seeds.mrk.json --stop bone --names names.ctbl --edgeLength 2 --rigidity 6 --labelMap m.nrrd "
             "--report r.json --evolution e.csv map.nrrd s.vtp");
  const SurfaceFile surface = readSurface(folder.file("s.vtp"));
  ASSERT_EQ(surface.tissues.size(), 1u);
  EXPECT_EQ(surface.tissues.begin()->first, 4);
  EXPECT_EQ(surface.tissues.begin()->second.name, "cavity");
  for (const Vec3& p : surface.surface.points) EXPECT_NEAR(norm(p - centre()), 8, 1.5);

  const TissueMap result = readTissueMap(folder.file("m.nrrd"));
  std::size_t voxels = 0;
  for (std::size_t n = 0; n < result.labels.size(); ++n)
  {
    const auto [i, j, k] = map.grid.voxelAt(n);
    const double r = norm(map.grid.position(i, j, k) - Vec3{ 14, 13, 13 });
    if (result.labels[n] != 4)
    {
      EXPECT_EQ(result.labels[n], map.labels[n]);
    }
    if (r < 7)
    {
      EXPECT_EQ(result.labels[n], 4);
    }
    if (r > 9.5 || map.labels[n] == 2)
    {
      EXPECT_EQ(result.labels[n], map.labels[n]);
    }
    voxels += result.labels[n] == 4;
  }
  rapidjson::Document report;
  report.Parse(readBytes(folder.file("r.json")).c_str());
  ASSERT_TRUE(report.IsObject());
  EXPECT_TRUE(report["atRest"].GetBool());
  EXPECT_GE(report["withinTolerance"].GetDouble(), 0.9);
  const rapidjson::Value& tissue = report["tissues"][0];
  EXPECT_STREQ(tissue["name"].GetString(), "cavity");
  EXPECT_EQ(tissue["voxels"].GetUint64(), voxels);
  EXPECT_GT(tissue["heldBy"]["rigidity"].GetUint64(), 0u) << "over the hole";
  EXPECT_NEAR(tissue["volume"].GetDouble(), double(voxels), 0.05 * double(voxels));
  EXPECT_EQ(readBytes(folder.file("e.csv")).rfind("motion,faces,", 0), 0u);
}

TEST_F(BalloonSurfaceCLI, GivesTheSameBytesWithAnyNumberOfThreads)
{
  const std::string options = "--seeds seeds.mrk.json --stop 2 --edgeLength 2 --rigidity 6 ";
  expectDone(options + "--threads 1 --labelMap a.nrrd map.nrrd a.vtp");
  expectDone(options + "--threads 3 --labelMap b.nrrd map.nrrd b.vtp");
  EXPECT_EQ(readBytes(folder.file("a.vtp")), readBytes(folder.file("b.vtp")));
  EXPECT_EQ(readBytes(folder.file("a.nrrd")), readBytes(folder.file("b.nrrd")));
}

TEST_F(BalloonSurfaceCLI, GivesTwoThatMeetOneInterface)
{
  writeSeeds("two.mrk.json", { { "front", centre() - Vec3{ 0, 4, 0 } }, { "back", centre() + Vec3{ 0, 4, 0 } } });
  expectDone(
    "--seeds two.mrk.json --stop 2 --edgeLength 2 --rigidity 6 --labelMap m.nrrd --report r.json map.nrrd s.vtp");
  const SurfaceComplex surface = readSurface(folder.file("s.vtp")).surface;
  const auto tissues = checkSurface(surface);
  ASSERT_EQ(tissues.size(), 2u);
  for (const auto& [label, tissue] : tissues) EXPECT_TRUE(tissue.manifold()) << label;
  EXPECT_GT(std::count(surface.labels.begin(), surface.labels.end(), std::array<Label, 2>{ 5, 4 }), 20);
  const TissueMap result = readTissueMap(folder.file("m.nrrd"));
  for (const Label label : { 4, 5 })
    EXPECT_NEAR(double(std::count(result.labels.begin(), result.labels.end(), label)), tissues.at(label).volume,
                0.05 * tissues.at(label).volume);
}

TEST_F(BalloonSurfaceCLI, WritesItsGrowthEveryTenthMotion)
{
  expectDone("--seeds seeds.mrk.json --stop 2 --edgeLength 2 --rigidity 6 --growth g.pvd --evolution e.csv "
             "map.nrrd s.vtp");
  const std::string index = readBytes(folder.file("g.pvd"));
  double before = 0;
  int motion = 10;
  for (; std::filesystem::exists(folder.file("g-" + std::to_string(motion) + ".vtp")); motion += 10)
  {
    const std::string name = "g-" + std::to_string(motion) + ".vtp";
    EXPECT_NE(index.find("timestep=\"" + std::to_string(motion) + "\" file=\"" + name + "\""), std::string::npos);
    const SurfaceFile surface = readSurface(folder.file(name));
    EXPECT_EQ(surface.tissues.at(4).name, "cavity");
    const double volume = checkSurface(surface.surface).at(4).volume;
    if (motion <= 30)
    {
      EXPECT_GT(volume, before);
    }
    before = volume;
  }
  EXPECT_GT(motion, 40);
  EXPECT_NEAR(before / checkSurface(readSurface(folder.file("s.vtp")).surface).at(4).volume, 1, 0.05);
  expectRefused("--seeds seeds.mrk.json --stop 2 --edgeLength 2 --growth g.pvd map.nrrd g-10.vtp", 2, "g-10.vtp");
}

TEST_F(BalloonSurfaceCLI, TakesTheSmallestFreeLabelIfTheMapHasTheLast)
{
  std::replace(map.labels.begin(), map.labels.end(), Label(2), Label(65535));
  folder.write("last.nrrd", nrrd("uint16", nrrdGeometry(map.grid), map.labels));
  expectDone("--seeds seeds.mrk.json --stop 65535 --edgeLength 2 --rigidity 6 last.nrrd s.vtp");
  EXPECT_EQ(readSurface(folder.file("s.vtp")).tissues.begin()->first, 1); // 0, 3 and 65535 are taken
}

TEST_F(BalloonSurfaceCLI, SaysWhereTheMembraneLeaks)
{
  const Outcome result =
    run("--seeds seeds.mrk.json --stop 2 --edgeLength 1.5 --continuity C0 --limit 12 --report r.json map.nrrd s.vtp");
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_NE(result.err.find("of cavity are held by the limit of 12 mm alone"), std::string::npos) << result.err;
  EXPECT_NE(readBytes(folder.file("r.json")).find("held by the limit"), std::string::npos);
}

TEST_F(BalloonSurfaceCLI, RefusesWhatCanNotGrow)
{
  const std::string end = " --edgeLength 2 map.nrrd s.vtp";
  expectRefused("--stop 2" + end, 2, "--seeds is missing");
  expectRefused("--seeds seeds.mrk.json" + end, 2, "--stop is missing");
  expectRefused("--seeds seeds.mrk.json --stop skull" + end, 2, "\"skull\" is neither a label nor the name");
  expectRefused("--seeds seeds.mrk.json --stop 9" + end, 2, "no voxel of tissue 9");
  expectRefused("--seeds seeds.mrk.json --stop 2 map.nrrd s.vtp", 2, "neither --scale nor --edgeLength");
  writeSeeds("bone.mrk.json", { { "x", centre() + Vec3{ 0, 10, 0 } } });
  expectRefused("--seeds bone.mrk.json --stop 2" + end, 1, "bone.mrk.json: seed \"x\"");
  writeSeeds("far.mrk.json", { { "x", centre() + Vec3{ 0, 100, 0 } } });
  expectRefused("--seeds far.mrk.json --stop 2" + end, 1, "lies outside the label map");
  writeSeeds("twice.mrk.json", { { "x", centre() }, { "x", centre() + Vec3{ 3, 0, 0 } } });
  expectRefused("--seeds twice.mrk.json --stop 2" + end, 1, "two seeds are called \"x\"");
  writeSeeds("close.mrk.json", { { "x", centre() }, { "y", centre() + Vec3{ 0.3, 0, 0 } } });
  expectRefused("--seeds close.mrk.json --stop 2" + end, 1, "within a voxel");
}
