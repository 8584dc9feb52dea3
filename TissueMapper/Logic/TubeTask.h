// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Traces vessels and nerves from points on them, by TubePathCLI.

#include "FoundTube.h"
#include "PanelTask.h"
#include "TissueMap.h"
#include "VolumeNodes.h"

namespace surgicalmesher
{

class TubeTask : public PanelTask
{
public:
  enum Wanted
  {
    Path,
    PathAndTissue ///< also adds the tube to the parameter node's label map
  };
  explicit TubeTask(Wanted wanted) : PanelTask("TubePathCLI"), m_Wanted(wanted) {}

  TaskCheck findProblem(vtkMRMLTissueMapperNode* parameters) override;
  /// Result of the last completed run.
  const FoundTube& found() const { return m_Found; }

protected:
  void prepare(vtkMRMLTissueMapperNode* parameters) override;
  void deliver(vtkMRMLTissueMapperNode* parameters) override;
  void forgetResults() override;

private:
  void prepareTissues(vtkMRMLTissueMapperNode* parameters);
  void deliverPath(vtkMRMLTissueMapperNode* parameters);
  void deliverTissues(vtkMRMLTissueMapperNode* parameters);

  Wanted m_Wanted;
  std::string m_PathFile, m_ReportFile;
  std::string m_Name;
  VolumeResult m_LabelMap;
  TissueTable m_Tissues; ///< of the label map before the run
  Label m_Label = 0;
  FoundTube m_Found;
};

} // namespace surgicalmesher
