// SPDX-License-Identifier: Apache-2.0
#include "ExecutableTest.h"
#include "HeadPhantom.h"
#include "TissueMapIO.h"

#include <rapidjson/document.h>

#include <limits>

using namespace surgicalmesher;
using namespace surgicalmesher::test;

namespace
{

class TissueMapperCLI : public ExecutableTest
{
protected:
  TissueMapperCLI() : ExecutableTest(TISSUEMAPPERCLI), head(headPhantom(3)) {}

  void SetUp() override
  {
    writeImage(head.image, folder.file("t1.nrrd"));
    folder.write("points.fcsv", fcsv(trainingOf(head.truth, 15)));
  }

  static std::string fcsv(const std::vector<TissueClass>& classes)
  {
    std::ostringstream text;
    text << "# CoordinateSystem = LPS\n# columns = label,x,y,z\n";
    for (const TissueClass& tissue : classes)
      for (const Vec3& p : tissue.points) text << tissue.name << "," << p.x << "," << p.y << "," << p.z << "\n";
    return text.str();
  }

  /// Writes the middle slices of the head, and training points in them.
  void writeSlices(int count) const
  {
    HeadPhantom slices = head;
    Grid& grid = slices.truth.grid;
    const int first = (grid.size[2] - count) / 2;
    const std::size_t layer = std::size_t(grid.size[0]) * grid.size[1];
    const std::ptrdiff_t begin = std::ptrdiff_t(first * layer), end = begin + std::ptrdiff_t(count * layer);
    slices.truth.labels.assign(head.truth.labels.begin() + begin, head.truth.labels.begin() + end);
    slices.image.values.assign(head.image.values.begin() + begin, head.image.values.begin() + end);
    grid.size[2] = count;
    grid.origin.z += first;
    slices.image.grid = grid;
    writeImage(slices.image, folder.file("slices.nrrd"));
    folder.write("slices.fcsv", fcsv(trainingOf(slices.truth, 15)));
  }

  HeadPhantom head;
};

} // namespace

TEST_F(TissueMapperCLI, WritesAMapWithNames)
{
  expectDone("--training points.fcsv --names names.ctbl --report r.json t1.nrrd map.nrrd");
  const TissueMap map = readTissueMap(folder.file("map.nrrd"));
  EXPECT_EQ(presentLabels(map), (std::vector<Label>{ 1, 2, 3, 4, 5, 6, 7 }));
  EXPECT_EQ(map.table.at(2).name, "grey matter");
  EXPECT_EQ(readTissueTable(folder.file("names.ctbl")).at(3).name, "white matter");
  std::size_t right = 0;
  for (std::size_t n = 0; n < map.labels.size(); ++n) right += map.labels[n] == head.truth.labels[n];
  EXPECT_GT(double(right), 0.97 * double(map.labels.size()));
  rapidjson::Document report;
  report.Parse(readBytes(folder.file("r.json")).c_str());
  ASSERT_EQ(report["classes"].Size(), 7u);
  EXPECT_STREQ(report["classes"][6]["compartment"].GetString(), "bone");
  EXPECT_EQ(report["classes"][0]["voxels"].GetUint64(), countVoxels(map).at(1));
}

TEST_F(TissueMapperCLI, TakesSeveralImagesAndWritesProbabilities)
{
  writeImage(ctOf(head, 20), folder.file("ct.nrrd"));
  expectDone("--training points.fcsv --channel ct.nrrd --correctBias --denoise --probability p.nrrd t1.nrrd map.nrrd");
  const TissueMap map = readTissueMap(folder.file("map.nrrd"));
  const ScalarImage sure = readImage(folder.file("p.nrrd")), skull = readImage(folder.file("p-7.nrrd"));
  for (std::size_t n = 0; n < map.labels.size(); ++n)
  {
    EXPECT_EQ(skull.values[n] == 1, map.labels[n] == 7);
    EXPECT_EQ(sure.values[n] > 0, map.labels[n] != 0);
  }
  expectDone("--training points.fcsv --channel2 ct.nrrd t1.nrrd second.nrrd");
  expectDone("--training points.fcsv --channel ct.nrrd t1.nrrd first.nrrd");
  EXPECT_EQ(readBytes(folder.file("second.nrrd")), readBytes(folder.file("first.nrrd")));
  ScalarImage moved = head.image;
  moved.grid.origin.x += 1;
  writeImage(moved, folder.file("moved.nrrd"));
  expectRefused("--training points.fcsv --channel moved.nrrd t1.nrrd other.nrrd", 1, "image 2 lies on another grid");
  expectRefused("--training points.fcsv --channel ct.nrrd --probability p.nrrd ct.nrrd other.nrrd", 1,
                "two images have");
  expectRefused("--training points.fcsv --probability p.nrrd t1.nrrd p-3.nrrd", 2, "p-3.nrrd");
}

