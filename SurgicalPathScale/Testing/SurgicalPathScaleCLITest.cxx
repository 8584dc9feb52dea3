// SPDX-License-Identifier: Apache-2.0
#include "ExecutableTest.h"
#include "RepeatedMaps.h"
#include "TissueMapIO.h"
#include "VoxelMesh.h"

#include <rapidjson/document.h>

#include <algorithm>
#include <cmath>

using namespace surgicalmesher;
using namespace surgicalmesher::test;

namespace
{

/// A map of 24 x 20 x 16 mm, a target and a path.
class SurgicalPathScaleCLI : public ExecutableTest
{
protected:
  SurgicalPathScaleCLI() : ExecutableTest(SURGICALPATHSCALECLI) {}

  void SetUp() override
  {
    map.grid.size = { 12, 10, 8 };
    map.grid.spacing = { 2, 2, 2 };
    map.grid.origin = { 5, -9, 30 };
    map.labels.assign(map.grid.voxelCount(), 1);
    for (std::size_t n = 0; n < map.labels.size(); n += 3) map.labels[n] = 7;
    folder.write("map.nrrd", nrrd("uint16", nrrdGeometry(map.grid), map.labels));
    folder.write("target.fcsv", "# CoordinateSystem = LPS\nF,10,0,40\n");
    folder.write("path.fcsv", "# CoordinateSystem = LPS\nF,5,-9,30\nF,10,0,40\n");
  }

  TissueMap map;
};

} // namespace

TEST_F(SurgicalPathScaleCLI, WritesAScaleThatCoversTheMap)
{
  expectDone("--targets target.fcsv --spacing 3 map.nrrd scale.nrrd");
  const ScaleField scale = readScale(folder.file("scale.nrrd"));
  EXPECT_NO_THROW(requireCover(scale, map.grid, "scale.nrrd"));
  EXPECT_NEAR(scale({ 10, 0, 40 }), 1, 1e-6);
  EXPECT_EQ(folder.files(), (std::vector<std::string>{ "map.nrrd", "path.fcsv", "scale.nrrd", "target.fcsv" }));
}

TEST_F(SurgicalPathScaleCLI, TakesTargetsInEveryFormAlike)
{
  folder.write("ras.fcsv", "# CoordinateSystem = 0\nF,-10,0,40\n");
  const std::string json =
    R"({"markups":[{"type":"Fiducial","coordinateSystem":"RAS","controlPoints":[{"position":[-10,0,40]}]}]})";
  folder.write("ras.mrk.json", json);
  expectDone("--targets target.fcsv --childRadius 2 map.nrrd a.nrrd");
  expectDone("--targets ras.fcsv --childRadius 2 map.nrrd b.nrrd");
  expectDone("--targets ras.mrk.json --childRadius 2 map.nrrd c.nrrd");
  expectDone("--targetPoint 10,0,40 --childRadius 2 --threads 1 map.nrrd d.nrrd");
  const std::string a = readBytes(folder.file("a.nrrd"));
  for (const char* other : { "b.nrrd", "c.nrrd", "d.nrrd" }) EXPECT_EQ(readBytes(folder.file(other)), a) << other;
}

TEST_F(SurgicalPathScaleCLI, TakesAreasInPlaceOfLengths)
{
  // As = sqrt(3)/2 L^2: 1 and 2 mm; all of the map is within the child radius, or beyond all decay.
  expectDone("--targetPoint 10,0,40 --minimumEdgeLength 1 --maximumEdgeLength 2 --childRadius 100 map.nrrd a.nrrd");
  expectDone("--targetPoint 10,0,40 --minimumArea 0.8660254037844386 --maximumArea 3.4641016151377544 "
             "--childRadius 100 --report r.json map.nrrd b.nrrd");
  EXPECT_NE(readBytes(folder.file("r.json")).find("\"rising\": \"area\""), std::string::npos);
  const ScaleField a = readScale(folder.file("a.nrrd")), b = readScale(folder.file("b.nrrd"));
  ASSERT_EQ(a.lengths.size(), b.lengths.size());
  for (std::size_t n = 0; n < a.lengths.size(); ++n) EXPECT_NEAR(a.lengths[n], b.lengths[n], 1e-6);

  // Between them one exponential rises, of the length or of the area.
  const std::string decay = "--targetPoint 10,0,40 --childRadius 1 --decayLength 2 --spacing 1 ";
  expectDone(decay + "--minimumEdgeLength 1 --maximumEdgeLength 2 map.nrrd c.nrrd");
  expectDone(decay + "--minimumArea 0.8660254037844386 --maximumArea 3.4641016151377544 map.nrrd d.nrrd");
  const ScaleField c = readScale(folder.file("c.nrrd")), d = readScale(folder.file("d.nrrd"));
  double longest = 0;
  for (std::size_t n = 0; n < c.lengths.size(); ++n)
  {
    EXPECT_NEAR(d.lengths[n], std::sqrt(1 + 3 * (c.lengths[n] - 1)), 1e-5);
    longest = std::max(longest, double(c.lengths[n]));
  }
  EXPECT_GT(longest, 1.5);
  const std::string end = " --targetPoint 10,0,40 map.nrrd scale.nrrd";
  expectRefused("--minimumArea 1" + end, 2, "expected both or none");
  expectRefused("--minimumArea 2 --maximumArea 1" + end, 2, "above the maximum");
  expectRefused("--minimumArea 1 --maximumArea 2 --maximumEdgeLength 4" + end, 2, "areas and edge lengths");
}

