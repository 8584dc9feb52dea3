// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Boundary samples of a mesh that is its own reference: they record where its interface is now.

#include "BackgroundMesh.h"

namespace surgicalmesher
{

/// Fills `background.neighbours` and adds three samples to every interface triangle, or to each of its congruent parts
/// where its edges are longer than twice the target length. Samples are thus half a target length apart on triangles of
/// the target size. Each sample's tolerance is `tolerance` times the mean target length at the triangle's corners.
void addInterfaceSamples(BackgroundMesh& background, double tolerance);

} // namespace surgicalmesher
