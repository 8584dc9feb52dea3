// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Registers one image to another, by LocalRegistrationCLI.

#include "FoundRegistration.h"
#include "PanelTask.h"
#include "VolumeNodes.h"

namespace surgicalmesher
{

class RegistrationTask : public PanelTask
{
public:
  RegistrationTask() : PanelTask("LocalRegistrationCLI") {}

  TaskCheck findProblem(vtkMRMLTissueMapperNode* parameters) override;
  /// Result of the last completed run.
  const FoundRegistration& found() const { return m_Found; }

protected:
  void prepare(vtkMRMLTissueMapperNode* parameters) override;
  void deliver(vtkMRMLTissueMapperNode* parameters) override;
  void forgetResults() override;

private:
  VolumeResult m_Registered;
  std::string m_ReportFile;
  FoundRegistration m_Found;
};

} // namespace surgicalmesher
