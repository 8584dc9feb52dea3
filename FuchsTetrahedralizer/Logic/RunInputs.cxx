// SPDX-License-Identifier: Apache-2.0
#include "RunInputs.h"

#include "MarkupsInput.h"
#include "ModelMesh.h"
#include "vtkMRMLFuchsTetrahedralizerNode.h"

#include <vtkMRMLMarkupsNode.h>
#include <vtkMRMLModelNode.h>
#include <vtkMRMLScalarVolumeNode.h>

#include <vtkPointData.h>
#include <vtkPolyData.h>

namespace surgicalmesher
{

using Parameters = vtkMRMLFuchsTetrahedralizerNode;

std::vector<vtkMRMLModelNode*> surfacesOf(Parameters* parameters)
{
  std::vector<vtkMRMLModelNode*> surfaces;
  for (vtkMRMLNode* node : parameters->GetNodes(Parameters::SurfaceRole()))
  {
    if (auto* model = vtkMRMLModelNode::SafeDownCast(node)) surfaces.push_back(model);
  }
  return surfaces;
}

vtkMRMLModelNode* ambientOf(const std::vector<vtkMRMLModelNode*>& surfaces)
{
  if (surfaces.size() != 1 || !isLabelledSurface(surfaces.front())) return nullptr;
  auto* ambient =
    vtkMRMLModelNode::SafeDownCast(surfaces.front()->GetNodeReference(Parameters::AmbientTetrahedraRole()));
  return ambient && ambient->GetUnstructuredGrid() ? ambient : nullptr;
}

vtkMRMLScalarVolumeNode* scaleOf(Parameters* parameters)
{
  return vtkMRMLScalarVolumeNode::SafeDownCast(parameters->GetNodeReference(Parameters::ScaleRole()));
}

ConstitutiveRule ruleOf(Parameters* parameters)
{
  ConstitutiveRule rule;
  for (vtkMRMLNode* node : parameters->GetNodes(Parameters::TargetRole()))
  {
    const std::vector<Vec3> points = markupsPoints(vtkMRMLMarkupsNode::SafeDownCast(node));
    rule.targets.insert(rule.targets.end(), points.begin(), points.end());
  }
  for (vtkMRMLNode* node : parameters->GetNodes(Parameters::PathRole()))
    rule.paths.push_back(markupsPath(vtkMRMLMarkupsNode::SafeDownCast(node)));
  rule.nonlinearDistance = parameters->GetNonlinearDistance();
  rule.nonlinearDistanceAtTarget = parameters->GetNonlinearDistanceAtTarget();
  rule.nullTargetRadius = parameters->GetNullDisplacementRadius();
  rule.nullPathDistance = parameters->GetNullDisplacementPathDistance();
  rule.nullPathDistanceAtTarget = parameters->GetNullDisplacementPathDistanceAtTarget();
  return rule;
}

std::vector<std::string> shellTextsOf(Parameters* parameters)
{
  const std::string& text = parameters->GetShellTissues();
  if (text.find_first_not_of(" \t") == text.npos) return {};
  return { text };
}

std::set<Label> labelsOf(const TissueTable& tissues)
{
  std::set<Label> labels;
  for (const auto& [label, tissue] : tissues) labels.insert(label);
  return labels;
}

bool hasTargetLengths(const std::vector<vtkMRMLModelNode*>& surfaces)
{
  return surfaces.size() == 1 && surfaces.front()->GetPolyData() &&
         surfaces.front()->GetPolyData()->GetPointData()->GetArray("TargetEdgeLength");
}

} // namespace surgicalmesher
