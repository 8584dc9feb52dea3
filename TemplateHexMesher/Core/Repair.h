// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Local repair of the invalid elements of a mesh.

#include "ElementMesh.h"

namespace surgicalmesher
{

/// Returns the points of `mesh` with nodes near invalid elements moved, until no element has a scaled Jacobian below
/// 0.02, or for `rounds` rounds; a mesh without invalid elements is returned unchanged. Each round minimises the energy
/// of FitEnergy.h over patches of elements around the invalid ones, in units of the patch's mean edge, with increasing
/// weight on quality; the patches grow by one ring of elements every second round. Nodes are drawn to their original
/// positions, displacements are smooth, and nodes outside the patches stay. An element that remains invalid is as close
/// to valid as was reached.
///
/// Patches are used because a facial shell has edges from 0.06 to 8 mm: what is stiff for small elements is slack for
/// large ones, and descent over all nodes at once stops when the large elements are satisfied.
Points repaired(const ElementMesh& mesh, int rounds = 20);

} // namespace surgicalmesher
