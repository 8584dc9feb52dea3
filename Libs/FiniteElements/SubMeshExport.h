// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Child and parent apart, for multirate solvers: meshes of their own, and one numbering of the points that they share.
/// A solver that condenses the parent onto these points (the Norton equivalent of Astley and Hayward, Multirate haptic
/// simulation achieved by coupling finite element meshes through Norton equivalents, ICRA 1998) exchanges forces and
/// displacements with the child by these numbers alone.

#include "MeshIO.h"

#include <functional>

namespace surgicalmesher
{

/// The sub-meshes that `chosen` picks (0 parent, 1..n children), as one mesh: tetrahedra and points in the order of the
/// whole, with all they carry there. Besides,
/// - volumePointId is the point's id in the whole mesh,
/// - interfaceId numbers the points where sub-meshes meet (subMeshInterface) from 0 in the whole mesh's order, the same
///   in every part that has the point; -1 elsewhere.
/// `whole` has to have subMesh and subMeshInterface.
MeshFile partOf(const MeshFile& whole, const std::function<bool(std::int32_t subMesh)>& chosen);

} // namespace surgicalmesher