TEST_F(TissueMapperCLI, WritesTheProbabilityOfTheClassThatTheMapHas)
{
  writeImage(headPhantom(14).image, folder.file("noisy.nrrd"));
  expectDone("--training points.fcsv --probability p.nrrd noisy.nrrd map.nrrd"); // one image: thresholds decide
  const TissueMap map = readTissueMap(folder.file("map.nrrd"));
  const ScalarImage found = readImage(folder.file("p.nrrd"));
  std::vector<ScalarImage> ofClass;
  for (const Label label : presentLabels(map))
    ofClass.push_back(readImage(folder.file("p-" + std::to_string(label) + ".nrrd")));
  for (std::size_t n = 0; n < map.labels.size(); ++n)
  {
    const Label label = map.labels[n]; // 1 to 7, or 0 outside
    ASSERT_EQ(found.values[n], label == 0 ? 0 : ofClass[label - 1].values[n]) << n;
  }
}

TEST_F(TissueMapperCLI, WritesTheCompartmentsThatItsClassesKeepTo)
{
  expectDone("--training points.fcsv --compartments c.nrrd t1.nrrd map.nrrd");
  const TissueMap map = readTissueMap(folder.file("map.nrrd")), compartments = readTissueMap(folder.file("c.nrrd"));
  const std::array<Label, 8> compartmentOf{ 0, 2, 2, 2, 3, 3, 3, 1 };
  for (std::size_t n = 0; n < map.labels.size(); ++n) ASSERT_EQ(compartments.labels[n], compartmentOf[map.labels[n]]);
  EXPECT_EQ(compartments.table.at(2).name, "intracranial");
  expectRefused("--training points.fcsv --noCompartments --compartments d.nrrd t1.nrrd map.nrrd", 2,
                "--compartments: none");
}

TEST_F(TissueMapperCLI, NumbersClassesAsTheTableSays)
{
  folder.write("classes.csv", "label,name,compartment\n11,csf,\n12,Grey matter,\n13,white matter,intracranial\n"
                              "24,fat,intraorbital\n25,muscle,\n26,skin,extracranial\n40,skull,bone\n");
  expectDone("--training points.fcsv --classes classes.csv --threads 2 t1.nrrd a.nrrd");
  EXPECT_EQ(presentLabels(readTissueMap(folder.file("a.nrrd"))), (std::vector<Label>{ 11, 12, 13, 24, 25, 26, 40 }));
  expectDone("--training points.fcsv --classes classes.csv --threads 1 t1.nrrd b.nrrd");
  EXPECT_EQ(readBytes(folder.file("a.nrrd")), readBytes(folder.file("b.nrrd")));
}

TEST_F(TissueMapperCLI, SaysWhatIsNotContiguousBecauseNoOtherClassTakesIt)
{
  folder.write("near.csv", "label,name,contiguity,limit\n1,CSF,,\n2,grey matter,,\n3,white matter,,\n4,fat,,4\n"
                           "5,muscle,yes,4\n6,skin,,4\n7,skull,no,0\n");
  const Outcome outcome = run("--quiet --training points.fcsv --classes near.csv --report r.json t1.nrrd map.nrrd");
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.err.find(" are not reached from its training points"), std::string::npos) << outcome.err;
  rapidjson::Document report;
  report.Parse(readBytes(folder.file("r.json")).c_str());
  std::size_t unreached = 0;
  for (unsigned c = 3; c < 6; ++c) unreached += report["classes"][c]["unreached"].GetUint64();
  EXPECT_GT(unreached, 0u);
  EXPECT_EQ(report["classes"][1]["unreached"].GetUint64(), 0u) << "a class without contiguity or limit";
}

TEST_F(TissueMapperCLI, TakesAFewSlices)
{
  writeSlices(4);
  expectDone("--training slices.fcsv --correctBias slices.nrrd map.nrrd");
  for (const int count : { 2, 3, 5 })
  {
    writeSlices(count);
    expectDone("--training slices.fcsv --noCompartments --correctBias slices.nrrd map.nrrd");
  }
}

