// SPDX-License-Identifier: Apache-2.0
#include "DigitalTopology.h"
#include "ExecutableTest.h"
#include "TissueMapIO.h"
#include "TubePathIO.h"
#include "TubePhantoms.h"

#include <rapidjson/document.h>

#include <limits>

using namespace surgicalmesher;
using namespace surgicalmesher::test;

namespace
{

/// A helix of radius 1.5 mm in an image of 1 mm, with noise.
class TubePathCLI : public ExecutableTest
{
protected:
  TubePathCLI() : ExecutableTest(TUBEPATHCLI) {}

  void SetUp() override
  {
    std::mt19937 random(4);
    scene = helixScene(randomPlacement(random), 1.5);
    image = drawTubes(gridAround(scene.tubes, 8), scene.tubes, 3);
    addNoise(image, 0.15, random);
    folder.write("image.nrrd", nrrd("float", nrrdGeometry(image.grid), image.values));
    folder.write("points.fcsv", fcsv(scene.places));
  }

  static std::string fcsv(const std::vector<Vec3>& points)
  {
    std::ostringstream text;
    text << "# CoordinateSystem = LPS\n";
    for (const Vec3& p : points) text << "F," << p.x << "," << p.y << "," << p.z << "\n";
    return text.str();
  }

  TubeScene scene;
  ScalarImage image;
};

} // namespace

TEST_F(TubePathCLI, WritesACurveWithRadiusAndFlux)
{
  expectDone("--points points.fcsv image.nrrd path.mrk.json");
  const std::vector<TubePath> tubes = readTubePaths(folder.file("path.mrk.json"), 0);
  ASSERT_EQ(tubes.size(), 1u);
  EXPECT_LT(pathError(tubes[0].points, scene.truth).largest, 1);
  for (const double radius : tubes[0].radii) EXPECT_NEAR(radius, 1.5, 0.4);
  for (const double flux : tubes[0].flux) EXPECT_GT(flux, 0.1);
  EXPECT_EQ(folder.files(), (std::vector<std::string>{ "image.nrrd", "path.mrk.json", "points.fcsv" }));
}

TEST_F(TubePathCLI, AddsTheTubeToALabelMap)
{
  TissueMap map;
  map.grid = image.grid;
  map.labels.assign(map.grid.voxelCount(), 3);
  map.table[3].name = "muscle";
  writeTissueMap(map, folder.file("map.nrrd"));
  expectDone("--points points.fcsv --addTo map.nrrd --labelMap out.nrrd --label 7 --name artery --report r.json "
             "--returnparameterfile r.txt image.nrrd path.mrk.json");
  const TissueMap out = readTissueMap(folder.file("out.nrrd"));
  EXPECT_EQ(presentLabels(out), (std::vector<Label>{ 3, 7 }));
  EXPECT_EQ(out.table.at(7).name, "artery");
  EXPECT_EQ(out.table.at(3).name, "muscle");
  EXPECT_EQ(tissueTopology(out).at(7), (Betti{ 1, 0, 0 }));
  rapidjson::Document report;
  report.Parse(readBytes(folder.file("r.json")).c_str());
  ASSERT_TRUE(report.IsObject());
  EXPECT_EQ(report["voxels"].GetUint64(), countVoxels(out).at(7));
  EXPECT_STREQ(report["polarity"].GetString(), "bright");
  EXPECT_NEAR(report["length"].GetDouble(), polylineLength(scene.truth), 2);
  EXPECT_NE(readBytes(folder.file("r.txt")).find("length = "), std::string::npos);
}