TEST_F(SurgicalPathScaleCLI, WritesTheNullDisplacementMap)
{
  folder.write("names.ctbl", "1 bone 200 200 180 255\n7 skin 255 200 150 255\n9 absent 1 2 3 255\n");
  expectDone("--path path.fcsv --nullDisplacementPathDistance 5 --nullDisplacementTissues skin --names names.ctbl "
             "--outputLabelMap far.nrrd map.nrrd scale.nrrd");
  const TissueMap far = readTissueMap(folder.file("far.nrrd"));
  EXPECT_EQ(presentLabels(far), (std::vector<Label>{ 1, 7, 10 }));
  EXPECT_EQ(far.table.at(10).name, "null displacement");
  EXPECT_TRUE(far.table.at(10).isNullDisplacement);
  EXPECT_EQ(far.table.at(1).name, "bone");
  EXPECT_EQ(far.table.count(9), 0u);
  for (std::size_t n = 0; n < far.labels.size(); ++n) EXPECT_EQ(far.labels[n] == 1, map.labels[n] == 1);
}

TEST_F(SurgicalPathScaleCLI, ReportsWhatItFound)
{
  folder.write("lengths.csv", "label,minimum,maximum,factor\n7,0.5,2,\n");
  expectDone("--targets target.fcsv --path path.fcsv --tissueLengths lengths.csv --gradation 0.2 --report r.json "
             "--returnparameterfile r.txt map.nrrd scale.nrrd");
  rapidjson::Document report;
  report.Parse(readBytes(folder.file("r.json")).c_str());
  ASSERT_TRUE(report.IsObject());
  EXPECT_EQ(report["map"]["tissues"].GetInt(), 2);
  EXPECT_EQ(report["paths"].Size(), 1u);
  EXPECT_EQ(report["parameters"]["tissuesWithOwnLengths"].GetInt(), 1);
  EXPECT_EQ(report["parameters"]["gradation"].GetDouble(), 0.2);
  EXPECT_EQ(report["warnings"].Size(), 0u);
  const std::string tetrahedra = "estimatedTetrahedra = " + std::to_string(report["estimate"]["tetrahedra"].GetInt64());
  EXPECT_GT(report["estimate"]["tetrahedra"].GetInt64(), 0);
  EXPECT_NE(readBytes(folder.file("r.txt")).find(tetrahedra), std::string::npos);
}

