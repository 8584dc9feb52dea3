// SPDX-License-Identifier: Apache-2.0
#include "ShellChoices.h"
#include "Errors.h"

#include <gtest/gtest.h>

using namespace surgicalmesher;

namespace
{

TissueTable names()
{
  TissueTable table;
  table[1].name = "brain";
  table[2].name = "dura: outer, inner";
  table[2].isShell = true;
  table[3].name = "skull";
  table[4].name = "absent";
  table[4].isShell = true;
  return table;
}

std::vector<ShellChoice> choose(const std::vector<std::string>& texts)
{
  return shellChoices(texts, names(), { 1, 2, 3 }, 0.5);
}

TEST(ShellChoices, TakesLabelsNamesAndNeighbours)
{
  const std::vector<ShellChoice> choices = choose({ "1", "skull:outside", "brain:3", "3:0" });
  ASSERT_EQ(choices.size(), 4u);
  const std::pair<int, int> expected[] = { { 1, -1 }, { 3, 0 }, { 1, 3 }, { 3, 0 } };
  for (std::size_t i = 0; i < choices.size(); ++i)
  {
    EXPECT_EQ(choices[i].label, expected[i].first) << i;
    EXPECT_EQ(choices[i].neighbour, expected[i].second) << i;
    EXPECT_EQ(choices[i].thickness, 0.5) << i;
  }
}

TEST(ShellChoices, TakesSeveralInOneText)
{
  const std::vector<ShellChoice> choices = choose({ "brain,3:outside" });
  ASSERT_EQ(choices.size(), 2u);
  EXPECT_EQ(choices[0].label, 1);
  EXPECT_EQ(choices[1].label, 3);
}

TEST(ShellChoices, TakesNamesWithColonsAndCommas)
{
  const std::vector<ShellChoice> choices = choose({ "dura: outer, inner", "dura: outer, inner:brain" });
  ASSERT_EQ(choices.size(), 2u);
  EXPECT_EQ(choices[0].label, 2);
  EXPECT_EQ(choices[0].neighbour, -1);
  EXPECT_EQ(choices[1].label, 2);
  EXPECT_EQ(choices[1].neighbour, 1);
}

TEST(ShellChoices, WithoutTextTakesTheTissuesThatAreShells)
{
  const std::vector<ShellChoice> choices = choose({});
  ASSERT_EQ(choices.size(), 1u); // not the one that isn't present
  EXPECT_EQ(choices[0].label, 2);
}

TEST(ShellChoices, RefusesWhatIsNoTissue)
{
  for (const char* text : { "falx", "absent", "4", "brain:falx", "outside", "brain,falx", "" })
    EXPECT_THROW(choose({ text }), UsageError) << text;
}

} // namespace
