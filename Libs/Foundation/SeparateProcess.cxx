// SPDX-License-Identifier: Apache-2.0
#include "SeparateProcess.h"

#ifndef _WIN32

#include "Errors.h"

#include <vtkSMPTools.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <mutex>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#include <utility>
#ifdef __linux__
#include <sys/prctl.h>
#endif

namespace surgicalmesher
{
namespace
{

constexpr int kFailed = 1;

/// Limit by the clock over the limit of processor time. A working process may have to share its core; one that waits in
/// vain uses no processor time.
constexpr int kClockPerProcessorTime = 10;

bool sendAll(int descriptor, const char* bytes, std::size_t size)
{
  for (std::size_t sent = 0; sent < size;)
  {
    const ssize_t count = write(descriptor, bytes + sent, size - sent);
    if (count < 0 && errno != EINTR) return false;
    if (count > 0) sent += static_cast<std::size_t>(count);
  }
  return true;
}

bool receiveAll(int descriptor, char* bytes, std::size_t size)
{
  for (std::size_t received = 0; received < size;)
  {
    const ssize_t count = read(descriptor, bytes + received, size - received);
    if (count == 0 || (count < 0 && errno != EINTR)) return false;
    if (count > 0) received += static_cast<std::size_t>(count);
  }
  return true;
}

/// Sends the size first, so that the receiver reads the answer into its final place.
bool sendAnswer(int descriptor, const std::string& answer)
{
  const std::size_t size = answer.size();
  return sendAll(descriptor, reinterpret_cast<const char*>(&size), sizeof(size)) &&
         sendAll(descriptor, answer.data(), size);
}

std::optional<std::string> receiveAnswer(int descriptor)
{
  std::size_t size = 0;
  if (!receiveAll(descriptor, reinterpret_cast<char*>(&size), sizeof(size))) return {};
  std::string answer(size, '\0');
  if (!receiveAll(descriptor, answer.data(), size)) return {};
  return answer;
}

/// Sets the time limits of the child, and no core file, since crashes are expected.
void setLimits(int mostSeconds)
{
  const rlimit noCore{ 0, 0 };
  setrlimit(RLIMIT_CORE, &noCore);
  if (mostSeconds == 0) return;
  const rlimit seconds{ rlim_t(mostSeconds), rlim_t(mostSeconds) };
  setrlimit(RLIMIT_CPU, &seconds);
  std::signal(SIGALRM, SIG_DFL); // it may be ignored or blocked, inherited from the caller
  sigset_t alarms;
  sigemptyset(&alarms);
  sigaddset(&alarms, SIGALRM);
  sigprocmask(SIG_UNBLOCK, &alarms, nullptr);
  alarm(unsigned(mostSeconds) * kClockPerProcessorTime);
}

/// Ends without flushing buffers or destroying objects: they belong to the parent.
[[noreturn]] void runAsChild(int descriptor, const std::function<std::string()>& work)
{
  const int nowhere = open("/dev/null", O_WRONLY);
  dup2(nowhere, STDOUT_FILENO);
  dup2(nowhere, STDERR_FILENO);
  // A forked process has only the thread that forked: a loop on a thread pool would wait forever.
  vtkSMPTools::SetBackend("Sequential");
  try
  {
    const std::string answer = work();
    alarm(0); // the parent may not read the answer at once
    _exit(sendAnswer(descriptor, answer) ? 0 : kFailed);
  }
  catch (...)
  {
    _exit(kFailed);
  }
}

/// Waits for the child to end; returns its exit status, or kFailed if a signal ended it.
int endOf(pid_t child)
{
  int status = 0;
  while (waitpid(child, &status, 0) < 0)
    if (errno != EINTR) return kFailed;
  return WIFEXITED(status) ? WEXITSTATUS(status) : kFailed;
}

/// Held from the opening of a pipe to the closing of its writing end here: a process forked by another thread in
/// between would keep that end open, and the reader would not see that its own child has crashed. Never destroyed,
/// since a thread may start a process while the program ends.
std::mutex& startingMutex()
{
  static auto& mutex = *new std::mutex;
  return mutex;
}

[[noreturn]] void refuseToStart(int failure)
{
  throw EngineError("no process of its own can be started for a library (" + std::string(std::strerror(failure)) + ")");
}

} // namespace

SeparateProcess::SeparateProcess(const std::function<std::string()>& work, int mostSeconds)
{
  std::unique_lock<std::mutex> starting(startingMutex());
  int ends[2];
  if (pipe(ends) != 0) refuseToStart(errno);
  for (const int end : ends) fcntl(end, F_SETFD, FD_CLOEXEC);
#ifdef __linux__
  const pid_t parent = getpid();
#endif
  m_Child = fork();
  if (m_Child == 0)
  {
#ifdef __linux__
    prctl(PR_SET_PDEATHSIG, SIGKILL);        // a cancelled run takes its child along
    if (getppid() != parent) _exit(kFailed); // the parent ended before that
#endif
    starting.unlock(); // the work may start a process as well
    close(ends[0]);
    setLimits(mostSeconds);
    runAsChild(ends[1], work);
  }
  const int failure = errno;
  close(ends[1]);
  starting.unlock();
  m_Answers = ends[0];
  if (m_Child >= 0) return;
  close(m_Answers);
  refuseToStart(failure);
}

SeparateProcess::~SeparateProcess()
{
  if (m_Answers >= 0) close(m_Answers);
  if (m_Child < 0) return;
  kill(m_Child, SIGKILL);
  endOf(m_Child);
}

std::optional<std::string> SeparateProcess::answer()
{
  if (m_Child < 0) return {};
  std::optional<std::string> answer = receiveAnswer(m_Answers);
  close(std::exchange(m_Answers, -1));
  if (endOf(std::exchange(m_Child, -1)) != 0) return {};
  return answer;
}

} // namespace surgicalmesher

#else

namespace surgicalmesher
{

SeparateProcess::SeparateProcess(const std::function<std::string()>& work, int) : m_Work(work) {}

SeparateProcess::~SeparateProcess() = default;

std::optional<std::string> SeparateProcess::answer()
{
  try
  {
    return m_Work();
  }
  catch (...)
  {
    return {};
  }
}

} // namespace surgicalmesher

#endif