TEST_F(TubePathCLI, TakesAFreeLabelAndRenamesNoTissue)
{
  TissueMap map;
  map.grid = image.grid;
  map.labels.assign(map.grid.voxelCount(), 1);
  map.table[1].name = "muscle";
  map.table[2].name = "bone"; // without a voxel
  writeTissueMap(map, folder.file("map.nrrd"));
  const std::string start = "--points points.fcsv --addTo map.nrrd --labelMap out.nrrd --name artery ";
  expectDone(start + "image.nrrd path.mrk.json");
  TissueMap out = readTissueMap(folder.file("out.nrrd"));
  EXPECT_EQ(presentLabels(out), (std::vector<Label>{ 1, 3 }));
  EXPECT_EQ(out.table.at(3).name, "artery");
  const Outcome joined = run(start + "--label 1 --quiet image.nrrd path.mrk.json");
  EXPECT_EQ(joined.status, 0);
  EXPECT_NE(joined.err.find("warning: label 1 (muscle) has voxels already"), std::string::npos) << joined.err;
  out = readTissueMap(folder.file("out.nrrd"));
  EXPECT_EQ(presentLabels(out), (std::vector<Label>{ 1 }));
  EXPECT_EQ(out.table.at(1).name, "muscle");
}

TEST_F(TubePathCLI, WritesTheSameBytesOnAnyNumberOfThreads)
{
  expectDone("--points points.fcsv --threads 1 --labelMap a.nrrd image.nrrd a.mrk.json");
  expectDone("--points points.fcsv --threads 3 --labelMap b.nrrd image.nrrd b.mrk.json");
  EXPECT_EQ(readBytes(folder.file("a.mrk.json")), readBytes(folder.file("b.mrk.json")));
  EXPECT_EQ(readBytes(folder.file("a.nrrd")), readBytes(folder.file("b.nrrd")));
}

TEST_F(TubePathCLI, ReadsItsOwnPathAsATubeToKeepOutOf)
{
  expectDone("--points points.fcsv image.nrrd path.mrk.json");
  expectRefused("--points points.fcsv --block path.mrk.json --snap 0 image.nrrd again.mrk.json", 1,
                "--block: every way from"); // the only tube is blocked
}

TEST_F(TubePathCLI, FollowsATubeWithinOneThickSlice)
{
  ScalarImage thick = image;
  thick.grid = Grid();
  thick.grid.size = { 40, 30, 12 };
  thick.grid.spacing = { 0.7, 0.7, 6 };
  thick.values.assign(thick.grid.voxelCount(), 0);
  std::mt19937 random(5);
  addNoise(thick, 0.01, random);
  for (const int j : { 14, 15 })
    for (int i = 0; i < 40; ++i) thick.values[thick.grid.index(i, j, 6)] += 1;
  folder.write("thick.nrrd", nrrd("float", nrrdGeometry(thick.grid), thick.values));
  folder.write("thick.fcsv", fcsv({ { 3, 10.2, 36 }, { 24, 10.2, 36 } }));
  const std::string options = "--margin 5 --points thick.fcsv --potential ";
  for (const char* potential : { "flux", "intensity", "gradient" })
    expectDone(options + potential + " thick.nrrd p.mrk.json");
  thick.grid.size[2] = 3;
  thick.values.resize(thick.grid.voxelCount());
  folder.write("three.nrrd", nrrd("float", nrrdGeometry(thick.grid), thick.values));
  folder.write("thick.fcsv", fcsv({ { 3, 10.2, 6 }, { 24, 10.2, 6 } }));
  expectRefused(options + "gradient three.nrrd p.mrk.json", 1, "three.nrrd: 40 x 30 x 3 voxels, expected 4 or more");
}

