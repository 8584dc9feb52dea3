// SPDX-License-Identifier: Apache-2.0
// What the parser accepts and refuses.
#include "Arguments.h"
#include "CommandLineTestModuleXML.h"
#include "Errors.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

using namespace surgicalmesher;

namespace
{

using Words = std::vector<std::string>;

Arguments parse(Words words) { return parseArguments(parseModuleDescription(moduleXML), words); }

/// With the positional arguments the test module needs.
Arguments parseOptions(Words words)
{
  words.insert(words.end(), { "in.vtp", "out.vtp" });
  return parse(words);
}

Words valuesOf(const std::string& name, const Words& words) { return parseOptions(words).values[name]; }

std::string refusalOf(const Words& words)
{
  try
  {
    parse(words);
  }
  catch (const UsageError& error)
  {
    return error.what();
  }
  return "accepted";
}

std::string refusalOfOptions(Words words)
{
  words.insert(words.end(), { "in.vtp", "out.vtp" });
  return refusalOf(words);
}

} // namespace

TEST(Arguments, flagsTakeTheirValueFromTheNextWordOrAfterAnEqualsSign)
{
  EXPECT_EQ(valuesOf("length", { "--length", "2" }), Words{ "2" });
  EXPECT_EQ(valuesOf("length", { "--length=2.5e1" }), Words{ "2.5e1" });
  EXPECT_EQ(valuesOf("count", { "-c", "7" }), Words{ "7" });
  EXPECT_EQ(valuesOf("text", { "--text=a=b" }), Words{ "a=b" });
  EXPECT_EQ(valuesOf("text", { "--text=" }), Words{ "" });
  EXPECT_EQ(valuesOf("text", { "--text=--length" }), Words{ "--length" });
}

TEST(Arguments, positionalsMayStandAnywhere)
{
  for (const Words& words : { Words{ "a", "b.vtp", "--length", "2" }, Words{ "a", "--length", "2", "b.vtp" },
                              Words{ "--length", "2", "a", "b.vtp" }, Words{ "--length", "2", "--", "a", "b.vtp" } })
  {
    Arguments arguments = parse(words);
    EXPECT_EQ(arguments.values["input"], Words{ "a" });
    EXPECT_EQ(arguments.values["result"], Words{ "b.vtp" });
    EXPECT_EQ(arguments.values["length"], Words{ "2" });
  }
  EXPECT_EQ(parse({ "--", "-odd", "b.vtp" }).values["input"], Words{ "-odd" });
}

TEST(Arguments, absentParametersHaveNoValue)
{
  const Arguments arguments = parseOptions({});
  EXPECT_EQ(arguments.values.size(), 2u);
  EXPECT_FALSE(arguments.echo);
  EXPECT_TRUE(arguments.returnParameterFile.empty());
}

TEST(Arguments, booleansInvertTheirDefault)
{
  EXPECT_EQ(valuesOf("on", { "--on" }), Words{ "true" });
  EXPECT_EQ(valuesOf("off", { "--off" }), Words{ "false" });
  EXPECT_EQ(refusalOfOptions({ "--on=false" }), "--on: value 'false' found, none expected");
}

TEST(Arguments, multipleFilesAreRepeatedOrSeparatedByCommas)
{
  const Words three{ "a.fcsv", "b.fcsv", "c.fcsv" };
  EXPECT_EQ(valuesOf("list", { "--list", "a.fcsv", "--list=b.fcsv", "--list", "c.fcsv" }), three);
  EXPECT_EQ(valuesOf("list", { "--list", "a.fcsv,b.fcsv,c.fcsv" }), three);
  EXPECT_EQ(valuesOf("list", { "--list", "\"a,1\",b" }), (Words{ "a,1", "b" }));
  EXPECT_NE(refusalOfOptions({ "--list", "a,,b" }), "accepted");
}

TEST(Arguments, anExistingFileWithACommaIsOneFile)
{
  const auto file = std::filesystem::temp_directory_path() / "arguments,test.txt";
  std::ofstream(file) << "x";
  EXPECT_EQ(valuesOf("list", { "--list", file.string() }), Words{ file.string() });
  std::filesystem::remove(file);
}

TEST(Arguments, outputsKeepCommasAndQuotesInTheirNames)
{
  const ModuleDescription description = parseModuleDescription(R"(
    <executable><title>Test</title><version>1</version>
      <parameters><label>Files</label><description>Files</description>
        <file multiple="true" fileExtensions=".inp,.k">
          <name>models</name><label>Models</label><longflag>export</longflag><description>Files</description>
          <channel>output</channel>
        </file>
      </parameters>
    </executable>)");
  const auto models = [&](const std::string& value) {
    return parseArguments(description, { "--export", value }).values["models"];
  };
  EXPECT_EQ(models("a.inp,b.k"), (Words{ "a.inp", "b.k" }));
  EXPECT_EQ(models("a.inp, b.k"), (Words{ "a.inp", "b.k" }));
  EXPECT_EQ(models("\"a,1.inp\",\"b\"\"2.k\""), (Words{ "a,1.inp", "b\"2.k" }));
  EXPECT_EQ(models("q/a\"b.inp"), Words{ "q/a\"b.inp" });
  EXPECT_EQ(models("q/a\"b.inp,c.k"), (Words{ "q/a\"b.inp", "c.k" }));
  EXPECT_EQ(models("q/g, h.k"), Words{ "q/g, h.k" });
  for (const char* value : { "a.doc,b.inp", "a.inp,,b.inp", "a.inp,", "" })
    EXPECT_THROW(models(value), UsageError) << value;
}

