// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The host in a test: its real application object with its own modules and ours, a layout of views, no main window.
///
///     int qSlicerSimplexMesherModuleWidgetTest(int, char*[])
///     {
///       HostApplication host;
///       auto* panel = host.enterPanel("SimplexMesher");
///       ...                                              // fill the panel
///       findChild<QPushButton>(panel, "ApplyButton")->click();
///       CHECK_BOOL(host.waitUntil([&] { return run->GetStatus() != vtkSurgicalMesherRun::Running; }), true);
///       CHECK_STD_STRING(host.complaints(), "");
///       return EXIT_SUCCESS;
///     }
///
/// One per process, as for any QApplication. Settings are fresh and thrown away. The views are drawn by OpenGL, so a
/// display must exist; on a machine without one run ctest by xvfb-run.

#include "HostLog.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <QObject>
#include <QString>
#include <QTemporaryDir>

class QWidget;
class qSlicerAbstractModuleWidget;
class qSlicerApplication;
class qSlicerLayoutManager;
class vtkMRMLAbstractLogic;
class vtkMRMLScene;

namespace surgicalmesher::test
{

class HostApplication
{
public:
  HostApplication();
  ~HostApplication();
  HostApplication(const HostApplication&) = delete;
  HostApplication& operator=(const HostApplication&) = delete;

  qSlicerApplication& application() const { return *m_Application; }
  vtkMRMLScene* scene() const;
  qSlicerLayoutManager* layoutManager() const;

  /// The panel of a module, shown in a window of its own, as `enter()` leaves it. Leaves the panel entered before.
  /// Throws std::runtime_error if the module has none.
  qSlicerAbstractModuleWidget* enterPanel(const QString& moduleName);
  void leavePanel();

  /// The logic of a loadable or command-line module. Throws std::runtime_error if there is no such module.
  vtkMRMLAbstractLogic* logic(const QString& moduleName) const;

  /// Handles events (timers, queued signals, results of runs) until the condition holds. False if it does not within so
  /// many seconds.
  bool waitUntil(const std::function<bool()>& condition, double seconds = 120);

  /// Handles events for so many seconds, for instance to let a debounced preview settle.
  void waitFor(double seconds);

  /// The warnings and errors in the host's log since the last call, one per line; empty if there are none. Of those
  /// from the host's start, only the ones that name a module or class of ours.
  std::string complaints();

private:
  void loadModules();
  void makeViews();

  std::vector<std::string> m_Arguments;
  std::vector<char*> m_ArgumentPointers;
  int m_ArgumentCount;
  QTemporaryDir m_TemporaryFolder; // several tests may run at a time
  std::unique_ptr<qSlicerApplication> m_Application;
  std::unique_ptr<QWidget> m_Viewport;
  qSlicerAbstractModuleWidget* m_Panel = nullptr;
  HostLog m_Log;
  std::string m_Complaints; ///< of the start
};

/// The child of this type and object name, as in the .ui file. Throws std::runtime_error if there is none.
template <typename Widget>
Widget* findChild(QObject* parent, const char* name);

[[noreturn]] void throwMissingChild(QObject* parent, const char* name);

template <typename Widget>
Widget* findChild(QObject* parent, const char* name)
{
  auto* child = parent->findChild<Widget*>(QString::fromUtf8(name));
  if (!child) throwMissingChild(parent, name);
  return child;
}

} // namespace surgicalmesher::test
