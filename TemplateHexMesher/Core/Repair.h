// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Invalid elements of a mesh made valid where they lie.

#include "ElementMesh.h"

namespace surgicalmesher
{

/// Points of `mesh`, moved beside invalid elements until none is invalid, or for `rounds` rounds: the energy of
/// FitEnergy.h over the elements around each place, in a unit of their mean edge, each round with more weight on quality
/// and some with one ring of elements more. Each node is drawn to its place, displacements are smooth, and whatever lies
/// further off stays. What remains invalid is as near to valid as it came.
///
/// By place, because a shell on a face has edges from 0.06 to 8 mm: what is stiff for the one is slack for the other, and
/// descent over all nodes at once ends when the large elements are content.
Points repaired(const ElementMesh& mesh, int rounds = 20);

} // namespace surgicalmesher
