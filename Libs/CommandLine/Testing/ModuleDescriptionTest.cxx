// SPDX-License-Identifier: Apache-2.0
// Descriptions that are read, and those that are refused as a fault of the program.
#include "ModuleDescription.h"
#include "CommandLineTestModuleXML.h"

#include <gtest/gtest.h>

#include <stdexcept>

using namespace surgicalmesher;

namespace
{

std::string executableWith(const std::string& parameters)
{
  return "<?xml version=\"1.0\"?><executable><title>T</title><version>1</version><parameters><label>L</label>" +
         std::string("<description>D</description>") + parameters + "</parameters></executable>";
}

std::string parameter(const std::string& type, const std::string& rest)
{
  return "<" + type + "><label>L</label><description>D</description>" + rest + "</" + type + ">";
}

} // namespace

TEST(ModuleDescription, isReadWhole)
{
  const ModuleDescription description = parseModuleDescription(moduleXML);
  EXPECT_EQ(description.title, "Command Line Test Module");
  EXPECT_EQ(description.version, "1.2.3");
  EXPECT_EQ(description.license, "None & all");
  ASSERT_EQ(description.groups.size(), 2u);
  EXPECT_FALSE(description.groups[0].advanced);
  EXPECT_TRUE(description.groups[1].advanced);
  ASSERT_EQ(description.positionals().size(), 2u);
  EXPECT_EQ(description.positionals()[1]->name, "result");
  EXPECT_EQ(description.positionals()[1]->extensions, (std::vector<std::string>{ ".vtp", ".vtu" }));
  const Parameter* count = description.find("count");
  ASSERT_NE(count, nullptr);
  EXPECT_EQ(count->spelling(), "--count");
  EXPECT_EQ(count->flag, "c");
  EXPECT_EQ(count->minimum, 0);
  EXPECT_EQ(count->maximum, 1e7);
  EXPECT_TRUE(description.find("written")->isReturnValue());
  EXPECT_EQ(description.find("nothing"), nullptr);
}

TEST(ModuleDescription, helpListsEveryParameterWithDefaultAndRange)
{
  const ModuleDescription description = parseModuleDescription(moduleXML);
  const std::string help = helpText(description, "Test");
  for (const Parameter* parameter : description.parameters())
  {
    EXPECT_NE(help.find(parameter->spelling()), std::string::npos) << parameter->name;
  }
  EXPECT_NE(help.find("[a number of at least 0.5; default 1.5]"), std::string::npos);
  EXPECT_NE(help.find("Usage: Test [options] input result"), std::string::npos);
}

TEST(ModuleDescription, faultsAreFaultsOfTheProgram)
{
  const std::vector<std::string> faulty{
    "",
    "<executable>",
    "<other><title>T</title><version>1</version></other>",
    executableWith(parameter("integre", "<name>a</name><longflag>a</longflag><default>1</default>")),
    executableWith(parameter("integer", "<name>a</name><longflag>a</longflag>")),
    executableWith(parameter("integer", "<name>a</name><default>1</default>")),
    executableWith(parameter("integer", "<longflag>a</longflag><default>1</default>")),
    executableWith(parameter("integer", "<name>a</name><longflag>a</longflag><default>1.5</default>")),
    executableWith(parameter(
      "integer",
      "<name>a</name><longflag>a</longflag><default>1</default><constraints><minimum>2</minimum></constraints>")),
    executableWith(parameter(
      "integer",
      "<name>a</name><longflag>a</longflag><default>1</default><constraints><minimum>x</minimum></constraints>")),
    executableWith(parameter("string-enumeration", "<name>a</name><longflag>a</longflag><default>b</default>")),
    executableWith(parameter("boolean", "<name>a</name><longflag>a</longflag><default>yes</default>")),
    executableWith(parameter("file", "<name>a</name><index>1</index>")),
    executableWith("<file><name>a</name><label>L</label><longflag>a</longflag></file>"),
    executableWith(parameter("string", "<name>a</name><longflag>a</longflag>") +
                   parameter("string", "<name>a</name><longflag>b</longflag>")),
    executableWith(parameter("string", "<name>a</name><longflag>a</longflag>") +
                   parameter("string", "<name>b</name><longflag>a</longflag>"))
  };
  EXPECT_NO_THROW(parseModuleDescription(
    executableWith(parameter("integer", "<name>a</name><longflag>a</longflag><default>1</default>"))));
  for (const std::string& xml : faulty) EXPECT_THROW(parseModuleDescription(xml), std::logic_error) << xml;
}
