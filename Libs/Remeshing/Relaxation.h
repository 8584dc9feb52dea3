// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Relaxation: every vertex towards even edge lengths, on the interface along it and to its boundary samples.

#include "GuardedOperations.h"

namespace surgicalmesher
{

struct RelaxationOptions
{
  double goodAngle = 25; ///< degrees; a move that lowers the worst angle at its vertex is taken only above this
  double spread = 0.8;   ///< weight of the target lengths against the mere middle of the neighbours
  double fit = 1;        ///< weight of the samples against an even spacing of the vertices
  double robust = 0;     ///< mm, see quadricOf
};

/// Moves every free vertex once: inside a tissue towards the middle of its neighbours; on a sheet or curve of the
/// interface towards the middle of its neighbours there and, along the normals, to the least-squares fit of its faces
/// to their samples.
void relaxBlock(GuardedOperations& operations, const RelaxationOptions& options = {});

} // namespace surgicalmesher
