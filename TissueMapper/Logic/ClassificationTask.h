// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Finds tissues from images and training points, or only the compartments that admit them, by TissueMapperCLI.

#include "PanelTask.h"
#include "VolumeNodes.h"

#include <string>
#include <vector>

class vtkMRMLScalarVolumeNode;

namespace surgicalmesher
{

/// Returns the reason why an image cannot be used as input of a run.
TaskCheck checkImage(vtkMRMLScalarVolumeNode* image);

class ClassificationTask : public PanelTask
{
public:
  enum Wanted
  {
    Tissues,
    Compartments ///< for a preview, from images in voxels of about 2 mm
  };
  explicit ClassificationTask(Wanted wanted) : PanelTask("TissueMapperCLI"), m_Wanted(wanted) {}

  TaskCheck findProblem(vtkMRMLTissueMapperNode* parameters) override;
  /// Classes without any voxel in the last completed run.
  const std::vector<std::string>& emptyClasses() const { return m_EmptyClasses; }

protected:
  void prepare(vtkMRMLTissueMapperNode* parameters) override;
  void deliver(vtkMRMLTissueMapperNode* parameters) override;
  void forgetResults() override;

private:
  void deliverTissues(vtkMRMLTissueMapperNode* parameters);
  void deliverCompartments(vtkMRMLTissueMapperNode* parameters);

  Wanted m_Wanted;
  VolumeResult m_LabelMap, m_Compartments;
  std::string m_NamesFile;
  std::vector<std::string> m_EmptyClasses;
};

} // namespace surgicalmesher
