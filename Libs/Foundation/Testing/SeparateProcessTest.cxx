// SPDX-License-Identifier: Apache-2.0
#include "SeparateProcess.h"

#include <gtest/gtest.h>

#include <cstdlib>

namespace surgicalmesher
{
namespace
{

TEST(SeparateProcess, AnswersOrTellsThatThereIsNoAnswer)
{
  const std::string large(1 << 20, 'x'); // more than a pipe holds
  EXPECT_EQ(runInSeparateProcess([&] { return large; }), large);
  EXPECT_EQ(runInSeparateProcess([] { return std::string(); }), "") << "an answer as well";
  EXPECT_EQ(runInSeparateProcess([]() -> std::string { throw 2; }), std::nullopt);
#ifndef _WIN32
  EXPECT_EQ(runInSeparateProcess([]() -> std::string { std::abort(); }), std::nullopt);
  const auto endless = []() -> std::string
  {
    for (volatile unsigned n = 0;; n = n + 1)
    {
    }
  };
  EXPECT_EQ(runInSeparateProcess(endless, 1), std::nullopt);
  EXPECT_EQ(runInSeparateProcess([&] { return large; }, 1), large);
  EXPECT_EQ(runInSeparateProcess([]() -> std::string { std::_Exit(0); }).value_or(""), "") << "left without an answer";
#endif
}

} // namespace
} // namespace surgicalmesher
