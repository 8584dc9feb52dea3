// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Check whether a run can be started from a parameter node; cheap enough for every change in a panel.

#include "vtkSlicerFuchsTetrahedralizerLogic.h"

#include <functional>

namespace surgicalmesher
{

/// Returns the first problem of the parameter node, except problems that depend on the installed modules. `belong`
/// returns whether a surface and its ambient tetrahedra still belong together.
vtkSlicerFuchsTetrahedralizerLogic::Check
findProblem(vtkMRMLFuchsTetrahedralizerNode* parameters,
            const std::function<bool(vtkMRMLModelNode* surface, vtkMRMLModelNode* ambient)>& belong);

} // namespace surgicalmesher
