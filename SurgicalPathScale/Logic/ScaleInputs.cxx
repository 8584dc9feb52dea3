// SPDX-License-Identifier: Apache-2.0
#include "ScaleInputs.h"

#include "Errors.h"
#include "MarkupsInput.h"
#include "TextFile.h"
#include "TissueLengths.h"
#include "TissueMapIO.h"
#include "vtkMRMLSurgicalPathScaleNode.h"

namespace surgicalmesher
{

namespace
{

Combination combinationOf(const std::string& name)
{
  if (name == "targets") return Combination::Targets;
  return name == "path" ? Combination::Paths : Combination::Smaller;
}

} // namespace

Focus focusOf(vtkMRMLSurgicalPathScaleNode* parameters)
{
  Focus focus;
  for (vtkMRMLMarkupsNode* node : parameters->GetTargetNodes())
  {
    const std::vector<Vec3> points = markupsPoints(node);
    focus.targets.insert(focus.targets.end(), points.begin(), points.end());
  }
  for (vtkMRMLMarkupsNode* node : parameters->GetPathNodes())
  {
    const Path path = markupsPath(node);
    if (!path.empty()) focus.paths.push_back(path);
  }
  return focus;
}

SurgicalScaleOptions scaleOptions(vtkMRMLSurgicalPathScaleNode* parameters, const TissueTable& names)
{
  const auto orElse = [](double value, double fallback) { return value > 0 ? value : fallback; };
  SurgicalScaleOptions options;
  options.range = { parameters->GetMinimumEdgeLength(), parameters->GetMaximumEdgeLength() };
  options.targetFalloff = { parameters->GetChildRadius(), parameters->GetDecayLength() };
  options.pathFalloff.childRadius = orElse(parameters->GetPathChildRadius(), options.targetFalloff.childRadius);
  options.pathFalloff.decayLength = orElse(parameters->GetPathDecayLength(), options.targetFalloff.decayLength);
  options.combination = combinationOf(parameters->GetCombine());
  options.gradation = parameters->GetGradation();
  options.spacing = parameters->GetSpacing();
  const std::string file = parameters->GetTissueLengths();
  if (!file.empty()) options.tissues = readTissueLengths(file, options.range, names);
  return options;
}

NullDisplacementOptions nullDisplacementOptions(vtkMRMLSurgicalPathScaleNode* parameters, const TissueTable& names)
{
  NullDisplacementOptions options;
  options.targetRadius = parameters->GetNullDisplacementRadius();
  options.pathDistance = parameters->GetNullDisplacementPathDistance();
  options.pathDistanceAtTarget = parameters->GetNullDisplacementPathDistanceAtTarget();
  const std::string tissues = parameters->GetNullDisplacementTissues();
  if (text::trimmed(tissues).empty()) return options;
  for (const std::string& tissue : text::splitFields(tissues))
  {
    Label label = 0;
    if (!findTissue(tissue, names, label)) throw InputError(whyNoTissue(tissue, names));
    options.tissues.insert(label);
  }
  return options;
}

} // namespace surgicalmesher
