// SPDX-License-Identifier: Apache-2.0
#include "Platform.h"

#include <atomic>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <deque>
#include <mutex>

#ifdef _WIN32
#include <fcntl.h>
#include <io.h>
#include <process.h>
#define WIN32_LEAN_AND_MEAN
#include <windows.h>
#else
#include <cerrno>
#include <fcntl.h>
#include <unistd.h>
#endif

namespace surgicalmesher
{

namespace
{

/// A list that the signal handler can walk while the program adds to it: nodes are only ever put in front, and
/// none is freed.
struct Doomed
{
  std::string file;
  const Doomed* next;
};
std::atomic<const Doomed*> doomedFiles{ nullptr };

extern "C" void removeDoomedFiles(int signal)
{
  for (const Doomed* doomed = doomedFiles.load(); doomed; doomed = doomed->next)
  {
#ifdef _WIN32
    _unlink(doomed->file.c_str());
#else
    unlink(doomed->file.c_str());
#endif
  }
  std::signal(signal, SIG_DFL);
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

void installSignalHandlers()
{
  std::signal(SIGINT, removeDoomedFiles);
  std::signal(SIGTERM, removeDoomedFiles);
}

#ifdef _WIN32

bool stdoutIsTerminal() { return _isatty(_fileno(stdout)) != 0; }

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
  m_SavedDescriptor = _dup(2);
  _dup2(nowhere, 2);
  _close(nowhere);
}

QuietStderr::~QuietStderr()
{
  if (m_SavedDescriptor < 0) return;
  std::fflush(stderr);
  _dup2(m_SavedDescriptor, 2);
  _close(m_SavedDescriptor);
}

#else

bool stdoutIsTerminal() { return isatty(STDOUT_FILENO) != 0; }

std::string hostName()
{
  char name[256] = {};
  return gethostname(name, sizeof(name) - 1) == 0 && name[0] ? name : "host";
}

int processId() { return int(getpid()); }

bool processIsAlive(int id) { return kill(id, 0) == 0 || errno != ESRCH; }

bool syncToDevice(const std::string& file)
{
  const int descriptor = open(file.c_str(), O_RDONLY);
  if (descriptor < 0) return false;
  // EINVAL: a file system that has nothing to synchronise.
  const bool stored = fsync(descriptor) == 0 || errno == EINVAL;
  return close(descriptor) == 0 && stored;
}

QuietStderr::QuietStderr()
{
  if (std::getenv("SURGICALMESHER_DEBUG")) return;
  const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
  if (nowhere < 0) return;
  m_SavedDescriptor = fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, 3);
  if (m_SavedDescriptor >= 0) dup2(nowhere, STDERR_FILENO);
  close(nowhere);
}

QuietStderr::~QuietStderr()
{
  if (m_SavedDescriptor < 0) return;
  std::fflush(stderr);
  dup2(m_SavedDescriptor, STDERR_FILENO);
  close(m_SavedDescriptor);
}

#endif

} // namespace surgicalmesher
