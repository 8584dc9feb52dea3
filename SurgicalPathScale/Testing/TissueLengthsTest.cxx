// SPDX-License-Identifier: Apache-2.0
#include "TissueLengths.h"

#include "../../Libs/TissueMap/Testing/TestFiles.h"

using namespace surgicalmesher;
using namespace surgicalmesher::test;

namespace
{

TissueTable names()
{
  TissueTable table;
  table[85].name = "optic chiasm";
  table[3011].name = "adenohypophysis";
  return table;
}

void expectRefused(const std::string& content, const std::string& expected)
{
  const TemporaryFolder folder;
  const std::string file = folder.write("lengths.csv", content);
  expectInputError([&] { readTissueLengths(file, { 1, 8 }, names()); }, file, expected);
}

} // namespace

TEST(TissueLengths, ReadsLabelsNamesAndMissingValues)
{
  const TemporaryFolder folder;
  const std::string file = folder.write("lengths.csv", "# lengths of critical tissue\n\nlabel, minimum,maximum "
                                                       ",factor\r\n85,0.5,2,\nadenohypophysis,,4,0.5\n7,,,2\n\"3\"\n");
  const auto lengths = readTissueLengths(file, { 1, 8 }, names());
  ASSERT_EQ(lengths.size(), 4u);
  const auto expectLength = [&](Label label, double minimum, double maximum, double factor)
  {
    EXPECT_EQ(lengths.at(label).range.minimum, minimum);
    EXPECT_EQ(lengths.at(label).range.maximum, maximum);
    EXPECT_EQ(lengths.at(label).factor, factor);
  };
  expectLength(85, 0.5, 2, 1);
  expectLength(3011, 1, 4, 0.5);
  expectLength(7, 1, 8, 2);
  expectLength(3, 1, 8, 1);
}

TEST(TissueLengths, TakesColumnsInAnyOrderAndNamesWithUnderscores)
{
  const TemporaryFolder folder;
  const std::string file = folder.write("lengths.csv", "Factor,Name\n0.25,optic_chiasm\n");
  EXPECT_EQ(readTissueLengths(file, { 1, 8 }, names()).at(85).factor, 0.25);
}

TEST(TissueLengths, RefusesBadRowsWithTheirLine)
{
  expectRefused("label,minimum\n85,abc\n", ":2: \"abc\", expected a finite number above 0");
  expectRefused("label,minimum\n85,0\n", ":2: ");
  expectRefused("label,minimum\n85,-1\n", ":2: ");
  expectRefused("label,minimum\n85,nan\n", ":2: ");
  expectRefused("label,factor\n1,1\n85,inf\n", ":3: ");
  expectRefused("label,minimum\n85,9\n", ":2: the minimum edge length is above the maximum");
  expectRefused("label,minimum\npituitary,1\n", ":2: \"pituitary\" is neither");
  expectRefused("label,minimum\n70000,1\n", ":2: \"70000\" is neither");
  expectRefused("label,minimum\n0,1\n", ":2: \"0\" is neither");
  expectRefused("label,minimum\n85,1\noptic chiasm,1\n", ":3: tissue optic chiasm is listed for the second time");
}

TEST(TissueLengths, RefusesTablesThatAreNone)
{
  expectRefused("85,1,2\n", ":1: column \"85\"");
  expectRefused("minimum,maximum\n1,2\n", "no column label or name");
  expectRefused("label,label\n1,2\n", "each at most once");
  expectRefused("label,minimum\n", "no tissue");
  expectRefused("", "no tissue");
}