TEST_F(TissueMapperCLI, RefusesTooFewSlices)
{
  writeSlices(3);
  expectRefused("--training slices.fcsv slices.nrrd map.nrrd", 1,
                "slices.nrrd: 67 x 66 x 3 voxels, expected 4 or more");
  writeSlices(1);
  expectRefused("--training slices.fcsv --noCompartments --correctBias slices.nrrd map.nrrd", 1,
                "slices.nrrd: 67 x 66 x 1 voxels, expected 2 or more");
  expectDone("--training slices.fcsv --noCompartments slices.nrrd map.nrrd");
}

TEST_F(TissueMapperCLI, RefusesContiguityAndLimitOfBone)
{
  const std::string soft = "label,name,contiguity,limit\n1,CSF,,\n2,grey matter,,\n3,white matter,,\n4,fat,,\n"
                           "5,muscle,,\n6,skin,,\n";
  folder.write("contiguous.csv", soft + "7,skull,yes,\n");
  folder.write("limited.csv", soft + "7,skull,,20\n");
  for (const std::string table : { "contiguous.csv", "limited.csv" })
    expectRefused("--training points.fcsv --classes " + table + " t1.nrrd map.nrrd", 1, table + ":8: ");
}

TEST_F(TissueMapperCLI, RefusesBadInputWithOneLine)
{
  folder.write("unnamed.fcsv", "# columns = label,x,y,z\n,0,0,0\n");
  folder.write("one.fcsv", "# columns = label,x,y,z\nskull,0,0,22\nskull,0,0,23\n");
  folder.write("outside.fcsv", "# columns = label,x,y,z\nskull,0,0,22\nskin,1,2,900\n");
  folder.write("bones.fcsv", fcsv(trainingOf(head.truth, 2)) + "jawbone,0,0,22\n");
  std::vector<TissueClass> swapped = trainingOf(head.truth, 5);
  std::swap(swapped[3].points, swapped[6].points); // bone as bright as fat
  folder.write("swapped.fcsv", fcsv(swapped));
  folder.write("absent.csv", "label,name\n1,tumour\n");
  folder.write("some.csv", "label,name\n1,CSF\n");
  folder.write("word.csv", "label,name,compartment\n1,CSF,brain\n");
  folder.write("same.csv", "label,name\n1,CSF\n1,fat\n");
  const std::string training = "--training points.fcsv ";
  expectRefused("t1.nrrd map.nrrd", 2, "--training is missing");
  expectRefused(training + "missing.nrrd map.nrrd", 1, "missing.nrrd: no such file");
  ScalarImage shifted = head.image, undefined = head.image;
  shifted.grid.origin.x += 1;
  undefined.values[1000] = std::numeric_limits<float>::quiet_NaN();
  writeImage(shifted, folder.file("shifted.nrrd"));
  writeImage(undefined, folder.file("nan.nrrd"));
  expectRefused(training + "--channel shifted.nrrd t1.nrrd map.nrrd", 1,
                "t1.nrrd, shifted.nrrd: image 2 lies on another grid");
  expectRefused(training + "nan.nrrd map.nrrd", 1, "nan.nrrd");
  expectRefused("--training unnamed.fcsv t1.nrrd map.nrrd", 1, "without a label");
  expectRefused("--training one.fcsv t1.nrrd map.nrrd", 1, "one class, skull, is trained");
  expectRefused(
    "--training outside.fcsv t1.nrrd map.nrrd", 1,
    "outside.fcsv in t1.nrrd: training point (-1, -2, 900) mm LPS of skin lies outside the image, expected");
  expectRefused("--training bones.fcsv t1.nrrd map.nrrd", 1, "bones.fcsv in t1.nrrd: two classes of bone");
  expectRefused("--training swapped.fcsv t1.nrrd map.nrrd", 1, "swapped.fcsv in t1.nrrd: training points of skull");
  expectRefused(training + "--classes absent.csv t1.nrrd map.nrrd", 1, "absent.csv:2: class tumour");
  expectRefused(training + "--classes some.csv t1.nrrd map.nrrd", 1, "trained, but not in the table");
  expectRefused(training + "--classes word.csv t1.nrrd map.nrrd", 1, "word.csv:2: compartment");
  expectRefused(training + "--classes same.csv t1.nrrd map.nrrd", 1, "same.csv:3: label 1");
}
