// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What the operating systems do differently.

#include <string>

namespace surgicalmesher
{

bool stdoutIsTerminal();

std::string hostName();
int processId();
bool processIsAlive(int id); ///< on this host; true in doubt

/// Hands the file's bytes to the device. Returns false if they can't be stored (a full disk shows here at the latest).
bool syncToDevice(const std::string& file);

/// From now on SIGINT and SIGTERM remove the files of removeOnSignal() before they end the process as usual.
void installSignalHandlers();
/// `file` must be absolute. Safe against a signal at any moment.
void removeOnSignal(const std::string& file);
void keepOnSignal(); ///< forgets all files

/// While it lives, what libraries write to stderr is discarded: the host logs all of it as errors, and the module's one
/// line would drown. The environment variable SURGICALMESHER_DEBUG lets it through.
class QuietStderr
{
public:
  QuietStderr();
  ~QuietStderr();
  QuietStderr(const QuietStderr&) = delete;
  QuietStderr& operator=(const QuietStderr&) = delete;

private:
  int m_SavedDescriptor = -1;
};

} // namespace surgicalmesher