TEST_F(SurgicalPathScaleCLI, EstimatesAndMarksWhatRepeatedVoxelsAreMeshedAs)
{
  const TissueMap coarse = paintedMap({ 20, 20, 20 },
                                      [](int i, int j, int k)
                                      {
                                        const int x = i - 9, y = j - 10, z = k - 10;
                                        return x * x + y * y + z * z < 70 ? 3 : 0;
                                      });
  const VoxelRepeats repeats = repeatsOf(coarse, 16);
  folder.write("coarse.nrrd", nrrd("uint16", nrrdGeometry(coarse.grid), coarse.labels));
  folder.write("fine.nrrd", nrrd("uint16", nrrdGeometry(repeats.grid), withRepeats(coarse, repeats).labels));
  std::vector<rapidjson::Document> reports(2);
  for (const bool isFine : { false, true })
  {
    const std::string name = isFine ? "fine" : "coarse";
    expectDone("--targetPoint 10,10,10 --nullDisplacementRadius 5 --outputLabelMap marked-" + name +
               ".nrrd --report r.json " + name + ".nrrd scale.nrrd");
    reports[isFine].Parse(readBytes(folder.file("r.json")).c_str());
  }
  const TissueMap marked = readTissueMap(folder.file("marked-coarse.nrrd"));
  EXPECT_EQ(readTissueMap(folder.file("marked-fine.nrrd")).labels, withRepeats(marked, repeats).labels);
  EXPECT_EQ(reports[1]["nullDisplacement"]["voxels"].GetInt64(),
            4096 * reports[0]["nullDisplacement"]["voxels"].GetInt64());
  EXPECT_NEAR(reports[1]["nullDisplacement"]["volume"].GetDouble(),
              reports[0]["nullDisplacement"]["volume"].GetDouble(), 1e-6);
  EXPECT_EQ(reports[1]["map"]["size"][0].GetInt(), 320);
  const rapidjson::Value &once = reports[0]["estimate"], &often = reports[1]["estimate"];
  EXPECT_EQ(often["meshedVoxels"].GetInt64(), 20 * 20 * 20);
  for (const char* name : { "voxelFaces", "startingFaces", "tetrahedralMemoryBytes" })
    EXPECT_NEAR(often[name].GetDouble(), once[name].GetDouble(), 0.02 * once[name].GetDouble()) << name;
  EXPECT_GT(often["surfaceMemoryBytes"].GetInt64(), once["surfaceMemoryBytes"].GetInt64()) << "for reading";
}

TEST_F(SurgicalPathScaleCLI, SaysThatATargetLiesOutside)
{
  const Outcome result = run("--targetPoint 500,0,40 --report r.json map.nrrd scale.nrrd");
  EXPECT_EQ(result.status, 0);
  EXPECT_EQ(result.err, "SurgicalPathScaleCLI: warning: target (500, 0, 40) mm LPS lies outside the label map\n");
  EXPECT_NE(readBytes(folder.file("r.json")).find("target (500, 0, 40) mm LPS lies outside"), std::string::npos);
}

TEST_F(SurgicalPathScaleCLI, SaysThatItsVoxelsAreTooLarge)
{
  const std::string fine = "--targetPoint 10,0,40 --minimumEdgeLength 0.1 --childRadius 0.5 --report r.json ";
  const Outcome result = run(fine + "map.nrrd scale.nrrd");
  EXPECT_EQ(result.status, 0);
  EXPECT_NE(result.err.find("voxels of 2 mm are too large"), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("expected --spacing 0.38 or less, or a larger child radius"), std::string::npos);
  EXPECT_NE(readBytes(folder.file("r.json")).find("voxels of 2 mm are too large"), std::string::npos);
  EXPECT_EQ(run(fine + "--spacing 0.38 map.nrrd scale.nrrd").err, "");
}

// B1: the new label was one that the table had a name for, which then hid that it is null displacement.
TEST_F(SurgicalPathScaleCLI, Trial_B01_NullDisplacementIsWhatItIsWhateverTheTableNames)
{
  const std::string names = "7 skin 255 200 150 255\n8 Frontal_Mid_Orb_L 1 2 3 255\n60000 Vermis 4 5 6 255\n";
  folder.write("names.ctbl", names);
  expectDone("--targetPoint 10,0,40 --nullDisplacementRadius 6 --names names.ctbl --outputLabelMap far.nrrd map.nrrd "
             "scale.nrrd");
  TissueMap far = readTissueMap(folder.file("far.nrrd"));
  EXPECT_EQ(presentLabels(far).back(), 60001);
  folder.write("more.ctbl", names + "60001 Pons 7 8 9 255\n");
  completeTissueTable(far, folder.file("more.ctbl"));
  for (const auto& [label, tissue] : far.table) EXPECT_EQ(tissue.isNullDisplacement, label == 60001) << label;
  EXPECT_EQ(far.table.at(60001).name, "null displacement");
}

TEST_F(SurgicalPathScaleCLI, Trial_B01_FormatsThatDoNotKeepItAreWarnedOf)
{
  const Outcome result =
    run("--targetPoint 10,0,40 --nullDisplacementRadius 6 --outputLabelMap far.nii.gz map.nrrd scale.nrrd");
  EXPECT_EQ(result.status, 0);
  EXPECT_NE(result.err.find("warning: far.nii.gz: the format does not keep"), std::string::npos) << result.err;
}

