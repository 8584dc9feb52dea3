// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Capture of VTK's error messages, the only way in which its readers report damaged content.

#include <vtkLogger.h>
#include <vtkNew.h>
#include <vtkOutputWindow.h>
#include <vtkSmartPointer.h>

#include <string>

namespace surgicalmesher
{

class ErrorWindow;

/// Keeps VTK from printing anything during its lifetime, and records the first error.
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
