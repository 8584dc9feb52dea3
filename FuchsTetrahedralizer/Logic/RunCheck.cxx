// SPDX-License-Identifier: Apache-2.0
#include "RunCheck.h"

#include "Errors.h"
#include "MarkupsInput.h"
#include "MaterialTable.h"
#include "ModelMesh.h"
#include "RunInputs.h"
#include "SceneNodes.h"
#include "ShellChoices.h"
#include "vtkMRMLFuchsTetrahedralizerNode.h"

#include <vtkMRMLMarkupsNode.h>
#include <vtkMRMLModelNode.h>
#include <vtkMRMLScalarVolumeNode.h>
#include <vtkMRMLTransformNode.h>

#include <vtkPolyData.h>

#include <set>

namespace surgicalmesher
{
namespace
{

using Parameters = vtkMRMLFuchsTetrahedralizerNode;
using Problem = vtkSlicerFuchsTetrahedralizerLogic::Problem;
using Check = vtkSlicerFuchsTetrahedralizerLogic::Check;

Check checkSurfaces(const std::vector<vtkMRMLModelNode*>& surfaces)
{
  if (surfaces.empty()) return { Problem::NoSurface, nullptr, {} };
  for (vtkMRMLModelNode* surface : surfaces)
  {
    vtkPolyData* triangles = surface->GetPolyData();
    if (!triangles || triangles->GetNumberOfPolys() + triangles->GetNumberOfStrips() == 0)
      return { Problem::NotASurface, surface, {} };
    if (surfaces.size() > 1 && isLabelledSurface(surface)) return { Problem::LabelledAmongOthers, surface, {} };
  }
  return {};
}

Check checkLengths(Parameters* parameters, const std::vector<vtkMRMLModelNode*>& surfaces)
{
  vtkMRMLScalarVolumeNode* scale = scaleOf(parameters);
  switch (parameters->GetEdgeLengthSource())
  {
  case Parameters::FromSurface:
    return { hasTargetLengths(surfaces) ? Problem::None : Problem::NoTargetLengths, nullptr, {} };
  case Parameters::FromScale:
    if (!hasVoxels(scale)) return { Problem::NoScale, scale, {} };
    if (scale->GetParentTransformNode() && !scale->GetParentTransformNode()->IsTransformToWorldLinear())
      return { Problem::ScaleWarped, scale, {} };
    return {};
  default: return { parameters->GetEdgeLength() > 0 ? Problem::None : Problem::NoEdgeLength, nullptr, {} };
  }
}

Check checkOutputs(Parameters* parameters)
{
  std::set<vtkMRMLNode*> taken;
  for (vtkMRMLModelNode* surface : surfacesOf(parameters)) taken.insert(surface);
  if (vtkMRMLModelNode* ambient = ambientOf(surfacesOf(parameters))) taken.insert(ambient);
  for (const char* role : outputRoles)
  {
    vtkMRMLModelNode* output = parameters->GetModelNode(role);
    if (output && !taken.insert(output).second) return { Problem::OutputIsInput, output, {} };
  }
  return {};
}

Check checkConstitutiveClasses(Parameters* parameters)
{
  for (vtkMRMLNode* node : parameters->GetNodes(Parameters::PathRole()))
  {
    if (markupsPath(vtkMRMLMarkupsNode::SafeDownCast(node)).empty()) return { Problem::NotAPath, node, {} };
  }
  const ConstitutiveRule rule = ruleOf(parameters);
  const bool hasPlace = !rule.targets.empty() || !rule.paths.empty();
  const bool hasDistance = rule.nonlinearDistance > 0 || rule.nullTargetRadius > 0 || rule.nullPathDistance > 0;
  if (rule.nonlinearDistance > 0 && !hasPlace) return { Problem::NoPlaces, nullptr, {} };
  if (rule.nullTargetRadius > 0 && rule.targets.empty()) return { Problem::NoTargets, nullptr, {} };
  if (rule.nullPathDistance > 0 && rule.paths.empty()) return { Problem::NoPaths, nullptr, {} };
  if (rule.nullPathDistanceAtTarget > 0 && rule.nullPathDistance == 0) return { Problem::NoEntryDistance, nullptr, {} };
  if (rule.nonlinearDistanceAtTarget > 0 && (rule.nonlinearDistance == 0 || rule.paths.empty()))
    return { Problem::NoNonlinearEntry, nullptr, {} };
  if (hasPlace && !hasDistance) return { Problem::NoDistance, nullptr, {} };
  return {};
}

/// The tissues of other than labelled surfaces are known only after meshing.
Check checkFiniteElements(Parameters* parameters, const std::vector<vtkMRMLModelNode*>& surfaces)
{
  if (!isLabelledSurface(surfaces.front())) return {};
  const TissueTable tissues = tissuesOfSurface(surfaces.front());
  std::vector<ShellChoice> shells;
  try
  {
    shells = shellChoices(shellTextsOf(parameters), tissues, labelsOf(tissues), parameters->GetShellThickness());
  }
  catch (const Error&)
  {
    return { Problem::UnknownShell, nullptr, parameters->GetShellTissues() };
  }
  vtkMRMLModelNode* output = parameters->GetModelNode(Parameters::ShellsRole());
  if (output && shells.empty()) return { Problem::ShellsUnused, output, {} };
  if (parameters->GetMaterialsFile().empty()) return {};
  try
  {
    readMaterialTable(parameters->GetMaterialsFile(), tissues, labelsOf(tissues));
  }
  catch (const Error& error)
  {
    return { Problem::BadMaterials, nullptr, error.what() };
  }
  return {};
}

} // namespace

Check findProblem(vtkMRMLFuchsTetrahedralizerNode* parameters,
                  const std::function<bool(vtkMRMLModelNode* surface, vtkMRMLModelNode* ambient)>& belong)
{
  const std::vector<vtkMRMLModelNode*> surfaces = surfacesOf(parameters);
  Check check = checkSurfaces(surfaces);
  if (check.problem == Problem::None) check = checkLengths(parameters, surfaces);
  if (check.problem == Problem::None && parameters->GetUseAmbient())
  {
    vtkMRMLModelNode* ambient = ambientOf(surfaces);
    if (ambient && !belong(surfaces.front(), ambient)) check = { Problem::AmbientChanged, surfaces.front(), {} };
  }
  if (check.problem == Problem::None) check = checkOutputs(parameters);
  if (check.problem == Problem::None) check = checkConstitutiveClasses(parameters);
  if (check.problem == Problem::None) check = checkFiniteElements(parameters, surfaces);
  return check;
}

} // namespace surgicalmesher
