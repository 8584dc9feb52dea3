// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The three ways a run can fail, one per exit status of the executables (0 is success).
/// Messages are one line and say which file, what was found and what was expected; what() is printable, whatever bytes
/// of a file or a command line the message quotes.

#include "PrintableText.h"

#include <stdexcept>
#include <string>

namespace surgicalmesher
{

class Error : public std::runtime_error
{
public:
  int exitStatus() const { return m_ExitStatus; }

protected:
  Error(int exitStatus, const std::string& message) : std::runtime_error(printable(message)), m_ExitStatus(exitStatus)
  {
  }

private:
  int m_ExitStatus;
};

/// The input is at fault.
class InputError : public Error
{
public:
  explicit InputError(const std::string& message) : Error(1, message) {}
};

/// The command line is at fault.
class UsageError : public Error
{
public:
  explicit UsageError(const std::string& message) : Error(2, message) {}
};

/// The engine failed: the message says at which stage, and where in mm if there is a place.
class EngineError : public Error
{
public:
  explicit EngineError(const std::string& message) : Error(3, message) {}
};

} // namespace surgicalmesher