TEST_F(TubePathCLI, RefusesBadInputWithOneLineAndStatusOne)
{
  folder.write("one.fcsv", fcsv({ scene.places[0] }));
  folder.write("same.fcsv", fcsv({ scene.places[0], scene.places[0] }));
  folder.write("outside.fcsv", fcsv({ scene.places[0], { 900, 0, 0 } }));
  ScalarImage even = image;
  std::fill(even.values.begin(), even.values.end(), 7.f);
  folder.write("even.nrrd", nrrd("float", nrrdGeometry(even.grid), even.values));
  folder.write("text.nrrd", "not an image\n");
  ScalarImage hole = image;
  hole.values[100] = std::numeric_limits<float>::quiet_NaN();
  folder.write("nan.nrrd", nrrd("float", nrrdGeometry(hole.grid), hole.values));
  folder.write("vector.nrrd", nrrd("uint8", "dimension: 4\nsizes: 2 2 2 2\nkinds: vector domain domain domain\n",
                                   std::vector<std::uint8_t>(16, 1)));
  const std::string points = "--points points.fcsv ";
  expectRefused(points + "missing.nrrd p.mrk.json", 1, "missing.nrrd: no such file");
  expectRefused(points + "text.nrrd p.mrk.json", 1, "text.nrrd: ");
  expectRefused(points + "nan.nrrd p.mrk.json", 1, "nan.nrrd: a voxel of value nan");
  expectRefused(points + "vector.nrrd p.mrk.json", 1, "vector.nrrd: ");
  expectRefused("--points one.fcsv image.nrrd p.mrk.json", 1, "one.fcsv: one point");
  expectRefused("--points same.fcsv image.nrrd p.mrk.json", 1, "same.fcsv: 2 points in one place");
  expectRefused("--points outside.fcsv image.nrrd p.mrk.json", 1,
                "outside.fcsv in image.nrrd: point (900, 0, 0) mm LPS lies outside the image, expected");
  expectRefused(points + "even.nrrd p.mrk.json", 1, "points.fcsv in even.nrrd: point ");
  expectRefused("--points missing.fcsv image.nrrd p.mrk.json", 1, "missing.fcsv: no such file");
  expectRefused(points + "--addTo missing.nrrd --labelMap out.nrrd image.nrrd p.mrk.json", 1, "missing.nrrd");
  expectRefused(points + "image.nrrd nowhere/p.mrk.json", 1, "nowhere");
}

TEST_F(TubePathCLI, RefusesBadCommandLinesWithOneLineAndStatusTwo)
{
  const std::string points = "--points points.fcsv ";
  expectRefused("image.nrrd p.mrk.json", 2, "--points is missing");
  for (const char* radius : { "2,1", "0,3", "-1,2", "1", "1,2,3", "nan,2", "1,500" })
    expectRefused(points + "--radius " + radius + " image.nrrd p.mrk.json", 2, "radius");
  expectRefused(points + "--polarity white image.nrrd p.mrk.json", 2, "polarity");
  expectRefused(points + "--label 0 --labelMap out.nrrd image.nrrd p.mrk.json", 2, "label");
  expectRefused(points + "--addTo image.nrrd image.nrrd p.mrk.json", 2, "--addTo goes nowhere");
}

TEST_F(TubePathCLI, LeavesNoFileHalfWritten)
{
  expectSaysThatAFileCanNotGrow("--points points.fcsv --labelMap out.nrrd image.nrrd p.mrk.json");
}

// The optic nerve within the fat of the orbit: as wide as optic nerves are, and darker than what is around it.
TEST_F(TubePathCLI, FollowsARealOpticNerve)
{
  const std::string head = "/usr/share/mricron/templates/ch2.nii.gz";
  if (!std::filesystem::exists(head)) GTEST_SKIP() << head << " is not there";
  expectDone("--points '" OPTICNERVE "' --report r.json " + head + " path.mrk.json");
  rapidjson::Document report;
  report.Parse(readBytes(folder.file("r.json")).c_str());
  EXPECT_STREQ(report["polarity"].GetString(), "dark");
  EXPECT_NEAR(report["length"].GetDouble(), 18.4, 1.5);
  EXPECT_GT(report["radius"]["minimum"].GetDouble(), 1.2);
  EXPECT_LT(report["radius"]["maximum"].GetDouble(), 3.2);
  const ScalarImage t1 = readImage(head);
  const TubePath nerve = readTubePaths(folder.file("path.mrk.json"), 0).front();
  const std::vector<Vec3> tangents = tangentsOf(nerve.points);
  for (std::size_t n = 0; n < nerve.points.size(); ++n)
  {
    Vec3 aside = cross(tangents[n], { 0, 0, 1 });
    aside = (nerve.radii[n] + 2) / norm(aside) * aside;
    const auto valueAt = [&](const Vec3& p) { return linearValue(t1.grid, t1.values, t1.grid.worldToGrid(p)); };
    const Vec3& p = nerve.points[n];
    EXPECT_LT(valueAt(p), 0.5 * (valueAt(p + aside) + valueAt(p - aside))) << n;
  }
}
