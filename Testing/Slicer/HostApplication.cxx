// SPDX-License-Identifier: Apache-2.0
#include "HostApplication.h"

#include "Waiting.h"

#include <qSlicerAbstractCoreModule.h>
#include <qSlicerAbstractModule.h>
#include <qSlicerAbstractModuleWidget.h>
#include <qSlicerApplication.h>
#include <qSlicerApplicationHelper.h>
#include <qSlicerLayoutManager.h>
#include <qSlicerMainWindow.h>
#include <qSlicerModuleManager.h>
#include <qSlicerStyle.h>

#include <vtkMRMLAbstractLogic.h>
#include <vtkMRMLLayoutNode.h>
#include <vtkMRMLScene.h>
#include <vtkSlicerApplicationLogic.h>

#include <QScopedPointer>
#include <QSplashScreen>
#include <QVBoxLayout>
#include <QWidget>

#include <stdexcept>
#include <utility>

namespace surgicalmesher::test
{
namespace
{

std::vector<std::string> commandLine()
{
  return { "SlicerApp-real", // the name that the host's settings of libraries and plugins go by
           "--testing",      // settings of its own, thrown away
           "--no-main-window",
           "--no-splash",
           "--additional-module-paths",
           SURGICALMESHER_LOADABLE_MODULES,
           SURGICALMESHER_CLI_MODULES };
}

std::vector<char*> pointersTo(std::vector<std::string>& strings)
{
  std::vector<char*> pointers;
  for (std::string& s : strings) pointers.push_back(s.data());
  pointers.push_back(nullptr); // as argv ends
  return pointers;
}

qSlicerAbstractCoreModule* moduleNamed(const qSlicerApplication& application, const QString& name)
{
  qSlicerAbstractCoreModule* module = const_cast<qSlicerApplication&>(application).moduleManager()->module(name);
  if (!module) throw std::runtime_error("no module " + name.toStdString() + " in the host");
  return module;
}

} // namespace

HostApplication::HostApplication()
  : m_Arguments(commandLine()), m_ArgumentPointers(pointersTo(m_Arguments)),
    m_ArgumentCount(static_cast<int>(m_Arguments.size()))
{
  qSlicerApplicationHelper::preInitializeApplication(m_ArgumentPointers.front(), new qSlicerStyle);
  m_Application = std::make_unique<qSlicerApplication>(m_ArgumentCount, m_ArgumentPointers.data());
  // Not by the application's setting: hosts that run at the same time share their settings.
  m_Application->applicationLogic()->SetTemporaryPath(m_TemporaryFolder.path().toUtf8());
  makeViews();
  loadModules();
  m_Complaints = m_Log.complaints();
}

HostApplication::~HostApplication()
{
  leavePanel();
  scene()->Clear(0);
  m_Application->setLayoutManager(nullptr);
  m_Viewport.reset();
}

void HostApplication::makeViews()
{
  m_Viewport = std::make_unique<QWidget>();
  m_Viewport->resize(900, 700);
  auto* layout = new qSlicerLayoutManager(m_Viewport.get());
  m_Application->setLayoutManager(layout);
  layout->setMRMLScene(m_Application->mrmlScene());
  layout->setLayout(vtkMRMLLayoutNode::SlicerLayoutFourUpPlotView);
  m_Viewport->show();
}

void HostApplication::loadModules()
{
  QScopedPointer<QSplashScreen> noSplash;
  QScopedPointer<qSlicerMainWindow> noWindow;
  qSlicerApplicationHelper::postInitializeApplication<qSlicerMainWindow>(*m_Application, noSplash, noWindow);
}

vtkMRMLScene* HostApplication::scene() const { return m_Application->mrmlScene(); }

qSlicerLayoutManager* HostApplication::layoutManager() const { return m_Application->layoutManager(); }

qSlicerAbstractModuleWidget* HostApplication::enterPanel(const QString& moduleName)
{
  leavePanel();
  m_Panel = dynamic_cast<qSlicerAbstractModuleWidget*>(moduleNamed(*m_Application, moduleName)->widgetRepresentation());
  if (!m_Panel) throw std::runtime_error("module " + moduleName.toStdString() + " has no panel");
  m_Panel->show();
  m_Panel->enter();
  return m_Panel;
}

void HostApplication::leavePanel()
{
  if (!m_Panel) return;
  m_Panel->exit();
  m_Panel->hide();
  m_Panel = nullptr;
}

vtkMRMLAbstractLogic* HostApplication::logic(const QString& moduleName) const
{
  return moduleNamed(*m_Application, moduleName)->logic();
}

bool HostApplication::waitUntil(const std::function<bool()>& condition, double seconds)
{
  return test::waitUntil(condition, seconds);
}

void HostApplication::waitFor(double seconds) { test::waitFor(seconds); }

std::string HostApplication::complaints() { return std::exchange(m_Complaints, {}) + m_Log.complaints(); }

void throwMissingChild(QObject* parent, const char* name)
{
  throw std::runtime_error(parent->objectName().toStdString() + " has no child " + name + " of the type asked for");
}

} // namespace surgicalmesher::test
