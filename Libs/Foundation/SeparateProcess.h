// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Isolation of code that may crash, call exit(), fail an assertion or never return: it runs in a process of its own.

#include <functional>
#include <optional>
#include <string>

namespace surgicalmesher
{

/// Work in a forked process. The child process sees the memory of this process as it is at the fork; its changes to
/// that memory, and what it prints, are lost. VTK's loops run on one thread in it. On Linux the child ends with the
/// thread that started it. Where processes cannot be forked (Windows), answer() runs the work in this process,
/// unprotected: all that the work refers to must live until then.
class SeparateProcess
{
public:
  /// Starts the work. It is killed after `mostSeconds` of processor time, or ten times as long by the clock (0: no
  /// limit). Throws EngineError if the system has no process or pipe left.
  explicit SeparateProcess(const std::function<std::string()>& work, int mostSeconds = 0);
  /// Kills the child process if answer() has not been called.
  ~SeparateProcess();
  SeparateProcess(const SeparateProcess&) = delete;
  SeparateProcess& operator=(const SeparateProcess&) = delete;

  /// Waits for the return value of `work`. Empty if the work did not return: the child crashed, aborted, exited or
  /// exceeded its time, or `work` threw. To be called once.
  std::optional<std::string> answer();

private:
#ifdef _WIN32
  std::function<std::string()> m_Work;
#else
  int m_Child = -1;   ///< process id; -1: none, or already ended
  int m_Answers = -1; ///< read end of the pipe; -1: closed
#endif
};

inline std::optional<std::string> runInSeparateProcess(const std::function<std::string()>& work, int mostSeconds = 0)
{
  return SeparateProcess(work, mostSeconds).answer();
}

} // namespace surgicalmesher
