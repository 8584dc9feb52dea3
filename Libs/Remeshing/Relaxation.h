// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Relaxation: moves vertices towards even edge lengths; interface vertices only along the interface, and across it to
/// their boundary samples.

#include "GuardedOperations.h"

namespace surgicalmesher
{

struct RelaxationOptions
{
  double goodAngle = 25; ///< degrees; a move that lowers the worst angle at its vertex is taken only above this
  double spread = 0.8;   ///< weight of the target lengths, against the mean of the neighbours' positions
  double fit = 1;        ///< weight of the samples against an even spacing of the vertices
  double robust = 0;     ///< mm, see quadricOf
};

/// Moves every unlocked vertex once. A vertex inside a label moves towards the middle of its neighbours; a vertex on a
/// sheet or curve of the interface moves towards the middle of its neighbours on it and, along the normals, to the
/// least-squares fit of its faces to their samples.
void relaxBlock(GuardedOperations& operations, const RelaxationOptions& options = {});

} // namespace surgicalmesher
