// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Another program run to its end. POSIX only.

#include <functional>
#include <string>
#include <vector>

namespace surgicalmesher
{

/// This process was told to end (interrupt, hang-up, termination) while a child ran, which has ended since.
struct Interrupted
{
  int signal;
};

struct ChildOutcome
{
  int status = 0;     ///< exit status; 128 + n for an end by signal n
  std::string errors; ///< what came on stderr
};

/// Runs `program` with `arguments`, nothing on stdin, and hands each line of its stdout to `eachLine`. Signals that
/// would end this process are passed on to the child, and thrown as Interrupted when it has ended; a child whose parent
/// is killed is told to end, too (on Linux). Throws EngineError if the program can't be started.
ChildOutcome runChild(const std::string& program, const std::vector<std::string>& arguments,
                      const std::function<void(const std::string&)>& eachLine);

} // namespace surgicalmesher
