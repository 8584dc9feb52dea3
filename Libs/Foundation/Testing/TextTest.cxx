// SPDX-License-Identifier: Apache-2.0
#include "Text.h"

#include <gtest/gtest.h>

namespace surgicalmesher::text
{
namespace
{

using Parts = std::vector<std::string>;

TEST(Text, NumbersAreWholeAndFinite)
{
  double value = 0;
  for (const char* good : { "-2.5", "1e-3", "+4", ".5" }) EXPECT_TRUE(parseNumber(good, value)) << good;
  EXPECT_EQ(value, 0.5);
  for (const char* bad : { "", " 1", "1 ", "1,5", "nan", "inf", "1e999", "0x10", "1.5mm" })
    EXPECT_FALSE(parseNumber(bad, value)) << bad;
}

TEST(Text, IntegersMayBeWrittenAsTablesDo)
{
  long value = 0;
  for (const char* good : { "3", "3.0", "3e0", "+3" })
  {
    EXPECT_TRUE(parseInteger(good, 0, 3, value)) << good;
    EXPECT_EQ(value, 3) << good;
  }
  for (const char* bad : { "", "3.5", "4", "-1", "99999999999999999999", "three" })
    EXPECT_FALSE(parseInteger(bad, 0, 3, value)) << bad;
}

TEST(Text, FieldsAreTrimmedAndMayBeQuoted)
{
  EXPECT_EQ(splitFields(" a ,\"b, c\",,\"say \"\"no\"\"\""), (Parts{ "a", "b, c", "", "say \"no\"" }));
  EXPECT_EQ(splitWords("  a \"b c\"  d "), (Parts{ "a", "b c", "d" }));
  EXPECT_EQ(split("", ','), Parts());
  EXPECT_EQ(split("a,,b", ','), (Parts{ "a", "", "b" }));
  EXPECT_EQ(joined(split("a,,b", ','), ","), "a,,b");
}

TEST(Text, NamesOfFilesAndTissues)
{
  EXPECT_EQ(extensionOf("Head.Scan/Map.NII.GZ"), ".gz");
  EXPECT_EQ(extensionOf("Head.Scan/map"), "");
  EXPECT_EQ(legible("a\tb\x01\xff"), "a b ?");
  EXPECT_EQ(oneLine(" a\n\tb "), "a b");
  EXPECT_EQ(rounded(1234.5678), "1.23e+03");
  EXPECT_EQ(rounded(1234.5678, 6), "1234.57");
}

} // namespace
} // namespace surgicalmesher::text
