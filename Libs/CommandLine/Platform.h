// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Functions whose implementation depends on the operating system.

#include <string>

namespace surgicalmesher
{

bool stdoutIsTerminal();

/// Opens the null device in place of stdin, stdout and stderr where the process was started without them: otherwise the
/// next file opened would take their descriptor and receive what is printed. Does nothing on Windows.
void openStandardStreams();

/// Makes the status of processes that this one starts known to it, even if whoever started this one ignored SIGCHLD,
/// which it would inherit. Does nothing on Windows.
void keepStatusOfChildren();

/// From now on, large arrays are returned to the system as soon as they are freed, where the C library (glibc) would
/// keep them; some tens of megabytes stay for the next allocations.
void returnFreedMemory();

/// Makes the C library allocate large pages where the system offers them on request (transparent huge pages: Linux with
/// glibc 2.35 or later): most arrays are traversed once, which takes less time than mapping small pages one by one. The
/// library reads this setting only at start-up, so the program executes itself again, once, in the same process;
/// nothing that cannot be repeated may have happened before. Does nothing if GLIBC_TUNABLES is set.
void useLargePages();

/// Throws EngineError if something printed on stdout could not be written, for example on a full disk. A pipe whose
/// reader has closed it is no error.
void requireStdoutWritten();

/// Name of the host, and on Linux the number of the namespace of process ids: containers may share a name and a folder,
/// and have processes of the same id nevertheless.
std::string hostName();
int processId();
bool processIsAlive(int id); ///< on this host; true if that cannot be determined

/// Flushes the file to the device. Returns false if it cannot be stored (a full disk is detected here at the latest).
bool syncToDevice(const std::string& file);

/// From now on, a signal that ends the process (an interrupt, a hang-up, a closed pipe, a crash, even by stack
/// overflow) removes the files of removeOnSignal(), writes a line to stderr that begins with `program` (not for a
/// closed pipe), and ends the process as usual. Signals that are ignored when the process starts stay ignored. A file
/// that reaches its size limit makes a write fail, without a signal. Processes forked later leave the files alone.
void installSignalHandlers(const std::string& program);
/// `file` must be an absolute path. A signal may arrive at any moment during the call.
void removeOnSignal(const std::string& file);
void keepOnSignal();    ///< forgets all files of removeOnSignal()
void outputIsInPlace(); ///< from now on, a signal's line says that complete outputs stay

/// Writes to the original stderr, even while a QuietStderr exists.
void writeToStderr(const std::string& text);

/// Discards what libraries write to stderr during its lifetime: a host logs all of it as errors, and the module's own
/// line would get lost among it. Does nothing if the environment variable SURGICALMESHER_DEBUG is set.
class QuietStderr
{
public:
  QuietStderr();
  ~QuietStderr();
  QuietStderr(const QuietStderr&) = delete;
  QuietStderr& operator=(const QuietStderr&) = delete;
};

} // namespace surgicalmesher
