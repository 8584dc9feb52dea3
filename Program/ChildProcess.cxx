// SPDX-License-Identifier: Apache-2.0
#include "ChildProcess.h"

#include "Errors.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>
#ifdef __linux__
#include <sys/prctl.h>
#endif

#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstring>

namespace surgicalmesher
{

namespace
{

constexpr std::array<int, 5> signals{ SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGPIPE };
std::atomic<pid_t> runningChild{ 0 };
std::atomic<int> caughtSignal{ 0 };

extern "C" void passOn(int signal)
{
  caughtSignal = signal;
  if (const pid_t child = runningChild; child > 0) kill(child, signal);
}

/// Forwards signals to the child during its lifetime. Signals that this process was started to ignore stay ignored.
class PassedOnSignals
{
public:
  PassedOnSignals()
  {
    caughtSignal = 0;
    for (std::size_t i = 0; i < signals.size(); ++i)
    {
      sigaction(signals[i], nullptr, &m_Before[i]);
      if (m_Before[i].sa_handler == SIG_IGN) continue;
      struct sigaction action = {};
      action.sa_handler = passOn;
      sigemptyset(&action.sa_mask);
      sigaction(signals[i], &action, nullptr);
    }
  }
  ~PassedOnSignals()
  {
    runningChild = 0;
    for (std::size_t i = 0; i < signals.size(); ++i) sigaction(signals[i], &m_Before[i], nullptr);
  }
  PassedOnSignals(const PassedOnSignals&) = delete;
  PassedOnSignals& operator=(const PassedOnSignals&) = delete;

private:
  std::array<struct sigaction, signals.size()> m_Before = {};
};

/// Blocks signals during its lifetime: a forked process inherits the handlers of this one, which would swallow signals
/// there.
class HeldSignals
{
public:
  HeldSignals()
  {
    sigset_t held;
    sigemptyset(&held);
    for (const int signal : signals) sigaddset(&held, signal);
    pthread_sigmask(SIG_BLOCK, &held, &m_Before);
  }
  ~HeldSignals() { pthread_sigmask(SIG_SETMASK, &m_Before, nullptr); }
  HeldSignals(const HeldSignals&) = delete;
  HeldSignals& operator=(const HeldSignals&) = delete;
  /// In the forked process: restores default handling, so that pending and later signals end it.
  void letGo() const
  {
    for (const int signal : signals)
    {
      struct sigaction action = {};
      sigaction(signal, nullptr, &action);
      if (action.sa_handler == passOn) std::signal(signal, SIG_DFL);
    }
    pthread_sigmask(SIG_SETMASK, &m_Before, nullptr);
  }

private:
  sigset_t m_Before;
};

class Pipe
{
public:
  Pipe()
  {
    if (pipe(m_Ends) != 0) throw EngineError("no pipe to a program can be opened");
    for (const int end : m_Ends) fcntl(end, F_SETFD, FD_CLOEXEC);
  }
  ~Pipe()
  {
    close(m_Ends[0]);
    closeWriting();
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  int reading() const { return m_Ends[0]; }
  int writing() const { return m_Ends[1]; }
  void closeWriting()
  {
    if (m_Ends[1] >= 0) close(m_Ends[1]);
    m_Ends[1] = -1;
  }

private:
  int m_Ends[2];
};

[[noreturn]] void becomeProgram(const std::string& program, const std::vector<std::string>& arguments, const Pipe& out,
                                const Pipe& errors, pid_t parent)
{
#ifdef __linux__
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (getppid() != parent) _exit(127);
#else
  (void)parent;
#endif
  const int nothing = open("/dev/null", O_RDONLY);
  dup2(nothing, STDIN_FILENO);
  dup2(out.writing(), STDOUT_FILENO);
  dup2(errors.writing(), STDERR_FILENO);
  std::vector<char*> words{ const_cast<char*>(program.c_str()) };
  for (const std::string& argument : arguments) words.push_back(const_cast<char*>(argument.c_str()));
  words.push_back(nullptr);
  execv(program.c_str(), words.data());
  _exit(127);
}

pid_t startChild(const std::string& program, const std::vector<std::string>& arguments, const Pipe& out,
                 const Pipe& errors)
{
  const HeldSignals held;
  const pid_t parent = getpid();
  const pid_t child = fork();
  if (child < 0) throw EngineError(program + ": can't be started");
  if (child == 0)
  {
    held.letGo();
    becomeProgram(program, arguments, out, errors, parent);
  }
  runningChild = child;
  return child;
}

/// Appends what there is to read; false at the end.
bool readSome(int descriptor, std::string& text)
{
  char buffer[4096];
  const ssize_t count = read(descriptor, buffer, sizeof(buffer));
  if (count > 0) text.append(buffer, std::size_t(count));
  return count > 0 || (count < 0 && errno == EINTR);
}

void handOutLines(std::string& text, const std::function<void(const std::string&)>& eachLine)
{
  std::size_t begin = 0;
  for (std::size_t end = text.find('\n'); end != std::string::npos; end = text.find('\n', begin))
  {
    eachLine(text.substr(begin, end - begin));
    begin = end + 1;
  }
  text.erase(0, begin);
}

void readBoth(const Pipe& out, const Pipe& errors, std::string& errorText,
              const std::function<void(const std::string&)>& eachLine)
{
  std::string text;
  std::array<pollfd, 2> open{ pollfd{ out.reading(), POLLIN, 0 }, pollfd{ errors.reading(), POLLIN, 0 } };
  while (open[0].fd >= 0 || open[1].fd >= 0)
  {
    if (poll(open.data(), open.size(), -1) < 0)
    {
      if (errno == EINTR) continue;
      throw EngineError(std::string("what a program prints cannot be waited for (") + std::strerror(errno) + ")");
    }
    if (open[0].revents && !readSome(open[0].fd, text)) open[0].fd = -1;
    if (open[1].revents && !readSome(open[1].fd, errorText)) open[1].fd = -1;
    handOutLines(text, eachLine);
  }
  if (!text.empty()) eachLine(text);
}

int waitFor(pid_t child)
{
  int status = 0;
  while (waitpid(child, &status, 0) < 0)
  {
    if (errno != EINTR) throw EngineError(std::string("a program's status is lost (") + std::strerror(errno) + ")");
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

/// Reads what the child prints, to its end, and waits for it; if that fails, ends the child.
ChildOutcome outcomeOf(pid_t child, const Pipe& out, const Pipe& errors,
                       const std::function<void(const std::string&)>& eachLine)
{
  ChildOutcome outcome;
  try
  {
    readBoth(out, errors, outcome.errors, eachLine);
  }
  catch (...)
  {
    kill(child, SIGTERM);
    waitpid(child, nullptr, 0);
    throw;
  }
  outcome.status = waitFor(child);
  return outcome;
}

} // namespace

ChildOutcome runChild(const std::string& program, const std::vector<std::string>& arguments,
                      const std::function<void(const std::string&)>& eachLine)
{
  if (access(program.c_str(), X_OK) != 0)
    throw EngineError(program + ": not found, expected beside surgicalmesher, where it is installed");
  Pipe out, errors;
  const PassedOnSignals passedOn;
  const pid_t child = startChild(program, arguments, out, errors);
  if (caughtSignal) kill(child, caughtSignal); // it came before the child was known
  out.closeWriting();
  errors.closeWriting();
  ChildOutcome outcome = outcomeOf(child, out, errors, eachLine);
  if (caughtSignal) throw Interrupted{ caughtSignal };
  return outcome;
}

} // namespace surgicalmesher
