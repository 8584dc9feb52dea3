// SPDX-License-Identifier: Apache-2.0
#include "TestFiles.h"
#include "TissueMapIO.h"

using namespace surgicalmesher;
using namespace surgicalmesher::test;

namespace
{

using Lists = std::vector<std::vector<Vec3>>;

std::string controlPoint(const std::string& position, const std::string& more = "")
{
  return R"({ "id": "1", "label": "F-1", "position": )" + position + more + " }";
}

std::string markup(const std::string& type, const std::string& system, const std::string& points)
{
  return R"({ "type": ")" + type + R"(", "coordinateSystem": )" + system +
         R"(, "coordinateUnits": "mm", "controlPoints": [)" + points + "] }";
}

std::string document(const std::string& markups) { return R"({ "markups": [)" + markups + "] }"; }

Lists readContent(const std::string& name, const std::string& content)
{
  const TemporaryFolder folder;
  return readMarkups(folder.write(name, content));
}

void expectRefused(const std::string& name, const std::string& content, const std::string& expected)
{
  const TemporaryFolder folder;
  const std::string file = folder.write(name, content);
  expectInputError([&] { readMarkups(file); }, file, expected);
}

} // namespace

TEST(Markups, GivesTheSamePointsInEveryFormAndFrame)
{
  const Lists expected{ { { -1.5, 20.25, -10 } } };
  EXPECT_EQ(readContent("a.mrk.json", document(markup("Fiducial", "\"LPS\"", controlPoint("[-1.5, 20.25, -10]")))),
            expected);
  EXPECT_EQ(readContent("a.mrk.json", document(markup("Fiducial", "\"RAS\"", controlPoint("[1.5, -20.25, -10]")))),
            expected);
  EXPECT_EQ(readContent("a.mrk.json", document(markup("Fiducial", "\"1\"", controlPoint("[-1.5, 20.25, -10]")))),
            expected);
  EXPECT_EQ(readContent("a.mrk.json", document(markup("Fiducial", "0", controlPoint("[1.5, -20.25, -10]")))), expected);
  EXPECT_EQ(readContent("a.json", document(markup("Fiducial", "1", controlPoint("[-1.5, 20.25, -1e1]")))), expected);
  const std::string columns = "# columns = id,x,y,z,ow,ox,oy,oz,vis,sel,lock,label,desc,associatedNodeID\n";
  const std::string ras = "vtkMRML_0,1.5,-20.25,-10,0,0,0,1,1,1,0,F-1,\"a, b\",\n";
  const std::string lps = "vtkMRML_0,-1.5,20.25,-10,0,0,0,1,1,1,0,F-1,,\n";
  EXPECT_EQ(readContent("a.fcsv", "# Markups fiducial file version = 4.6\n# CoordinateSystem = 0\n" + columns + ras),
            expected);
  EXPECT_EQ(readContent("a.fcsv", "# Markups fiducial file version = 4.11\n# CoordinateSystem = LPS\n" + columns + lps),
            expected);
  EXPECT_EQ(readContent("a.fcsv", "# CoordinateSystem = 1\n" + columns + lps), expected);
  EXPECT_EQ(readContent("a.fcsv", "# columns = label,x,y,z,sel,vis\r\nF,1.5,-20.25,-10,1,1\r\n"), expected);
  EXPECT_EQ(readContent("a.fcsv", "# columns = x,y,z,label\n1.5,-20.25,-10,F\n"), expected);
  EXPECT_EQ(readContent("a.fcsv", "F,1.5,-20.25,-10,1,1\n"), expected);
}

TEST(Markups, KeepsListsApartAndClosesCurves)
{
  const std::string points =
    controlPoint("[0, 0, 0]") + "," + controlPoint("[1, 0, 0]") + "," + controlPoint("[1, 1, 0]");
  const Lists lists =
    readContent("a.mrk.json", document(markup("Curve", "\"LPS\"", points) + "," +
                                       markup("ClosedCurve", "\"LPS\"", points) + "," + markup("Line", "\"LPS\"", "")));
  ASSERT_EQ(lists.size(), 2u);
  EXPECT_EQ(lists[0].size(), 3u);
  ASSERT_EQ(lists[1].size(), 4u);
  EXPECT_EQ(lists[1].front(), lists[1].back());
}

TEST(Markups, ArePathsAndTargets)
{
  const TemporaryFolder folder;
  const std::string one = controlPoint("[1, 2, 3]"), two = one + "," + controlPoint("[4, 5, 6]");
  const std::string points = folder.write("points.mrk.json", document(markup("Fiducial", "\"LPS\"", two)));
  const std::string point = folder.write("point.mrk.json", document(markup("Fiducial", "\"LPS\"", one)));
  const Focus focus = readFocus({ { 7, 8, 9 } }, { points, point }, { { 0, 0, 0 }, { 1, 0, 0 } }, { points });
  EXPECT_EQ(focus.targets, (Path{ { 7, 8, 9 }, { 1, 2, 3 }, { 4, 5, 6 }, { 1, 2, 3 } }));
  EXPECT_EQ(focus.paths, (Lists{ { { 0, 0, 0 }, { 1, 0, 0 } }, { { 1, 2, 3 }, { 4, 5, 6 } } }));
  EXPECT_THROW(readFocus({}, {}, { { 0, 0, 0 } }, {}), UsageError);
  expectInputError([&] { readFocus({}, {}, {}, { point }); }, point, "two points or more");
}

