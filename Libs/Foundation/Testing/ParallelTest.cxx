// SPDX-License-Identifier: Apache-2.0
#include "Parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>

namespace surgicalmesher
{
namespace
{

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
