// SPDX-License-Identifier: Apache-2.0
#pragma once
/// For code that ends the process when it fails, or never ends: failed assertions, exit() and crashes then end another
/// one.

#include <functional>
#include <optional>
#include <string>

namespace surgicalmesher
{

/// Work in a process of its own, which sees this one's memory as it is when that begins; what it changes there, and
/// what it prints, is lost. VTK's loops run on one thread in it. On Linux it ends with the thread that begins it.
/// Where processes can't be forked (Windows), answer() runs the work in this one, unprotected: what it refers to must
/// live until then.
class SeparateProcess
{
public:
  /// Begins. Work that takes more than `mostSeconds` of processor time, or ten times as long by the clock, is ended (0:
  /// no limit). Throws EngineError if the system has no process or pipe left.
  explicit SeparateProcess(const std::function<std::string()>& work, int mostSeconds = 0);
  /// Ends the process, if nobody has waited for its answer.
  ~SeparateProcess();
  SeparateProcess(const SeparateProcess&) = delete;
  SeparateProcess& operator=(const SeparateProcess&) = delete;

  /// Waits for what `work` returns; nothing if the process did not come to that: it crashed, aborted, exited, took too
  /// long, or `work` threw. To be asked once.
  std::optional<std::string> answer();

private:
#ifdef _WIN32
  std::function<std::string()> m_Work;
#else
  int m_Child = -1;   ///< -1: there is none, or none any more
  int m_Answers = -1; ///< the end of a pipe to read from
#endif
};

inline std::optional<std::string> runInSeparateProcess(const std::function<std::string()>& work, int mostSeconds = 0)
{
  return SeparateProcess(work, mostSeconds).answer();
}

} // namespace surgicalmesher
