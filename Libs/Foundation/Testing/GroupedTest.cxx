// SPDX-License-Identifier: Apache-2.0
#include "Grouped.h"

#include <gtest/gtest.h>

#include <random>
#include <utility>

using namespace surgicalmesher;

TEST(Grouped, KeepsTheOrderOfEachGroup)
{
  std::mt19937 random(1);
  std::vector<std::pair<std::size_t, int>> given;
  for (int value = 0; value < 1000; ++value) given.emplace_back(random() % 7 + random() % 2 * 5, value);
  const Grouped<int> grouped(13,
                             [&](auto&& visit)
                             {
                               for (const auto& [group, value] : given) visit(group, value);
                             });
  ASSERT_EQ(grouped.groups(), 13u);
  std::size_t all = 0;
  for (std::size_t group = 0; group < grouped.groups(); ++group)
  {
    std::vector<int> expected;
    for (const auto& [of, value] : given)
      if (of == group) expected.push_back(value);
    EXPECT_EQ(std::vector<int>(grouped.begin(group), grouped.end(group)), expected) << group;
    EXPECT_EQ(grouped.size(group), expected.size());
    all += expected.size();
  }
  EXPECT_EQ(all, given.size());
}

TEST(Grouped, MayBeEmpty)
{
  EXPECT_EQ(Grouped<int>().groups(), 0u);
  const Grouped<int> none(3, [](auto&&) {});
  EXPECT_EQ(none.size(0) + none.size(1) + none.size(2), 0u);
}