TEST_F(SurgicalPathScaleCLI, Trial_B02_ListsAndTheReturnParameterFileAreNoOutputs)
{
  for (const char* name : { "m.mrk.json", "p.mrk.json" })
    folder.write(name, R"({"markups":[{"type":"Fiducial","controlPoints":[{"position":[10,0,40]}]}]})");
  expectRefused("--targets m.mrk.json --report m.mrk.json map.nrrd scale.nrrd", 2, "is an input, too");
  expectRefused("--targets m.mrk.json,p.mrk.json --report p.mrk.json map.nrrd scale.nrrd", 2, "is an input, too");
  expectRefused("--targets m.mrk.json --path p.mrk.json --report ./p.mrk.json map.nrrd scale.nrrd", 2, "is an input");
  expectRefused("--targets target.fcsv --returnparameterfile map.nrrd map.nrrd scale.nrrd", 2, "is an input, too");
  expectRefused("--targets target.fcsv --returnparameterfile scale.nrrd map.nrrd scale.nrrd", 2, "is an output of");
}

TEST_F(SurgicalPathScaleCLI, Trial_B14_NestedJsonIsRefused)
{
  folder.write("deep.mrk.json", std::string(300000, '['));
  expectRefused("--targets deep.mrk.json map.nrrd scale.nrrd", 1, "deep.mrk.json: not valid JSON");
  folder.write("deep.mrk.json", std::string(300000, '[') + std::string(300000, ']'));
  expectRefused("--targets deep.mrk.json map.nrrd scale.nrrd", 1, "deep.mrk.json: no array \"markups\"");
}

TEST_F(SurgicalPathScaleCLI, Trial_B15_WhatIsNotThereIsSaid)
{
  const std::string far = "--nullDisplacementRadius 5 --outputLabelMap far.nrrd ";
  expectRefused(far + "--targets target.fcsv --nullDisplacementTissues 99 map.nrrd scale.nrrd", 2,
                "no voxel of tissue 99");
  folder.write("still.fcsv", "F,1,2,3\nF,1,2,3\nF,1,2,3\n");
  expectRefused("--path still.fcsv map.nrrd scale.nrrd", 1, "still.fcsv: a path of length 0");
  expectRefused("--pathPoint 1,2,3 --pathPoint 1,2,3 map.nrrd scale.nrrd", 2, "a path of length 0");
  folder.write("lengths.csv", "label,minimum\n1,2,3\n");
  expectRefused("--targets target.fcsv --tissueLengths lengths.csv map.nrrd scale.nrrd", 1,
                "lengths.csv:2: 3 fields, expected at most 2");
  folder.write("names.ctbl", "1 bone 1 2 3 255\n1 skin 1 2 3 255\n");
  const Outcome result = run("--targets target.fcsv --names names.ctbl map.nrrd scale.nrrd");
  EXPECT_EQ(result.status, 0);
  EXPECT_NE(result.err.find("names.ctbl:2: label 1 is listed for the second time"), std::string::npos) << result.err;
}

TEST_F(SurgicalPathScaleCLI, Trial_3a_AnImageOfIntensitiesIsWarnedOf)
{
  for (int n = 0; n < int(map.labels.size()); ++n)
    map.labels[n] = Label(100 + 3 * (n % 12) + 2 * (n / 12 % 10) + n / 120);
  folder.write("t1.nrrd", nrrd("uint16", nrrdGeometry(map.grid), map.labels));
  const Outcome result = run("--targets target.fcsv t1.nrrd scale.nrrd");
  EXPECT_EQ(result.status, 0);
  EXPECT_NE(result.err.find("t1.nrrd: looks like an image of intensities"), std::string::npos) << result.err;
}

