// SPDX-License-Identifier: Apache-2.0
#pragma once
/// An executable as a host sees it: exit status, streams and files. POSIX only.

#include "../../Libs/TissueMap/Testing/TestFiles.h"

#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

namespace surgicalmesher::test
{

struct Outcome
{
  int status = -1; ///< of the shell: 128 + n for an end by signal n
  std::string out;
  std::string err;
};

/// A folder and the runs of one executable in it. Arguments are as in a shell; file names are relative to the folder.
class ExecutableTest : public testing::Test
{
protected:
  explicit ExecutableTest(std::string executable) : m_Executable(std::move(executable)) {}

  Outcome run(const std::string& arguments) const { return shell("exec " + commandOf(arguments)); }

  void expectDone(const std::string& arguments) const
  {
    const Outcome result = run(arguments);
    EXPECT_EQ(result.status, 0) << arguments << "\n" << result.err;
    EXPECT_EQ(result.err, "");
  }

  /// Expects that the run ends with this status and with one line on stderr that contains `expected`, and that no file
  /// is added or removed.
  void expectRefused(const std::string& arguments, int status, const std::string& expected) const
  {
    const std::vector<std::string> before = folder.files();
    expectFailure(run(arguments), status, expected, arguments);
    EXPECT_EQ(folder.files(), before) << arguments;
  }

  /// Expects that no output remains when a file cannot grow to its full size: the system limits all files to 4 kB.
  void expectSaysThatAFileCanNotGrow(const std::string& arguments) const
  {
    const std::vector<std::string> before = folder.files();
    const Outcome result = shell("trap '' XFSZ; ulimit -f 8; exec " + commandOf(arguments));
    expectFailure(result, 1, "written", arguments);
    EXPECT_EQ(folder.files(), before) << arguments;
  }

  /// The same on a full disk of 32 kB, mounted on the subfolder `disk`, to which `arguments` must write the outputs.
  /// Skips the test where users may not mount file systems.
  void expectSaysThatTheDiskIsFull(const std::string& arguments) const
  {
    std::filesystem::create_directory(folder.file("disk"));
    const Outcome result = shell("unshare -rm true || exit 99; exec unshare -rm sh -c 'mount -t tmpfs -o size=32k none "
                                 "disk || exit 99; \"$0\" \"$@\"; "
                                 "status=$?; ls -A disk >&2; exit $status' " +
                                 commandOf(arguments));
    if (result.status > 3) GTEST_SKIP() << "no small file system can be mounted here: " << result.err;
    expectFailure(result, 1, "disk/", arguments);
  }

  /// Expects that a run that is killed as soon as its progress reports `stage` leaves no output: nothing at all after
  /// SIGTERM, and after SIGKILL only temporary files, which the next run removes.
  void expectLeavesNothingWhenKilled(const std::string& arguments, const std::string& stage) const
  {
    const std::vector<std::string> before = folder.files();
    EXPECT_EQ(killedAt(stage, "TERM", arguments), 128 + 15) << arguments;
    EXPECT_EQ(folder.files(), before) << arguments;

    EXPECT_EQ(killedAt(stage, "KILL", arguments), 128 + 9) << arguments;
    std::vector<std::string> more;
    const std::vector<std::string> after = folder.files();
    std::set_difference(after.begin(), after.end(), before.begin(), before.end(), std::back_inserter(more));
    EXPECT_FALSE(more.empty());
    for (const std::string& name : more) EXPECT_NE(name.find(".partial"), std::string::npos) << name;

    EXPECT_EQ(killedAt(stage, "TERM", arguments), 128 + 15) << arguments;
    EXPECT_EQ(folder.files(), before) << arguments;
  }

  TemporaryFolder folder;

private:
  std::string commandOf(const std::string& arguments) const { return "'" + m_Executable + "' " + arguments; }

  Outcome shell(const std::string& script) const
  {
    const TemporaryFolder streams;
    const std::string command = "cd '" + folder.file("") + "' && { " + script + "; } >'" + streams.file("out") +
                                "' 2>'" + streams.file("err") + "'";
    const int status = std::system(command.c_str());
    return { WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), readBytes(streams.file("out")),
             readBytes(streams.file("err")) };
  }

  int killedAt(const std::string& stage, const std::string& signal, const std::string& arguments) const
  {
    const TemporaryFolder streams;
    const std::string out = "'" + streams.file("out") + "'";
    const Outcome result = shell(commandOf(arguments) + " >" + out + " & id=$!; while kill -0 $id && ! grep -q '" +
                                 stage + "' " + out + "; do sleep 0.02; done; kill -" + signal + " $id; wait $id");
    return result.status;
  }

  static void expectFailure(const Outcome& result, int status, const std::string& expected,
                            const std::string& arguments)
  {
    EXPECT_EQ(result.status, status) << arguments << "\n" << result.err;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << arguments << "\n" << result.err;
    EXPECT_NE(result.err.find(expected), std::string::npos) << arguments << "\n" << result.err;
  }

  std::string m_Executable;
};

} // namespace surgicalmesher::test
