// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Tissues from images and training points, or only the compartments that they may be in, by TissueMapperCLI.

#include "PanelTask.h"
#include "VolumeNodes.h"

#include <string>
#include <vector>

class vtkMRMLScalarVolumeNode;

namespace surgicalmesher
{

/// What keeps an image from being read in a run.
TaskCheck checkImage(vtkMRMLScalarVolumeNode* image);

class ClassificationTask : public PanelTask
{
public:
  enum Wanted
  {
    Tissues,
    Compartments ///< from images in voxels of 2 mm, for a look
  };
  explicit ClassificationTask(Wanted wanted) : PanelTask("TissueMapperCLI"), m_Wanted(wanted) {}

  TaskCheck findProblem(vtkMRMLTissueMapperNode* parameters) override;
  /// Of the run that completed last: the classes that no voxel is of.
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