TEST_F(SurgicalPathScaleCLI, RefusesBadInputWithOneLineAndStatusOne)
{
  folder.write("point.fcsv", "F,1,2,3\n");
  folder.write("nan.fcsv", "F,1,nan,3\n");
  folder.write("broken.mrk.json", "{");
  folder.write("text.nrrd", "not a map\n");
  folder.write("empty.nrrd", nrrd("uint8", cubeGeometry(2), std::vector<std::uint8_t>(8, 0)));
  folder.write("real.nrrd", nrrd("float", cubeGeometry(2), std::vector<float>(8, 0.5f)));
  folder.write("negative.nrrd", nrrd("int16", cubeGeometry(2), std::vector<std::int16_t>(8, -1)));
  const std::vector<std::uint8_t> ones(16, 1);
  folder.write("series.nrrd", nrrd("uint8", "dimension: 4\nsizes: 2 2 2 2\n", ones));
  folder.write("vector.nrrd",
               nrrd("uint8", "dimension: 4\nsizes: 2 2 2 2\nkinds: vector domain domain domain\n", ones));
  writeTissueMap(map, folder.file("cut.nii.gz"));
  const std::string whole = readBytes(folder.file("cut.nii.gz"));
  folder.write("cut.nii.gz", whole.substr(0, whole.size() / 2));
  folder.write("lengths.csv", "label,minimum\nnobody,2\n");
  expectRefused("--targetPoint 0,0,0 missing.nrrd scale.nrrd", 1, "missing.nrrd: no such file");
  expectRefused("--targetPoint 0,0,0 . scale.nrrd", 1, "is a folder");
  expectRefused("--targetPoint 0,0,0 text.nrrd scale.nrrd", 1, "text.nrrd: ");
  expectRefused("--targetPoint 0,0,0 empty.nrrd scale.nrrd", 1, "empty.nrrd: no voxel but background");
  expectRefused("--targetPoint 0,0,0 real.nrrd scale.nrrd", 1, "real.nrrd: a voxel of value 0.5");
  expectRefused("--targetPoint 0,0,0 negative.nrrd scale.nrrd", 1, "negative.nrrd: a voxel of value -1");
  expectRefused("--targetPoint 0,0,0 series.nrrd scale.nrrd", 1, "series.nrrd: ");
  expectRefused("--targetPoint 0,0,0 vector.nrrd scale.nrrd", 1, "vector.nrrd: ");
  expectRefused("--targetPoint 0,0,0 cut.nii.gz scale.nrrd", 1, "cut.nii.gz: ");
  expectRefused("--targets missing.fcsv map.nrrd scale.nrrd", 1, "missing.fcsv: no such file");
  expectRefused("--targets nan.fcsv map.nrrd scale.nrrd", 1, "nan.fcsv:1: ");
  expectRefused("--targets broken.mrk.json map.nrrd scale.nrrd", 1, "broken.mrk.json: not valid JSON");
  expectRefused("--path point.fcsv map.nrrd scale.nrrd", 1, "point.fcsv: a path of one point");
  expectRefused("--targets target.fcsv --tissueLengths lengths.csv map.nrrd scale.nrrd", 1, "lengths.csv:2: ");
  expectRefused("--targets target.fcsv map.nrrd nowhere/scale.nrrd", 1, "nowhere");
}

TEST_F(SurgicalPathScaleCLI, LeavesNoFileHalfWritten)
{
  expectSaysThatAFileCanNotGrow("--targets target.fcsv --spacing 0.5 --report r.json map.nrrd scale.nrrd");
  expectSaysThatTheDiskIsFull("--targets target.fcsv --spacing 0.4 --report disk/r.json map.nrrd disk/scale.nrrd");
}

TEST_F(SurgicalPathScaleCLI, RefusesBadCommandLinesWithOneLineAndStatusTwo)
{
  const std::string target = "--targets target.fcsv ";
  expectRefused("map.nrrd scale.nrrd", 2, "neither a target nor a path");
  expectRefused("--pathPoint 0,0,0 map.nrrd scale.nrrd", 2, "--pathPoint is given once");
  expectRefused(target + "--combine path map.nrrd scale.nrrd", 2, "the paths alone count, but none is given");
  expectRefused(target + "--minimumEdgeLength 9 map.nrrd scale.nrrd", 2, "is above the maximum");
  for (const char* option : { "--minimumEdgeLength", "--maximumEdgeLength", "--decayLength", "--spacing" })
  {
    for (const char* value : { "0", "-1", "nan", "inf", "1e999", "two" })
    {
      expectRefused(target + option + " " + value + " map.nrrd scale.nrrd", 2, option + 2);
    }
  }
  expectRefused(target + "--outputLabelMap far.nrrd map.nrrd scale.nrrd", 2, "null-displacement");
  expectRefused(target + "--nullDisplacementPathDistance 5 --outputLabelMap far.nrrd map.nrrd scale.nrrd", 2,
                "but no path");
  expectRefused(target + "--nullDisplacementRadius 5 --nullDisplacementTissues pituitary --outputLabelMap far.nrrd "
                         "map.nrrd scale.nrrd",
                2, "\"pituitary\" is neither a label nor");
}
