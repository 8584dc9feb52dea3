// SPDX-License-Identifier: Apache-2.0
#include "VTKErrors.h"

#include <vtkObjectFactory.h>

#include <algorithm>

namespace surgicalmesher
{

class ErrorWindow : public vtkOutputWindow
{
public:
  static ErrorWindow* New();
  vtkTypeMacro(ErrorWindow, vtkOutputWindow);

  void DisplayErrorText(const char* text) override
  {
    if (m_First.empty()) m_First = text;
  }
  void DisplayText(const char*) override {}
  void DisplayWarningText(const char*) override {}
  void DisplayGenericWarningText(const char*) override {}
  void DisplayDebugText(const char*) override {}

  const std::string& first() const { return m_First; }

private:
  std::string m_First;
};
vtkStandardNewMacro(ErrorWindow);

ErrorCatcher::ErrorCatcher()
  : m_Window(vtkSmartPointer<ErrorWindow>::New()), m_Previous(vtkOutputWindow::GetInstance()),
    m_Verbosity(vtkLogger::GetCurrentVerbosityCutoff())
{
  vtkOutputWindow::SetInstance(m_Window);
  vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
}

ErrorCatcher::~ErrorCatcher()
{
  vtkLogger::SetStderrVerbosity(m_Verbosity);
  vtkOutputWindow::SetInstance(m_Previous);
}

bool ErrorCatcher::any() const { return !m_Window->first().empty(); }

std::string ErrorCatcher::message() const
{
  std::string text = m_Window->first();
  const std::size_t start = text.rfind("): ");
  if (start != std::string::npos) text = text.substr(start + 3);
  std::replace(text.begin(), text.end(), '\n', ' ');
  text.erase(text.find_last_not_of(' ') + 1);
  return text;
}

} // namespace surgicalmesher