TEST(Markups, LeavesOutPointsThatAreNotPlaced)
{
  const std::string points = controlPoint("[9, 9, 9]", R"(, "positionStatus": "undefined")") + "," +
                             controlPoint("[1, 2, 3]", R"(, "positionStatus": "defined")") + "," +
                             controlPoint("[]", R"(, "positionStatus": "missing")");
  EXPECT_EQ(readContent("a.mrk.json", document(markup("Fiducial", "\"LPS\"", points))), (Lists{ { { 1, 2, 3 } } }));
}

TEST(Markups, LeavesOutPointsOfFcsvThatAreNotPlaced)
{
  const std::string header = "# Markups fiducial file version = 5.2\n# CoordinateSystem = LPS\n"
                             "# columns = id,x,y,z,ow,ox,oy,oz,vis,sel,lock,label,desc,associatedNodeID\n";
  const std::string placed = "1,1,2,3,0,0,0,1,1,1,0,F-1,,,2,0\n";
  const std::string others = "2,0,0,0,0,0,0,1,1,1,0,F-2,,,0,0\n3,0,0,0,0,0,0,1,1,1,0,F-3,,,3,0\n";
  EXPECT_EQ(readContent("a.fcsv", header + placed + others), (Lists{ { { 1, 2, 3 } } }));
  expectRefused("a.fcsv", header + others, "no control point");
  const std::string description = "1,1,2,3,0,0,0,1,1,1,0,F-1,a, b, c,\n"; // commas that version 4 did not quote
  EXPECT_EQ(readContent("a.fcsv", header + description), (Lists{ { { 1, 2, 3 } } }));
}

TEST(Markups, RefusesFilesWithoutPoints)
{
  expectRefused("a.mrk.json", document(""), "no control point");
  expectRefused("a.mrk.json", document(markup("Fiducial", "\"LPS\"", "")), "no control point");
  expectRefused("a.fcsv", "# CoordinateSystem = 0\n", "no control point");
  expectRefused("a.txt", "1 2 3", "expected .mrk.json or .fcsv");
}

TEST(Markups, RefusesCoordinatesThatAreNone)
{
  const auto json = [](const char* position)
  { return document(markup("Fiducial", "\"LPS\"", controlPoint(position))); };
  expectRefused("a.mrk.json", json("[1, 2]"), "a position of three numbers");
  expectRefused("a.mrk.json", json("[1, 2, \"3\"]"), "a position of three numbers");
  expectRefused("a.mrk.json", json("[1, 2, null]"), "a position of three numbers");
  expectRefused("a.mrk.json", json("[1, 2, 1e999]"), "not valid JSON");
  expectRefused("a.mrk.json", json("[1, 2, NaN]"), "not valid JSON");
  for (const char* line : { "F,1,2,three\n", "F,1,2\n", "F,1,nan,3\n", "F,1,inf,3\n", "F,1,,3\n" })
  {
    expectRefused("a.fcsv", std::string("# columns = label,x,y,z\n") + line, ":2: ");
  }
}

TEST(Markups, ReadsUnitsFromAList)
{
  const TemporaryFolder folder;
  folder.write("a.mrk.json", R"({ "markups": [ { "coordinateUnits": ["mm", "UCUM", "millimeter"], "controlPoints": [)" +
                               controlPoint("[1, 2, 3]") + "] } ] }");
  EXPECT_EQ(readMarkups(folder.file("a.mrk.json")).at(0).at(0).x, 1);
}

TEST(Markups, RefusesDocumentsThatAreNone)
{
  expectRefused("a.mrk.json", "{ \"markups\": [", "not valid JSON at byte");
  expectRefused("a.mrk.json", "[]", "no array \"markups\"");
  expectRefused("a.mrk.json", R"({ "markups": [ 3 ] })", "without controlPoints");
  expectRefused("a.mrk.json", document(markup("Fiducial", "\"IJK\"", controlPoint("[1, 2, 3]"))),
                "expected LPS or RAS");
  for (const char* units : { "\"cm\"", "[\"um\", \"UCUM\", \"micrometer\"]", "3" })
    expectRefused("a.mrk.json",
                  std::string(R"({ "markups": [ { "coordinateUnits": )") + units + R"(, "controlPoints": [] } ] })",
                  "expected mm");
  expectRefused("a.fcsv", "# CoordinateSystem = 2\nF,1,2,3\n", "expected LPS or RAS");
  expectRefused("a.fcsv", "# columns = label,y,x,z\nF,1,2,3\n", "expected x,y,z");
}

TEST(Markups, KeepsLabelsAndMeasurementsOfPlacedPoints)
{
  const TemporaryFolder folder;
  const std::string json =
    R"({"markups":[{"type":"Curve","coordinateSystem":"LPS","controlPoints":[
      {"label":"bone","position":[1,2,3]},{"label":"gone","position":[9,9,9],"positionStatus":"undefined"},
      {"position":[4,5,6]}],
      "measurements":[{"name":"Radius","controlPointValues":[0.5,7,0.75]},{"name":"length","value":3},
      {"name":"short","controlPointValues":[1]}]}]})";
  const std::vector<Markup> markups = readLabelledMarkups(folder.write("a.mrk.json", json));
  ASSERT_EQ(markups.size(), 1u);
  EXPECT_EQ(markups[0].labels, (std::vector<std::string>{ "bone", "" }));
  ASSERT_EQ(markups[0].pointValues.size(), 1u);
  EXPECT_EQ(markups[0].pointValues.at("Radius"), (std::vector<double>{ 0.5, 0.75 }));
  const std::string fcsv = "# columns = id,x,y,z,label\nf1,1,2,3,skin\n";
  EXPECT_EQ(readLabelledMarkups(folder.write("a.fcsv", fcsv))[0].labels, (std::vector<std::string>{ "skin" }));
}
