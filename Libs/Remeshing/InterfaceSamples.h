// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Boundary samples of a mesh that is its own reference: where its interface is now.

#include "BackgroundMesh.h"

namespace surgicalmesher
{

/// Finds the neighbours, and adds samples on every interface triangle, about half a target length apart, with a tolerance
/// of `tolerance` times the mean target length of the triangle's corners.
void addInterfaceSamples(BackgroundMesh& background, double tolerance);

} // namespace surgicalmesher
