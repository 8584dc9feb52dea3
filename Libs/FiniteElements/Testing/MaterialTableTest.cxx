// SPDX-License-Identifier: Apache-2.0
#include "MaterialTable.h"

#include "../../Libs/TissueMap/Testing/TestFiles.h"

namespace surgicalmesher
{
namespace
{

class MaterialTable : public testing::Test
{
protected:
  MaterialTable()
  {
    names[3].name = "gray matter";
    names[5].name = "skull";
    names[8].name = "absent";
  }

  std::map<Label, TissueMaterial> read(const std::string& text) const
  {
    return readMaterialTable(folder.write("m.csv", text), names, { 3, 4, 5 });
  }

  void expectRefused(const std::string& text, const std::string& expected) const
  {
    test::expectInputError([&] { read(text); }, folder.file("m.csv"), expected);
  }

  test::TemporaryFolder folder;
  TissueTable names;
};

TEST_F(MaterialTable, ReadsLabelsAndNamesInTheFilesUnits)
{
  const auto table = read("# stiff and soft\nTissue, Model, Young's modulus, Poissons_ratio, density\n\n"
                          "gray_matter, neo-Hookean, 3, 0.45, 1040\n5, linear, 15e6, 0.3,\n\"4\",,1,-0.5,2\n");
  ASSERT_EQ(table.size(), 3u);
  EXPECT_EQ(table.at(3).nonlinearLaw, MaterialLaw::NeoHookean);
  EXPECT_DOUBLE_EQ(table.at(3).youngsModulus, 0.003);
  EXPECT_EQ(table.at(3).poissonsRatio, 0.45);
  EXPECT_DOUBLE_EQ(table.at(3).density, 1.04e-9);
  EXPECT_EQ(table.at(5).nonlinearLaw, MaterialLaw::LinearElastic);
  EXPECT_DOUBLE_EQ(table.at(5).youngsModulus, 15000);
  EXPECT_DOUBLE_EQ(table.at(5).density, 1e-9);
  EXPECT_EQ(table.at(4).nonlinearLaw, MaterialLaw::NeoHookean);
  EXPECT_EQ(table.at(4).poissonsRatio, -0.5);
}

TEST_F(MaterialTable, ColumnsComeInAnyOrderAndTwoMayLack)
{
  const auto table = read("poissonsRatio,tissue,youngsModulus\n0.4,3,2\n");
  EXPECT_DOUBLE_EQ(table.at(3).youngsModulus, 0.002);
}

TEST_F(MaterialTable, RefusesANameThatSeveralTissuesHave)
{
  names[5].name = "gray_matter";
  expectRefused("tissue,youngsModulus,poissonsRatio\ngray matter,2,0.4\n",
                "\"gray matter\" is the name of the tissues 3, 5, expected a label");
}

TEST_F(MaterialTable, TellsWhichTissuesAreLeftToTheDefault)
{
  const std::string file = folder.write("m.csv", "tissue,youngsModulus,poissonsRatio\n3,2,0.4\n");
  std::vector<std::string> warnings;
  readMaterialTable(file, names, { 3, 4, 5 }, &warnings);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(warnings[0],
            file + ": no row for 2 of 3 tissues, which get the default of soft tissue, 3 kPa: tissue 4, skull");
  readMaterialTable(file, names, { 3 }, &warnings);
  EXPECT_EQ(warnings.size(), 1u);
}

TEST_F(MaterialTable, RefusesHeadersAtFault)
{
  expectRefused("", "no tissue");
  expectRefused("tissue,youngsModulus,poissonsRatio\n", "no tissue");
  expectRefused("tissue,youngsModulus\n3,1\n", "poissonsRatio");
  expectRefused("tissue,youngsModulus,poissonsRatio,colour\n", "colour");
  expectRefused("tissue,youngsModulus,poissonsRatio,tissue\n", "at most once");
}

TEST_F(MaterialTable, RefusesRowsAtFault)
{
  const std::string header = "tissue,model,youngsModulus,poissonsRatio,density\n";
  for (const char* tissue : { "nose", "", "0", "6", "absent", "-3", "70000" })
  {
    expectRefused(header + tissue + ",linear,1,0.3,1000\n", "m.csv:2: ");
  }
  expectRefused(header + "3,rubber,1,0.3,1000\n", "rubber");
  for (const char* young : { "0", "-1", "", "nan", "inf", "soft" })
  {
    expectRefused(header + "3,linear," + young + ",0.3,1000\n", "kPa");
  }
  for (const char* poisson : { "0.5", "-1", "0.6", "", "nan" })
  {
    expectRefused(header + "3,linear,1," + poisson + ",1000\n", "between -1 and 0.5");
  }
  for (const char* density : { "0", "-1", "nan", "x" })
  {
    expectRefused(header + "3,linear,1,0.3," + density + "\n", "kg/m^3");
  }
  expectRefused(header + "3,linear,1,0.3,1000\ngray matter,linear,1,0.3,1000\n",
                "m.csv:3: tissue gray matter is listed");
}

TEST_F(MaterialTable, RefusesAMissingFile)
{
  test::expectInputError([&] { readMaterialTable(folder.file("none.csv"), names, { 3 }); }, folder.file("none.csv"),
                         "");
}

} // namespace
} // namespace surgicalmesher
