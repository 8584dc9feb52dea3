// SPDX-License-Identifier: Apache-2.0
#include "SetNames.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <random>

namespace surgicalmesher
{
namespace
{

bool obeysGrammar(const std::string& name)
{
  const auto isLetter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  const auto isAllowed = [&](char c) { return isLetter(c) || (c >= '0' && c <= '9') || c == '_'; };
  return !name.empty() && name.size() <= kLongestName && isLetter(name.front()) && name.back() != '_' &&
         std::all_of(name.begin(), name.end(), isAllowed) && name.find("__") == name.npos;
}

std::string upperCase(std::string text)
{
  for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return text;
}

TEST(SetNames, KeepsWhatIsValid)
{
  for (const char* name : { "a", "Brain", "gray_matter_2", "x1" }) EXPECT_EQ(validName(name), name);
}

TEST(SetNames, MapsWhatIsNot)
{
  EXPECT_EQ(validName("Gray matter, left"), "Gray_matter_left");
  EXPECT_EQ(validName("Gyrus pr\xc3\xa9"
                      "central \xc3\xa0 droite"),
            "Gyrus_precentral_a_droite");
  EXPECT_EQ(validName("\xc5\x81\xc3\xb3\xc5\xbc"), "Loz");
  EXPECT_EQ(validName("pr\xe9"
                      "central"),
            "precentral")
    << "Latin-1";
  EXPECT_EQ(validName("\"dura\" 'mater'"), "dura_mater");
  EXPECT_EQ(validName("3rd ventricle"), "n3rd_ventricle");
  EXPECT_EQ(validName("__init__"), "init");
  EXPECT_EQ(validName("\xe8\x84\xb3"), "");
  EXPECT_EQ(validName(""), "");
}

TEST(SetNames, LongNamesKeepHeadAndTail)
{
  const std::string left = validName(std::string(200, 'x') + " left"),
                    right = validName(std::string(200, 'x') + " right");
  EXPECT_EQ(left.size(), kLongestName);
  EXPECT_EQ(left.substr(left.size() - 5), "_left");
  EXPECT_EQ(right.substr(right.size() - 6), "_right");
}

TEST(SetNames, TellsNamesApartInUpperCaseToo)
{
  SetNames names;
  EXPECT_EQ(names.unique("Brain"), "Brain");
  EXPECT_EQ(names.unique("brain"), "brain_2");
  EXPECT_EQ(names.unique("BRAIN 2"), "BRAIN_2_2");
  EXPECT_EQ(names.unique("\xe8\x84\xb3", "tissue_7"), "tissue_7");
}

TEST(SetNames, AnyBytesGiveDistinctNamesOfTheGrammar)
{
  std::mt19937 random(1);
  SetNames names;
  std::set<std::string> seen;
  for (int i = 0; i < 2000; ++i)
  {
    std::string text(random() % 4 == 0 ? 200 : random() % 4, ' ');
    for (char& c : text) c = static_cast<char>(random() % 3 == 0 ? random() % 256 : "aA_"[random() % 3]);
    const std::string name = names.unique(text);
    EXPECT_TRUE(obeysGrammar(name)) << name;
    EXPECT_TRUE(seen.insert(upperCase(name)).second) << name;
    EXPECT_EQ(validName(name), name);
  }
}

TEST(SetNames, TextBecomesUtf8)
{
  EXPECT_EQ(validUtf8("pr\xc3\xa9 \xe8\x84\xb3 \xf0\x9f\xa7\xa0"), "pr\xc3\xa9 \xe8\x84\xb3 \xf0\x9f\xa7\xa0");
  EXPECT_EQ(validUtf8("pr\xe9"), "pr\xc3\xa9");
  EXPECT_EQ(validUtf8("cut \xe8\x84"), "cut \xc3\xa8\xc2\x84");
}

} // namespace
} // namespace surgicalmesher
