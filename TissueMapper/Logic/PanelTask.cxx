// SPDX-License-Identifier: Apache-2.0
#include "PanelTask.h"

#include "Errors.h"
#include "vtkMRMLTissueMapperNode.h"
#include "vtkSurgicalMesherRun.h"

#include <vtkCallbackCommand.h>

namespace surgicalmesher
{

PanelTask::PanelTask(const std::string& module) : m_Module(module)
{
  m_Ended->SetClientData(this);
  m_Ended->SetCallback([](vtkObject*, unsigned long, void* self, void*) { static_cast<PanelTask*>(self)->end(); });
  m_Run->AddObserver(vtkSurgicalMesherRun::CompletedEvent, m_Ended, 1); // priority above that of the panel's observer
}

PanelTask::~PanelTask() { m_Run->RemoveObserver(m_Ended); }

TaskCheck PanelTask::start(vtkMRMLAbstractLogic* module, vtkMRMLTissueMapperNode* parameters)
{
  m_Run->SetCommandLineLogic(module);
  m_Parameters = parameters;
  try
  {
    this->prepare(parameters);
  }
  catch (const Error& error)
  {
    m_Run->SetCommandLineLogic(nullptr); // releases the nodes
    this->forgetResults();
    return { TaskCheck::Refused, error.what() };
  }
  if (m_Run->Start()) return {};
  return { TaskCheck::Refused, m_Run->GetErrorText() };
}

void PanelTask::end()
{
  try
  {
    if (m_Parameters && m_Parameters->GetScene() && m_Run->GetStatus() == vtkSurgicalMesherRun::Completed)
      this->deliver(m_Parameters);
  }
  catch (const Error& error)
  {
    m_Run->SetErrorText(error.what()); // the result files are missing or unreadable
  }
  this->forgetResults();
}

} // namespace surgicalmesher
