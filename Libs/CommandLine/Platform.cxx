// SPDX-License-Identifier: Apache-2.0
#include "Platform.h"

#include "Errors.h"

#include <atomic>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <deque>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <iostream>
#include <mutex>
#include <system_error>
#include <vector>

#ifdef _WIN32
#include <fcntl.h>
#include <io.h>
#include <process.h>
#define WIN32_LEAN_AND_MEAN
#include <windows.h>
#else
#include <cerrno>
#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>
#endif
#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace surgicalmesher
{

namespace
{

/// A list that the signal handler can traverse while the program adds to it: nodes are only added at the front, and
/// none is freed.
struct Doomed
{
  std::string file;
  const Doomed* next;
};
std::atomic<const Doomed*> doomedFiles{ nullptr };

/// Descriptor of the original stderr: 2, or the copy that QuietStderr keeps.
std::atomic<int> stderrDescriptor{ 2 };

/// The end of the line that a signal handler writes.
std::atomic<const char*> outputsFate{ ", no output was written\n" };

void writeAll(int descriptor, const char* text, std::size_t length)
{
#ifdef _WIN32
  const auto written = _write(descriptor, text, unsigned(length));
#else
  const auto written = write(descriptor, text, length);
#endif
  (void)written; // a failure cannot be reported anywhere
}

/// The beginning of the line that a signal handler writes; never freed.
const std::string* lastWords = nullptr;
int handlersProcess = 0;

const char* causeOf(int signal)
{
  switch (signal)
  {
  case SIGINT: return "interrupted";
  case SIGTERM: return "told to end";
  case SIGSEGV: return "crashed (memory that is not the program's)";
  case SIGABRT: return "crashed (aborted by itself)";
  case SIGFPE: return "crashed (impossible arithmetic)";
  case SIGILL: return "crashed (impossible instruction)";
#ifndef _WIN32
  case SIGBUS: return "crashed (memory that is not there)";
  case SIGHUP: return "hung up on";
  case SIGQUIT: return "told to quit";
  case SIGXCPU: return "out of processor time";
#endif
  }
  return "ended by a signal";
}

extern "C" void removeDoomedFiles(int signal)
{
  std::signal(signal, SIG_DFL);
  if (processId() != handlersProcess)
  {
    std::raise(signal);
    return;
  }
  for (const Doomed* doomed = doomedFiles.load(); doomed; doomed = doomed->next)
  {
#ifdef _WIN32
    _unlink(doomed->file.c_str());
#else
    unlink(doomed->file.c_str());
#endif
  }
  const char* const cause = causeOf(signal);
  const int descriptor = stderrDescriptor.load();
#ifndef _WIN32
  if (signal != SIGPIPE)
#endif
  {
    writeAll(descriptor, lastWords->data(), lastWords->size());
    writeAll(descriptor, cause, std::strlen(cause));
    const char* const fate = outputsFate.load();
    writeAll(descriptor, fate, std::strlen(fate));
  }
  std::raise(signal);
}

} // namespace

void removeOnSignal(const std::string& file)
{
  static std::mutex mutex;
  static auto& all = *new std::deque<Doomed>; // outlives every handler
  const std::lock_guard<std::mutex> lock(mutex);
  all.push_back({ file, doomedFiles.load() });
  doomedFiles.store(&all.back());
}

void keepOnSignal() { doomedFiles.store(nullptr); }

void outputIsInPlace() { outputsFate.store(", outputs that were complete stay\n"); }

void returnFreedMemory()
{
#ifdef __GLIBC__
  // By default, glibc raises both thresholds to as much as 64 MB after the first large array is freed, and keeps what
  // is freed later.
  constexpr int most = 16 << 20; // bytes; smaller arrays are allocated too often for a system call each time
  mallopt(M_MMAP_THRESHOLD, most);
  mallopt(M_TRIM_THRESHOLD, most);
  // Otherwise the heap would shrink completely between sweeps over a mesh and grow again page by page, which took a
  // sixth of the tetrahedral stage's time.
  mallopt(M_TOP_PAD, 2 * most);
#endif
}

#ifdef __GLIBC__

namespace
{

/// The command line that the process was started with, even if main()'s arguments have been modified.
std::vector<std::string> ownCommandLine()
{
  std::vector<std::string> words;
  std::ifstream stream("/proc/self/cmdline", std::ios::binary);
  for (std::string word; std::getline(stream, word, '\0');) words.push_back(word);
  return words;
}

} // namespace

void useLargePages()
{
  constexpr const char* tunables = "GLIBC_TUNABLES";
  if (std::getenv(tunables)) return; // set by the user, or by this function before it executed the program again
  std::error_code failure;
  const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe", failure);
  std::vector<std::string> words = ownCommandLine();
  if (failure || words.empty()) return;
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  setenv(tunables, "glibc.malloc.hugetlb=1", 1);
  execv(self.c_str(), arguments.data()); // returns only if it fails
  unsetenv(tunables);
}

#else

void useLargePages() {}

#endif

void writeToStderr(const std::string& text) { writeAll(stderrDescriptor.load(), text.data(), text.size()); }

#ifdef _WIN32

void installSignalHandlers(const std::string& program)
{
  lastWords = new std::string(program + ": "); // outlives every handler
  handlersProcess = processId();
  for (const int signal : { SIGINT, SIGTERM, SIGSEGV, SIGABRT, SIGFPE, SIGILL }) std::signal(signal, removeDoomedFiles);
}

bool stdoutIsTerminal() { return _isatty(_fileno(stdout)) != 0; }

void openStandardStreams() {}
void keepStatusOfChildren() {}

namespace
{

/// True also if there never was a reader: a program without a console has no stdout, and its descriptor is negative.
/// Tests for a reader by an empty write, since the write that failed may be long ago.
bool readerOfStdoutIsGone()
{
  const int descriptor = _fileno(stdout);
  if (descriptor < 0) return true;
  DWORD written = 0;
  if (WriteFile(reinterpret_cast<HANDLE>(_get_osfhandle(descriptor)), "", 0, &written, nullptr)) return false;
  const DWORD error = GetLastError();
  return error == ERROR_BROKEN_PIPE || error == ERROR_NO_DATA;
}

} // namespace

std::string hostName()
{
  char name[MAX_COMPUTERNAME_LENGTH + 1];
  DWORD size = sizeof(name);
  return GetComputerNameA(name, &size) ? std::string(name, size) : std::string("host");
}

int processId() { return _getpid(); }

bool processIsAlive(int id)
{
  const HANDLE process = OpenProcess(SYNCHRONIZE, FALSE, DWORD(id));
  if (!process) return GetLastError() != ERROR_INVALID_PARAMETER;
  const bool alive = WaitForSingleObject(process, 0) == WAIT_TIMEOUT;
  CloseHandle(process);
  return alive;
}

bool syncToDevice(const std::string& file)
{
  const int descriptor = _open(file.c_str(), _O_RDWR | _O_BINARY);
  if (descriptor < 0) return false;
  const bool stored = _commit(descriptor) == 0;
  return _close(descriptor) == 0 && stored;
}

QuietStderr::QuietStderr()
{
  if (std::getenv("SURGICALMESHER_DEBUG")) return;
  const int nowhere = _open("NUL", _O_WRONLY);
  if (nowhere < 0) return;
  stderrDescriptor = _dup(2);
  _dup2(nowhere, 2);
  _close(nowhere);
}

QuietStderr::~QuietStderr()
{
  if (stderrDescriptor == 2) return;
  std::fflush(stderr);
  _dup2(stderrDescriptor, 2);
  _close(stderrDescriptor.exchange(2));
}

#else

namespace
{

/// Gives handlers a stack of their own, since a crash may be a stack overflow.
void useOtherStackForHandlers()
{
  constexpr std::size_t size = 1 << 16;
  static auto& memory = *new std::vector<char>(size); // outlives every handler
  stack_t stack{};
  stack.ss_sp = memory.data();
  stack.ss_size = memory.size();
  sigaltstack(&stack, nullptr);
}

/// Installs the handler, unless the signal is ignored (nohup) or has a handler already (sanitizers, debuggers).
void handle(int signal)
{
  struct sigaction present
  {
  };
  if (sigaction(signal, nullptr, &present) != 0 || present.sa_handler != SIG_DFL) return;
  struct sigaction action
  {
  };
  action.sa_handler = removeDoomedFiles;
  action.sa_flags = SA_ONSTACK | SA_NODEFER;
  sigemptyset(&action.sa_mask);
  sigaction(signal, &action, nullptr);
}

bool readerOfStdoutIsGone()
{
  pollfd out{ STDOUT_FILENO, POLLOUT, 0 };
  return poll(&out, 1, 0) > 0 && (out.revents & (POLLERR | POLLHUP));
}

} // namespace

void installSignalHandlers(const std::string& program)
{
  lastWords = new std::string(program + ": "); // outlives every handler
  handlersProcess = processId();
  useOtherStackForHandlers();
  for (const int signal : { SIGHUP, SIGINT, SIGQUIT, SIGILL, SIGABRT, SIGFPE, SIGBUS, SIGSEGV, SIGPIPE, SIGALRM,
                            SIGTERM, SIGUSR1, SIGUSR2, SIGXCPU })
  {
    handle(signal);
  }
  std::signal(SIGXFSZ, SIG_IGN);
}

bool stdoutIsTerminal() { return isatty(STDOUT_FILENO) != 0; }

void openStandardStreams()
{
  for (const int descriptor : { STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO })
  {
    const bool isClosed = fcntl(descriptor, F_GETFD) < 0;
    if (isClosed && open("/dev/null", O_RDWR) < 0) return; // takes the lowest free descriptor, which is this one
  }
}

void keepStatusOfChildren() { std::signal(SIGCHLD, SIG_DFL); }

std::string hostName()
{
  char name[256] = {};
  const std::string host = gethostname(name, sizeof(name) - 1) == 0 && name[0] ? name : "host";
  struct stat space
  {
  };
  return stat("/proc/self/ns/pid", &space) == 0 ? host + "-" + std::to_string(space.st_ino) : host;
}

int processId() { return int(getpid()); }

bool processIsAlive(int id) { return kill(id, 0) == 0 || errno != ESRCH; }

bool syncToDevice(const std::string& file)
{
  const int descriptor = open(file.c_str(), O_RDONLY);
  if (descriptor < 0) return false;
  // EINVAL: the file system does not support synchronisation.
  const bool stored = fsync(descriptor) == 0 || errno == EINVAL;
  return close(descriptor) == 0 && stored;
}

QuietStderr::QuietStderr()
{
  if (std::getenv("SURGICALMESHER_DEBUG")) return;
  const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
  if (nowhere < 0) return;
  const int saved = fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, 3);
  if (saved >= 0 && dup2(nowhere, STDERR_FILENO) >= 0) stderrDescriptor = saved;
  close(nowhere);
}

QuietStderr::~QuietStderr()
{
  if (stderrDescriptor == STDERR_FILENO) return;
  std::fflush(stderr);
  dup2(stderrDescriptor, STDERR_FILENO);
  close(stderrDescriptor.exchange(STDERR_FILENO));
}

#endif

void requireStdoutWritten()
{
  std::cout.flush();
  const bool isLost = !std::cout || std::fflush(stdout) != 0 || std::ferror(stdout);
  if (isLost && !readerOfStdoutIsGone())
    throw EngineError("stdout: not all that was printed could be written, a place with room for it expected");
}

} // namespace surgicalmesher