TEST(Arguments, pointsMayBeNegative)
{
  EXPECT_EQ(valuesOf("point", { "--point", "-1,2,.5", "--point", "0,0,-10" }), (Words{ "-1,2,.5", "0,0,-10" }));
}

TEST(Arguments, theHostsOwnFlagsAreKnown)
{
  const Arguments arguments =
    parseOptions({ "--processinformationaddress", "0x7ffe", "--returnparameterfile", "r.params", "--echo" });
  EXPECT_EQ(arguments.returnParameterFile, "r.params");
  EXPECT_TRUE(arguments.echo);
}

TEST(Arguments, refusalsSayWhatWasFoundAndExpected)
{
  EXPECT_EQ(refusalOfOptions({ "--lenght", "2" }),
            "--lenght: unknown flag found, one of those that --help lists expected; did you mean --length?");
  EXPECT_EQ(refusalOfOptions({ "--unlike-any", "2" }),
            "--unlike-any: unknown flag found, one of those that --help lists expected");
  EXPECT_EQ(refusalOfOptions({ "--length", "0.1" }), "--length: '0.1' found, a number of at least 0.5 expected");
  EXPECT_EQ(refusalOfOptions({ "--length", "2", "--length", "3" }), "--length: given twice, once expected");
  EXPECT_EQ(refusalOf({ "a", "b.vtp", "--length" }), "--length: no value found, a number of at least 0.5 expected");
  EXPECT_EQ(refusalOf({ "a", "b.vtp", "--length", "--on" }),
            "--length: no value found, a number of at least 0.5 expected");
  EXPECT_EQ(refusalOf({ "a" }), "result: argument not found, a file (.vtp, .vtu) expected");
  EXPECT_EQ(refusalOf({}), "input: argument not found, a file expected");
  EXPECT_EQ(refusalOfOptions({ "c" }), "'out.vtp': surplus argument found, 2 without a flag expected");
  EXPECT_EQ(refusalOf({ "a", "b.stl" }), "result: 'b.stl' found, a file (.vtp, .vtu) expected");
  EXPECT_EQ(refusalOfOptions({ "--extra", ".nrrd" }), "--extra: '.nrrd' found, a file (.nrrd, .nii.gz) expected");
}

TEST(Arguments, extensionsOfOutputsIgnoreCase)
{
  EXPECT_EQ(parse({ "a", "B.VTU" }).values["result"], Words{ "B.VTU" });
  EXPECT_EQ(valuesOf("extra", { "--extra", "x.nii.gz" }), Words{ "x.nii.gz" });
}

class WrongValue : public testing::TestWithParam<std::pair<const char*, const char*>>
{
};

TEST_P(WrongValue, isRefused)
{
  const auto [flag, value] = GetParam();
  EXPECT_NE(refusalOfOptions({ std::string(flag) + "=" + value }), "accepted");
}

INSTANTIATE_TEST_SUITE_P(Arguments, WrongValue,
                         testing::ValuesIn(std::vector<std::pair<const char*, const char*>>{
                           { "--length", "" },
                           { "--length", "nan" },
                           { "--length", "inf" },
                           { "--length", "-inf" },
                           { "--length", "1e999" },
                           { "--length", "1mm" },
                           { "--length", " 1" },
                           { "--length", "1 " },
                           { "--length", "1,5" },
                           { "--length", "0x10" },
                           { "--length", "one" },
                           { "--ratio", "1.01" },
                           { "--count", "1.5" },
                           { "--count", "-1" },
                           { "--count", "99999999999" },
                           { "--count", "10000001" },
                           { "--count", "" },
                           { "--power", "3" },
                           { "--power", "02" },
                           { "--act", "Succeed" },
                           { "--act", "" },
                           { "--indices", "1,2.5" },
                           { "--indices", "1,,2" },
                           { "--weights", "1,nan" },
                           { "--weights", "1," },
                           { "--point", "1,2" },
                           { "--point", "1,2,3,4" },
                           { "--point", "1,2,z" },
                           { "--point", "1 2 3" },
                           { "--folder", "" },
                           { "--list", "" },
                           { "--extra", "x.nii" },
                           { "--echo", "1" },
                           { "--returnparameterfile", "" },
                           { "-length", "1" },
                           { "--written", "1" } }));
