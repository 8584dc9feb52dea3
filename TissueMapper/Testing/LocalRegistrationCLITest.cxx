// SPDX-License-Identifier: Apache-2.0
#include "ExecutableTest.h"
#include "RegistrationPhantom.h"
#include "TissueMapIO.h"

#include <rapidjson/document.h>

#include <fstream>

using namespace surgicalmesher;
using namespace surgicalmesher::test;

namespace
{

class LocalRegistrationCLI : public ExecutableTest
{
protected:
  LocalRegistrationCLI() : ExecutableTest(LOCALREGISTRATIONCLI) {}

  void SetUp() override
  {
    writeImage(registrationPhantom(LinearMap(), ctBrightness), folder.file("ct.nrrd"));
    writeImage(registrationPhantom(poseOff(), mrBrightness), folder.file("mr.nrrd"));
  }
};

} // namespace

TEST_F(LocalRegistrationCLI, WritesTheImageTheTransformAndAReport)
{
  expectDone("--sphere 8,-35,-30,45 --transform t.tfm --report r.json --threads 2 ct.nrrd mr.nrrd a.nrrd");
  const ScalarImage registered = readImage(folder.file("a.nrrd"));
  const ScalarImage fixed = readImage(folder.file("ct.nrrd"));
  ASSERT_EQ(registered.grid.size, fixed.grid.size);

  std::ifstream stream(folder.file("t.tfm"));
  std::string word;
  while (stream >> word && word != "Parameters:")
  {
  }
  LinearMap map;
  for (Vec3& row : map.rows)
    for (int column = 0; column < 3; ++column) stream >> row[column];
  for (int axis = 0; axis < 3; ++axis) stream >> map.offset[axis];
  EXPECT_LT(worstError(map, 20), 1);

  rapidjson::Document report;
  report.Parse(readBytes(folder.file("r.json")).c_str());
  EXPECT_NEAR(report["scale"].GetDouble(), 1 / phantomScale, 0.01);
  EXPECT_EQ(report["local"].Size(), 3u);
  EXPECT_GE(report["agreeingStarts"].GetInt(), 4);
  ASSERT_TRUE(report.HasMember("informationBefore"));
  EXPECT_LT(report["informationBefore"].GetDouble(), report["information"].GetDouble());
  EXPECT_LT(report["targetInformationBefore"].GetDouble(), report["targetInformation"].GetDouble());

  expectDone("--sphere 8,-35,-30,45 --transform u.tfm --threads 1 ct.nrrd mr.nrrd b.nrrd");
  EXPECT_EQ(readBytes(folder.file("a.nrrd")), readBytes(folder.file("b.nrrd")));
  EXPECT_EQ(readBytes(folder.file("t.tfm")), readBytes(folder.file("u.tfm")));
}

TEST_F(LocalRegistrationCLI, RefusesBadInputWithOneLine)
{
  folder.write("two.fcsv", "# columns = label,x,y,z\na,0,0,0\nb,1,0,0\n");
  folder.write("three.fcsv", "# columns = label,x,y,z\na,0,0,0\nb,9,0,0\nc,0,9,0\n");
  folder.write("four.fcsv", "# columns = label,x,y,z\na,0,0,0\nb,9,0,0\nc,0,9,0\nd,0,0,9\n");
  ScalarImage flat = registrationPhantom(LinearMap(), ctBrightness);
  std::fill(flat.values.begin(), flat.values.end(), 5.f);
  writeImage(flat, folder.file("flat.nrrd"));
  TissueMap mask;
  mask.grid.size = { 4, 4, 4 };
  mask.labels.assign(64, 1);
  writeTissueMap(mask, folder.file("mask.nrrd"));
  const std::string images = " ct.nrrd mr.nrrd a.nrrd";
  expectRefused("missing.nrrd mr.nrrd a.nrrd", 1, "missing.nrrd: no such file");
  expectRefused("--initial landmarks" + images, 2, "expected --landmarks");
  expectRefused("--landmarks three.fcsv" + images, 2, "1 files, expected that of the fixed image");
  expectRefused("--landmarks two.fcsv --landmarks three.fcsv" + images, 1, "two.fcsv: 2 landmarks");
  expectRefused("--landmarks three.fcsv --landmarks four.fcsv" + images, 1, "four.fcsv: 4 landmarks, expected 3");
  expectRefused("--sphere 0,0,0,2" + images, 2, "--sphere: expected");
  expectRefused("--sphere 500,0,0,20" + images, 1, "lies outside the image");
  expectRefused("--mask mask.nrrd" + images, 1, "mask.nrrd: another grid");
  expectRefused("ct.nrrd flat.nrrd a.nrrd", 1, "the moving image has one value nearly everywhere");
}
