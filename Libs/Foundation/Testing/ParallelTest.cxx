// SPDX-License-Identifier: Apache-2.0
#include "Parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <vector>

namespace surgicalmesher
{
namespace
{

TEST(ParallelLoops, CallForEveryNumberOnceInsideAnotherToo)
{
  for (const std::size_t count : { 0, 1, 2, 1000 })
  {
    std::vector<std::atomic<int>> calls(count);
    parallelFor(count, [&](std::size_t i) { ++calls[i]; });
    parallelForEach(count, [&](std::size_t i) { ++calls[i]; });
    parallelForIfIdle(count, [&](std::size_t i) { ++calls[i]; });
    parallelForEach(3, [&](std::size_t) { parallelForIfIdle(count, [&](std::size_t i) { ++calls[i]; }); });
    for (const std::atomic<int>& times : calls) EXPECT_EQ(times, 6);
  }
}

TEST(RunInParallel, RunsAllAndThrowsWhatTheFirstThatFailsHasThrown)
{
  std::atomic<int> ended{ 0 };
  const auto succeed = [&] { ++ended; };
  const auto fail = [&](const char* what)
  {
    ++ended;
    throw std::runtime_error(what);
  };
  runInParallel({ succeed, succeed });
  EXPECT_EQ(ended, 2);
  try
  {
    runInParallel({ succeed, [&] { fail("first"); }, [&] { fail("second"); }, succeed });
    FAIL();
  }
  catch (const std::runtime_error& error)
  {
    EXPECT_STREQ(error.what(), "first");
  }
  EXPECT_EQ(ended, 6);
}

} // namespace
} // namespace surgicalmesher
