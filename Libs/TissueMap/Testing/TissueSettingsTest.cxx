// SPDX-License-Identifier: Apache-2.0
#include "TissueSettings.h"
#include "TestFiles.h"

using namespace surgicalmesher;
using namespace surgicalmesher::test;

namespace
{

/// Labels 1 to 6 with one voxel each, of which 2 is the grey, "left" nucleus and 5 the artery.
TissueMap sixTissues()
{
  TissueMap map;
  map.grid.size = { 7, 1, 1 };
  map.labels = { 0, 1, 2, 3, 4, 5, 6 };
  map.table[2].name = "grey, \"left\" nucleus";
  map.table[5] = { "artery", { 1, 0, 0 } };
  return map;
}

TissueSettings read(const std::string& content)
{
  const TemporaryFolder folder;
  return readTissueSettings(folder.write("tissues.csv", content), sixTissues());
}

void expectRefused(const std::string& content, const std::string& expected)
{
  const TemporaryFolder folder;
  const std::string file = folder.write("tissues.csv", content);
  expectInputError([&] { readTissueSettings(file, sixTissues()); }, file, expected);
}

} // namespace

TEST(TissueSettings, ReadsEveryColumn)
{
  const TissueSettings settings = read("# a comment\n\nName,Role, minimum,maximum,protected,islands,cavities\r\n"
                                       "\"grey, \"\"left\"\" nucleus\",mesh,0.5,2,yes,0,12\n"
                                       "artery,shell,,1.5\n"
                                       "3,group deep nuclei,,3,no\n"
                                       "4,leave\n"
                                       "6\n");
  ASSERT_EQ(settings.size(), 5u);
  const TissueSetting& nucleus = settings.at(2);
  EXPECT_EQ(nucleus.role, TissueRole::Mesh);
  EXPECT_EQ(nucleus.minimumEdgeLength, 0.5);
  EXPECT_EQ(nucleus.maximumEdgeLength, 2);
  EXPECT_TRUE(nucleus.isProtected);
  EXPECT_EQ(nucleus.islandVolume, 0);
  EXPECT_EQ(nucleus.cavityVolume, 12);
  EXPECT_EQ(settings.at(5).role, TissueRole::Shell);
  EXPECT_EQ(settings.at(5).minimumEdgeLength, 1.5);
  EXPECT_EQ(settings.at(5).maximumEdgeLength, 1.5);
  EXPECT_EQ(settings.at(3).role, TissueRole::Group);
  EXPECT_EQ(settings.at(3).group, "deep nuclei");
  EXPECT_EQ(settings.at(4).role, TissueRole::Leave);
  EXPECT_FALSE(settings.at(6).isProtected);
  EXPECT_LT(settings.at(6).islandVolume, 0);
}

TEST(TissueSettings, LabelCountsWhereANameIsGivenToo)
{
  EXPECT_EQ(read("label,name,role\n3,some remark,leave\n").at(3).role, TissueRole::Leave);
  EXPECT_EQ(read("label,name,role\n,artery,leave\n").at(5).role, TissueRole::Leave);
}

TEST(TissueSettings, RefusesBadRowsWithTheirLine)
{
  expectRefused("label,role\nartery,mesh\nvein,mesh\n", ":3: \"vein\" is neither");
  expectRefused("label,role\n0,mesh\n", ":2: \"0\" is neither");
  expectRefused("label,role\n70000,mesh\n", ":2: \"70000\" is neither");
  expectRefused("label,role\n7,mesh\n", ":2: tissue 7 has no voxel");
  expectRefused("label,role\n5,mesh\nartery,mesh\n", ":3: tissue 5 is listed for the second time");
  expectRefused("label,role\n5,hollow\n", ":2: role \"hollow\", expected mesh, group NAME, shell or leave");
  expectRefused("label,role\n5,group\n", ":2: role \"group\"");
  expectRefused("label,role\n5,grouped vessels\n", ":2: role \"grouped vessels\"");
  expectRefused("label,minimum\n5,0\n", ":2: minimum \"0\"");
  expectRefused("label,maximum\n5,nan\n", ":2: maximum \"nan\"");
  expectRefused("label,islands\n5,-1\n", ":2: islands \"-1\"");
  expectRefused("label,protected\n5,maybe\n", ":2: protected \"maybe\"");
  expectRefused("label,minimum,maximum\n5,3,2\n", ":2: the minimum edge length is above the maximum");
  expectRefused("label,role,minimum,maximum\n5,shell,1,2\n", ":2: a shell of two edge lengths");
}

TEST(TissueSettings, RefusesTablesThatAreNone)
{
  expectRefused("", "no tissue");
  expectRefused("label,role\n", "no tissue");
  expectRefused("role,minimum\nmesh,1\n", ":1: no column label or name");
  expectRefused("5,mesh\n", ":1: column \"5\"");
  expectRefused("label,role,role\n", ":1: column \"role\"");
  expectRefused("label,role\n1,leave\n2,leave\n3,leave\n4,leave\n5,leave\n6,leave\n", "every tissue is left out");
}

TEST(TissueSettings, SelectionJoinsAndLeavesOut)
{
  TissueSettings settings = read("label,role,minimum,maximum,protected,islands\n"
                                 "5,group vessels,2,4,no,9\n2,group vessels,1,,yes,\n4,leave\n6,shell,1,1,no,\n");
  TissueMap map = sixTissues();
  const TissueSelection selection = selectTissues(map, settings);
  EXPECT_EQ(map.labels, (std::vector<Label>{ 0, 1, 2, 3, 0, 2, 6 }));
  ASSERT_EQ(selection.groups.size(), 1u);
  EXPECT_EQ(selection.groups[0].label, 2);
  EXPECT_EQ(selection.groups[0].name, "vessels");
  EXPECT_EQ(selection.groups[0].members, (std::vector<Label>{ 2, 5 }));
  EXPECT_EQ(selection.voxelsLeft, (std::map<Label, std::size_t>{ { 4, 1 } }));
  EXPECT_EQ(selection.tableOfInput.at(5).name, "artery");
  EXPECT_EQ(map.table.at(2).name, "vessels");
  EXPECT_EQ(map.table.count(5), 0u);
  EXPECT_TRUE(map.table.at(6).isShell);
  EXPECT_EQ(settings.count(5), 0u);
  EXPECT_EQ(settings.at(2).minimumEdgeLength, 1);
  EXPECT_EQ(settings.at(2).maximumEdgeLength, 4);
  EXPECT_EQ(settings.at(2).islandVolume, 9);
  EXPECT_TRUE(settings.at(2).isProtected);
}
