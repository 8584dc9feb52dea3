// SPDX-License-Identifier: Apache-2.0
#include "ToolPath.h"
#include "../../Libs/TissueMap/Testing/TestFiles.h"

#include <gtest/gtest.h>

using namespace surgicalmesher;
using namespace surgicalmesher::test;

namespace
{

std::string refusalOf(const std::string& table)
{
  const TemporaryFolder folder;
  folder.write("tool.csv", table);
  try
  {
    readToolPath(folder.file("tool.csv"));
  }
  catch (const InputError& error)
  {
    return error.what();
  }
  return "";
}

} // namespace

TEST(ToolPath, GoesStraightFromRowToRow)
{
  const TemporaryFolder folder;
  folder.write("tool.csv", "z,y,x,seconds\n3,2,1,0.5\n# pause\n7,2,1,1.5\n");
  const ToolPath path = readToolPath(folder.file("tool.csv"));
  EXPECT_EQ(tipAt(path, 0), (Vec3{ 1, 2, 3 }));
  EXPECT_EQ(tipAt(path, 1), (Vec3{ 1, 2, 5 }));
  EXPECT_EQ(tipAt(path, 1.5), (Vec3{ 1, 2, 7 }));
  EXPECT_EQ(tipAt(path, 9), (Vec3{ 1, 2, 7 }));
}

TEST(ToolPath, RefusesWhatIsNoMotion)
{
  EXPECT_NE(refusalOf("seconds,x,y,z\n0,1,2,3\n").find("two places"), std::string::npos);
  EXPECT_NE(refusalOf("seconds,x,y,z\n0,1,2,3\n0,1,2,4\n").find(":3: time 0 s, expected one later"), std::string::npos);
  EXPECT_NE(refusalOf("seconds,x,y,z\n0,1,2,3\n1,1,nan,4\n").find("y \"nan\", expected a finite"), std::string::npos);
  EXPECT_NE(refusalOf("seconds,x,y\n0,1,2\n1,1,2\n").find("z \"\""), std::string::npos);
  EXPECT_NE(refusalOf("seconds,x,y,force\n0,1,2,3\n").find("force"), std::string::npos);
  EXPECT_NE(refusalOf("").find("0 rows"), std::string::npos);
}
