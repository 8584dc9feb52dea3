// SPDX-License-Identifier: Apache-2.0
#include "SeparateProcess.h"

#ifndef _WIN32

#include <cerrno>
#include <csignal>
#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#ifdef __linux__
#include <sys/prctl.h>
#endif

namespace surgicalmesher
{
namespace
{

constexpr int kFailed = 1;

bool sendAll(int descriptor, const std::string& bytes)
{
  for (std::size_t sent = 0; sent < bytes.size();)
  {
    const ssize_t count = write(descriptor, bytes.data() + sent, bytes.size() - sent);
    if (count < 0 && errno != EINTR) return false;
    if (count > 0) sent += static_cast<std::size_t>(count);
  }
  return true;
}

std::string receiveAll(int descriptor)
{
  std::string bytes;
  std::string buffer(1 << 16, '\0');
  for (;;)
  {
    const ssize_t count = read(descriptor, buffer.data(), buffer.size());
    if (count == 0 || (count < 0 && errno != EINTR)) return bytes;
    if (count > 0) bytes.append(buffer, 0, static_cast<std::size_t>(count));
  }
}

/// A crash here is foreseen, and leaves no core file.
void setLimits(int mostSeconds)
{
  const rlimit noCore{ 0, 0 };
  setrlimit(RLIMIT_CORE, &noCore);
  if (mostSeconds == 0) return;
  const rlimit seconds{ rlim_t(mostSeconds), rlim_t(mostSeconds) };
  setrlimit(RLIMIT_CPU, &seconds);
}

/// Ends without flushing or destroying anything: all of that is the parent's.
[[noreturn]] void runAsChild(int descriptor, const std::function<std::string()>& work)
{
  const int nowhere = open("/dev/null", O_WRONLY);
  dup2(nowhere, STDOUT_FILENO);
  dup2(nowhere, STDERR_FILENO);
  try
  {
    _exit(sendAll(descriptor, work()) ? 0 : kFailed);
  }
  catch (...)
  {
    _exit(kFailed);
  }
}

} // namespace

std::optional<std::string> runInSeparateProcess(const std::function<std::string()>& work, int mostSeconds)
{
  int ends[2];
  if (pipe(ends) != 0) return {};
  const pid_t child = fork();
  if (child == 0)
  {
#ifdef __linux__
    prctl(PR_SET_PDEATHSIG, SIGKILL); // a cancelled run takes its child along
#endif
    close(ends[0]);
    setLimits(mostSeconds);
    runAsChild(ends[1], work);
  }
  close(ends[1]);
  const std::string bytes = child > 0 ? receiveAll(ends[0]) : std::string();
  close(ends[0]);
  int status = kFailed;
  while (child > 0 && waitpid(child, &status, 0) < 0 && errno == EINTR)
  {
  }
  if (child < 0 || !WIFEXITED(status) || WEXITSTATUS(status) != 0) return {};
  return bytes;
}

} // namespace surgicalmesher

#else

namespace surgicalmesher
{

std::optional<std::string> runInSeparateProcess(const std::function<std::string()>& work, int)
{
  try
  {
    return work();
  }
  catch (...)
  {
    return {};
  }
}

} // namespace surgicalmesher

#endif
