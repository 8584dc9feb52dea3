// SPDX-License-Identifier: Apache-2.0
#include "TestFiles.h"
#include "TissueMapIO.h"

using namespace surgicalmesher;
using namespace surgicalmesher::test;

namespace
{

TissueTable readText(const std::string& content)
{
  const TemporaryFolder folder;
  return readTissueTable(folder.write("table.ctbl", content));
}

void expectRefused(const std::string& content, const std::string& expected)
{
  const TemporaryFolder folder;
  const std::string file = folder.write("table.txt", content);
  expectInputError([&] { readTissueTable(file); }, file, expected);
}

} // namespace

TEST(TissueTable, ReadsSlicerColourTables)
{
  const TissueTable table = readText("# Color table file\r\n# 3 values\r\n0 background 0 0 0 0\r\n"
                                     "85 optic_chiasm 255 51 0 255\r\n3011 adenohypophysis 0 0 255 255\r\n");
  ASSERT_EQ(table.size(), 2u);
  EXPECT_EQ(table.at(85).name, "optic chiasm");
  EXPECT_EQ(table.at(85).color, (std::array<double, 3>{ 1, 0.2, 0 }));
  EXPECT_EQ(table.at(3011).name, "adenohypophysis");
}

TEST(TissueTable, ReadsItkSnapLabels)
{
  const TissueTable table = readText("################\n# ITK-SnAP Label Description File\n"
                                     "    0     0    0    0        0  0  0    \"Clear Label\"\n"
                                     "    7   255    0  102        1  1  1    \"optic nerve, left\"\n");
  ASSERT_EQ(table.size(), 1u);
  EXPECT_EQ(table.at(7).name, "optic nerve, left");
  EXPECT_EQ(table.at(7).color, (std::array<double, 3>{ 1, 0, 0.4 }));
}

TEST(TissueTable, ReadsListsOfNames)
{
  const TissueTable table = readText("1 Precentral_L 2001\n2\tMiddle_cerebellar_peduncle\n3 CA1 field\n");
  EXPECT_EQ(table.at(1).name, "Precentral L");
  EXPECT_EQ(table.at(2).name, "Middle cerebellar peduncle");
  EXPECT_EQ(table.at(3).name, "CA1 field");
}

TEST(TissueTable, RefusesLinesThatAreNone)
{
  expectRefused("1 skin 10 20 30 255\nbone 2 10 20 30\n", ":2: \"bone 2 10 20 30\", expected a label");
  expectRefused("-1 skin 10 20 30 255\n", "expected a label from 0 to 65535");
  expectRefused("65536 skin 10 20 30 255\n", "expected a label from 0 to 65535");
  expectRefused("1.5 skin 10 20 30 255\n", "expected a label from 0 to 65535");
  expectRefused("12\n", "expected a label");
  expectRefused("# nothing\n\n", "no tissue");
}

TEST(TissueTable, NamesOfAMapBecomeLegible)
{
  TissueMap map;
  map.grid.size = { 6, 1, 1 };
  map.labels = { 1, 2, 3, 4, 5, 6 };
  map.table[1].name = "na\xc3\xafve \xe2\x82\xac \xf0\x9f\xa7\xa0"; // UTF-8 of two, three and four bytes
  map.table[2].name = "caf\xe9";                                    // Latin-1
  map.table[3].name = "a\tb\x01\x7f";
  map.table[4].name = "\xc0\xaf \xed\xa0\x80 \xf5\x80\x80\x80"; // overlong, surrogate, beyond Unicode
  map.table[5].name = "cut \xe2\x82";
  map.table[6].name = "../<x>\"&";
  completeTissueTable(map, "");
  EXPECT_EQ(map.table.at(1).name, "na\xc3\xafve \xe2\x82\xac \xf0\x9f\xa7\xa0");
  EXPECT_EQ(map.table.at(2).name, "caf?");
  EXPECT_EQ(map.table.at(3).name, "a b  ");
  EXPECT_EQ(map.table.at(4).name, "?? ??? ????");
  EXPECT_EQ(map.table.at(5).name, "cut ??");
  EXPECT_EQ(map.table.at(6).name, "../<x>\"&");
}
