// SPDX-License-Identifier: Apache-2.0
// What becomes known of a program that has run.
#include "ChildProcess.h"
#include "Errors.h"

#include <gtest/gtest.h>

#include <csignal>

using namespace surgicalmesher;

namespace
{

using Lines = std::vector<std::string>;

ChildOutcome runShell(const std::string& script, Lines& lines)
{
  return runChild("/bin/sh", { "-c", script }, [&](const std::string& line) { lines.push_back(line); });
}

} // namespace

TEST(ChildProcess, tellsStatusLinesAndErrors)
{
  Lines lines;
  const ChildOutcome outcome = runShell("echo a; echo e >&2; printf 'b\\nc'; exit 3", lines);
  EXPECT_EQ(outcome.status, 3);
  EXPECT_EQ(outcome.errors, "e\n");
  EXPECT_EQ(lines, (Lines{ "a", "b", "c" })) << "the last line, too, although it has no end";
  EXPECT_EQ(runShell("kill -KILL $$", lines).status, 128 + SIGKILL);
}

TEST(ChildProcess, aStatusThatIsLostIsNoSuccess)
{
  const auto before = std::signal(SIGCHLD, SIG_IGN); // the system drops it
  Lines lines;
  EXPECT_THROW(runShell("exit 1", lines), EngineError);
  std::signal(SIGCHLD, before);
}

TEST(ChildProcess, aLineThatCanNotBeHandledEndsTheChild)
{
  const auto refuse = [](const std::string&) { throw InputError("no"); };
  EXPECT_THROW(runChild("/bin/sh", { "-c", "echo a; exec sleep 3600" }, refuse), InputError);
}

TEST(ChildProcess, aClosedPipeEndsBoth)
{
  const auto end = [](const std::string&) { std::raise(SIGPIPE); };
  try
  {
    runChild("/bin/sh", { "-c", "echo a; exec sleep 3600" }, end);
    FAIL();
  }
  catch (const Interrupted& interrupted)
  {
    EXPECT_EQ(interrupted.signal, SIGPIPE);
  }
}
