// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Runs another program to its end. POSIX only.

#include <functional>
#include <string>
#include <vector>

namespace surgicalmesher
{

/// Thrown when this process was told to end (interrupt, hang-up, termination, closed pipe) while a child ran; the child
/// has ended.
struct Interrupted
{
  int signal;
};

struct ChildOutcome
{
  int status = 0;     ///< exit status; 128 + n if signal n ended the child
  std::string errors; ///< output on stderr
};

/// Runs `program` with `arguments` and empty stdin, and passes each line of its stdout to `eachLine`. Signals that
/// would end this process are forwarded to the child; Interrupted is thrown when the child has ended. If this process
/// is killed, the child is told to end (Linux only). Throws EngineError if the program cannot be started, and if its
/// status cannot be told.
ChildOutcome runChild(const std::string& program, const std::vector<std::string>& arguments,
                      const std::function<void(const std::string&)>& eachLine);

} // namespace surgicalmesher
