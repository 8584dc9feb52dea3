// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Tetrahedra of ten nodes, with straight sides.

#include "FiniteElementModel.h"

namespace surgicalmesher
{

/// The model of tetrahedra with a node in the middle of each edge, as VTK and Abaqus number them: after the corners
/// those of the edges 01, 12, 02, 03, 13, 23, in faces of the edges 01, 12, 02. New points follow the corners, ascending
/// by the ids of their ends; sets of nodes get those that belong to them; TargetEdgeLength is the mean of the ends'.
/// `content` keeps its tetrahedra of four corners. The model must have no beams, and no elements of other shapes.
FiniteElementModel withMidSideNodes(FiniteElementModel model);

} // namespace surgicalmesher
