// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Fits the hole borders of a layered mesh, which omitted columns leave as a staircase, to the borders of the holes,
/// and improves the elements.

#include "VolumetricHexahedra.h"

namespace surgicalmesher
{

using HoleBorders = std::vector<std::vector<Eigen::Vector3d>>; ///< closed loops of positions

/// Moves nodes to the minimum of FitEnergy: in a mesh of at most 20,000 nodes all of them, in a larger one those within
/// three elements of a hole or of an element with a scaled Jacobian below 0.2. Nodes on a side of the envelope slide on
/// it (in the smaller mesh, the centres of faces are drawn to the outer and inner surface as well). Nodes around a hole
/// are drawn to its `borders` (outer, inner) on these surfaces, and to its walls in between. Up to `repairRounds`
/// rounds of repair follow, while an element is invalid, or while the least scaled Jacobian is below 0.2 and increases.
/// Throws EngineError with the position of the worst element if one remains invalid.
void fitToHoles(LayeredMesh& mesh, const Envelope& envelope, const std::array<HoleBorders, 2>& borders,
                int repairRounds, const Progress& progress = {});

} // namespace surgicalmesher
