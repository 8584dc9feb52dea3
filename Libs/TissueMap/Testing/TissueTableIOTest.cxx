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

TEST(TissueTable, ReadsColoursWithoutAlpha)
{
  const TissueTable table = readText("1 Brain 255 0 0\n2 Brain stem 0 51 0\n3 Ventricle_3 0 0 255 255\n");
  EXPECT_EQ(table.at(1).name, "Brain");
  EXPECT_EQ(table.at(1).color, (std::array<double, 3>{ 1, 0, 0 }));
  EXPECT_EQ(table.at(2).name, "Brain stem");
  EXPECT_EQ(table.at(2).color, (std::array<double, 3>{ 0, 0.2, 0 }));
  EXPECT_EQ(table.at(3).name, "Ventricle 3");
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

// Trial, 3a: names come in more formats than were read.
TEST(Trial, 3a_SlicersCommaSeparatedTables)
{
  const TemporaryFolder folder;
  const std::string header = "LabelValue,Name,Color_R,Color_G,Color_B,Color_A,Category_CodeMeaning,Type_CodeMeaning\n";
  const TissueTable table = readTissueTable(folder.write(
    "t.csv", header + "0,background,0,0,0,0,,\n7,\"nerve, optic\",255,0,51,255,Tissue,Nerve\n9,,1,2,3,,,Bone\n"));
  ASSERT_EQ(table.size(), 2u);
  EXPECT_EQ(table.at(7).name, "nerve, optic");
  EXPECT_EQ(table.at(7).color, (std::array<double, 3>{ 1, 0, 0.2 }));
  EXPECT_EQ(table.at(9).name, "Bone");
  const std::string headless = folder.write("bad.csv", "7,nerve\n");
  expectInputError([&] { readTissueTable(headless); }, headless, "expected a header row with the columns LabelValue");
  const std::string fraction = folder.write("worse.csv", header + "1.5,nerve\n");
  expectInputError([&] { readTissueTable(fraction); }, fraction, ":2: label \"1.5\", expected one from 0 to 65535");
}

TEST(Trial, 3a_BidsLookUpTables)
{
  const TemporaryFolder folder;
  const TissueTable table = readTissueTable(folder.write(
    "a_dseg.tsv",
    "index\tname\tabbreviation\tcolor\tmapping\n1\tGray Matter\tGM\t#ff3300\t1\n2\tWhite Matter\tWM\tn/a\t2\n"));
  ASSERT_EQ(table.size(), 2u);
  EXPECT_EQ(table.at(1).name, "Gray Matter");
  EXPECT_EQ(table.at(1).color, (std::array<double, 3>{ 1, 0.2, 0 }));
  EXPECT_EQ(table.at(2).color, Tissue().color);
}

TEST(TissueTable, HasNoNameWhereBidsHasNone)
{
  const TemporaryFolder folder;
  const TissueTable table =
    readTissueTable(folder.write("a_dseg.tsv", "index\tname\tabbreviation\n1\tn/a\tGM\n2\tn/a\tn/a\n"));
  EXPECT_EQ(table.at(1).name, "GM");
  EXPECT_EQ(table.at(2).name, "");
}

TEST(Trial, 3a_FslAtlases)
{
  const auto atlas = [](const std::string& type)
  {
    return "<?xml version=\"1.0\"?>\n<atlas version=\"1.0\"><header><name>A</name><type>" + type +
           "</type></header>\n<data>\n<label index=\"0\" x=\"1\" y=\"2\" z=\"3\">Frontal Pole</label>\n"
           "<label index=\"47\" x=\"1\" y=\"2\" z=\"3\">Crus I &amp; II</label></data></atlas>\n";
  };
  const TemporaryFolder folder;
  const TissueTable probabilistic = readTissueTable(folder.write("p.xml", atlas("Probabalistic")));
  EXPECT_EQ(probabilistic.at(1).name, "Frontal Pole");
  EXPECT_EQ(probabilistic.at(48).name, "Crus I & II");
  const TissueTable labels = readTissueTable(folder.write("l.xml", atlas("Label")));
  ASSERT_EQ(labels.size(), 1u);
  EXPECT_EQ(labels.at(47).name, "Crus I & II");
  const std::string other = folder.write("other.xml", "<executable><title>x</title></executable>");
  expectInputError([&] { readTissueTable(other); }, other, "XML of another kind, expected FSL's description");
  const std::string damaged = folder.write("damaged.xml", "<atlas><data><label index=\"1\">x");
  expectInputError([&] { readTissueTable(damaged); }, damaged, "not well-formed XML");
  std::string deep;
  for (int n = 0; n < 200000; ++n) deep += "<a>";
  const std::string nested = folder.write("nested.xml", deep);
  expectInputError([&] { readTissueTable(nested); }, nested, "not well-formed XML");
}

TEST(Trial, B15_ALabelListedTwiceIsSaid)
{
  const TemporaryFolder folder;
  std::vector<std::string> warnings;
  const std::string file = folder.write("t.txt", "1 bone\n2 skin\n1 cartilage\n2 skin\n");
  EXPECT_EQ(readTissueTable(file, &warnings).at(1).name, "cartilage");
  EXPECT_EQ(warnings, std::vector<std::string>{ file + ":3: label 1 is listed for the second time, this row counts" });
}
