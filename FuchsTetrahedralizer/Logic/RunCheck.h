// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Can a run be started from a parameter node? Cheap enough for every change in a panel.

#include "vtkSlicerFuchsTetrahedralizerLogic.h"

#include <functional>

namespace surgicalmesher
{

/// The first problem of the parameter node, of those that don't depend on what the host has installed. `belong` tells
/// whether a surface and its ambient tetrahedra still belong together.
vtkSlicerFuchsTetrahedralizerLogic::Check
findProblem(vtkMRMLFuchsTetrahedralizerNode* parameters,
            const std::function<bool(vtkMRMLModelNode* surface, vtkMRMLModelNode* ambient)>& belong);

} // namespace surgicalmesher
