// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Inputs given by a parameter node of Fuchs Tetrahedralizer, in the forms required by runs and exports.

#include "ConstitutiveTags.h"
#include "TissueMap.h"

#include <set>
#include <string>
#include <vector>

class vtkMRMLFuchsTetrahedralizerNode;
class vtkMRMLModelNode;
class vtkMRMLScalarVolumeNode;

namespace surgicalmesher
{

/// Roles of the outputs, which are also parameter names of the command-line module.
constexpr const char* outputRoles[] = { "mesh", "parentMesh", "childMesh", "shells" };

std::vector<vtkMRMLModelNode*> surfacesOf(vtkMRMLFuchsTetrahedralizerNode* parameters);

/// Returns the tetrahedra referenced by a single labelled surface; null if there are none.
vtkMRMLModelNode* ambientOf(const std::vector<vtkMRMLModelNode*>& surfaces);

vtkMRMLScalarVolumeNode* scaleOf(vtkMRMLFuchsTetrahedralizerNode* parameters);

/// Whether the surface has edge lengths of its own.
bool hasTargetLengths(const std::vector<vtkMRMLModelNode*>& surfaces);

/// Returns the rule with points and paths in LPS at their world positions.
ConstitutiveRule ruleOf(vtkMRMLFuchsTetrahedralizerNode* parameters);

/// Returns the texts for shellChoices().
std::vector<std::string> shellTextsOf(vtkMRMLFuchsTetrahedralizerNode* parameters);

std::set<Label> labelsOf(const TissueTable& tissues);

} // namespace surgicalmesher
