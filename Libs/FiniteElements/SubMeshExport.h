// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Child and parent meshes as separate parts for multirate solvers, with a common numbering of the points they share. A
/// solver that condenses the parent onto these points (the Norton equivalent of Astley and Hayward, Multirate haptic
/// simulation achieved by coupling finite element meshes through Norton equivalents, ICRA 1998) exchanges forces and
/// displacements with the child by these numbers alone.

#include "MeshIO.h"

#include <functional>

namespace surgicalmesher
{

/// Returns the sub-meshes that `chosen` selects (0 parent, 1..n children) as one mesh: tetrahedra and points in their
/// original order, with their arrays. In addition,
/// - volumePointId is the id of the point in the whole mesh,
/// - interfaceId numbers the points where sub-meshes meet (subMeshInterface) from 0 in the order of the whole mesh,
///   identically in every part that has the point; it is -1 elsewhere.
/// `whole` must have subMesh and subMeshInterface.
MeshFile partOf(const MeshFile& whole, const std::function<bool(std::int32_t subMesh)>& chosen);

} // namespace surgicalmesher
