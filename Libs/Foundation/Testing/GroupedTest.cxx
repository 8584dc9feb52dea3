// SPDX-License-Identifier: Apache-2.0
#include "Grouped.h"

#include <gtest/gtest.h>

#include <algorithm>
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

TEST(Grouped, IsTheSameOnSeveralThreads)
{
  for (const std::size_t count : { 0, 1, 3, 1000 })
  {
    std::mt19937 random(2);
    std::vector<std::size_t> group(count);
    for (std::size_t& of : group) of = random() % 7;
    const auto forEachOf = [&](std::size_t first, std::size_t last, auto&& visit)
    {
      for (std::size_t i = first; i < last; ++i)
        for (int n = 0; n < 3; ++n) visit((group[i] + n) % 9, std::pair(i, n));
    };
    const Grouped<std::pair<std::size_t, int>> alone(9, [&](auto&& visit) { forEachOf(0, count, visit); });
    const Grouped<std::pair<std::size_t, int>> together(9, count, forEachOf);
    ASSERT_EQ(together.groups(), 9u);
    for (std::size_t of = 0; of < 9; ++of)
      EXPECT_TRUE(std::equal(together.begin(of), together.end(of), alone.begin(of), alone.end(of)))
        << count << ", " << of;
  }
}

TEST(Grouped, MayBeEmpty)
{
  EXPECT_EQ(Grouped<int>().groups(), 0u);
  const Grouped<int> none(3, [](auto&&) {});
  EXPECT_EQ(none.size(0) + none.size(1) + none.size(2), 0u);
}
