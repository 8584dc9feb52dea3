// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Ten-node tetrahedra with straight sides.

#include "FiniteElementModel.h"

namespace surgicalmesher
{

/// Returns the model with a node at the midpoint of each edge, numbered as in VTK and Abaqus: after the corners those
/// of the edges 01, 12, 02, 03, 13, 23 of a tetrahedron, and 01, 12, 02 of a face. New points follow the corners,
/// ascending by the ids of their ends; node sets are extended by the mid-side nodes that belong to them;
/// TargetEdgeLength is the mean of the ends. `content` keeps its tetrahedra of four corners. The model must have no
/// beams and only tetrahedra.
FiniteElementModel withMidSideNodes(FiniteElementModel model);

} // namespace surgicalmesher
