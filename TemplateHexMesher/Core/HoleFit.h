// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The borders of a layered mesh's holes, brought from the staircase that left-out columns make to the holes' own, and
/// better elements.

#include "VolumetricHexahedra.h"

namespace surgicalmesher
{

using HoleBorders = std::vector<std::vector<Eigen::Vector3d>>; ///< closed loops of positions

/// Moves nodes to the minimum of FitEnergy: all of a mesh of at most 20,000, else those within three elements of a hole,
/// or of an element with a scaled Jacobian under 0.2. Nodes on a side of the envelope slide on it (in the smaller mesh
/// faces lie on skin and inner surface by their middles, too); nodes around a hole are drawn to its `borders` on the
/// outer and the inner surface and to its walls between. Rounds of repair follow, at most `repairRounds`, while an element
/// is invalid, or under 0.2 and each brings more. Throws EngineError, with the place, if one is still invalid then.
void fitToHoles(LayeredMesh& mesh, const Envelope& envelope, const std::array<HoleBorders, 2>& borders,
                int repairRounds, const Progress& progress = {});

} // namespace surgicalmesher
