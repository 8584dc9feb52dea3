// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What a parameter node of Fuchs Tetrahedralizer names and tells, in the forms that a run and an export take.

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

/// Roles of the outputs, which are also the names of the command-line module's parameters.
constexpr const char* outputRoles[] = { "mesh", "parentMesh", "childMesh", "shells" };

std::vector<vtkMRMLModelNode*> surfacesOf(vtkMRMLFuchsTetrahedralizerNode* parameters);

/// The tetrahedra that a single labelled surface refers to; null if there are none.
vtkMRMLModelNode* ambientOf(const std::vector<vtkMRMLModelNode*>& surfaces);

vtkMRMLScalarVolumeNode* scaleOf(vtkMRMLFuchsTetrahedralizerNode* parameters);

/// Whether lengths can be the surface's own.
bool hasTargetLengths(const std::vector<vtkMRMLModelNode*>& surfaces);

/// Points and paths in LPS, as they are seen.
ConstitutiveRule ruleOf(vtkMRMLFuchsTetrahedralizerNode* parameters);

/// For shellChoices().
std::vector<std::string> shellTextsOf(vtkMRMLFuchsTetrahedralizerNode* parameters);

std::set<Label> labelsOf(const TissueTable& tissues);

} // namespace surgicalmesher
