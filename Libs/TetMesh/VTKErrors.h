// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What VTK reports while it reads and writes: its readers tell of damaged content in no other way.

#include <vtkLogger.h>
#include <vtkNew.h>
#include <vtkOutputWindow.h>
#include <vtkSmartPointer.h>

#include <string>

namespace surgicalmesher
{

class ErrorWindow;

/// While it lives, VTK prints nothing, and the first error is kept.
class ErrorCatcher
{
public:
  ErrorCatcher();
  ~ErrorCatcher();
  ErrorCatcher(const ErrorCatcher&) = delete;
  ErrorCatcher& operator=(const ErrorCatcher&) = delete;

  bool any() const;

  /// The message in one line, without VTK's own file name, line number and object address.
  std::string message() const;

private:
  vtkSmartPointer<ErrorWindow> m_Window;
  vtkSmartPointer<vtkOutputWindow> m_Previous;
  vtkLogger::Verbosity m_Verbosity;
};

} // namespace surgicalmesher
