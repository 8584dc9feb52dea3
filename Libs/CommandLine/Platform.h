// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What the operating systems do differently.

#include <string>

namespace surgicalmesher
{

bool stdoutIsTerminal();

/// Those of stdin, stdout and stderr that whoever started the process has closed lead nowhere from now on: what is
/// opened later would take their place, and what is printed would go there.
void openStandardStreams();

/// From now on, large arrays go back to the system as soon as they are freed, where the system's allocator would keep
/// them; some tens of megabytes stay for those that come next.
void returnFreedMemory();

/// From then on memory comes in large pages, where the system has them for those who ask (transparent huge pages: Linux
/// with glibc 2.35 or later): most arrays are walked through once, and small pages one by one take longer than that.
/// The C library must be told before it starts: the program starts itself again, in the same process, once, and nothing
/// may have happened before that it could not do twice. Where GLIBC_TUNABLES is set, nothing is done.
void useLargePages();

/// Throws EngineError if something that was printed on stdout has not got there, for want of room, say. A reader that
/// has gone away wants no more of it.
void requireStdoutWritten();

std::string hostName();
int processId();
bool processIsAlive(int id); ///< on this host; true in doubt

/// Hands the file's bytes to the device. Returns false if they can't be stored (a full disk shows here at the latest).
bool syncToDevice(const std::string& file);

/// From now on a signal that ends the process (an interrupt, a hang-up, a closed pipe, a crash with its stack used up)
/// removes the files of removeOnSignal(), says so in a line on stderr that begins with `program`, and ends the process
/// as usual. Signals that whoever started the process ignores stay ignored. A file that may not grow any more is no
/// signal but a write that fails. Processes forked off later keep their hands off the files.
void installSignalHandlers(const std::string& program);
/// `file` must be absolute. Safe against a signal at any moment.
void removeOnSignal(const std::string& file);
void keepOnSignal();    ///< forgets all files
void outputIsInPlace(); ///< from now on the line on stderr says that what is complete stays

/// Writes to what stderr was before a QuietStderr.
void writeToStderr(const std::string& text);

/// While it lives, what libraries write to stderr is discarded: the host logs all of it as errors, and the module's one
/// line would drown. The environment variable SURGICALMESHER_DEBUG lets it through.
class QuietStderr
{
public:
  QuietStderr();
  ~QuietStderr();
  QuietStderr(const QuietStderr&) = delete;
  QuietStderr& operator=(const QuietStderr&) = delete;
};

} // namespace surgicalmesher
