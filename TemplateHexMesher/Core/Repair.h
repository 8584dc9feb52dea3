// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Invalid elements of a mesh made valid where they lie.

#include "ElementMesh.h"

namespace surgicalmesher
{

/// Points of `mesh` (mm), moved where elements are invalid until none is, in at most `rounds` rounds, each with more
/// weight on quality (FitEnergy.h): each node is drawn to its place, and displacements are smooth. The same points if no
/// element is invalid, or if one remains so.
Points repaired(const ElementMesh& mesh, int rounds = 20);

} // namespace surgicalmesher
