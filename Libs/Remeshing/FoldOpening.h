// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Folds of the interface that are a little over a right angle, opened to a little less, where little of the boundary has
/// to give way for that.

#include "GuardedOperations.h"
#include "TetQuality.h"

namespace surgicalmesher
{

struct FoldOptions
{
  double goodAngle = usualAngle; ///< degrees; a move that lowers the worst angle at its vertex is taken only above this
  double from = 0;               ///< mm; vertices with smaller target lengths stay
};

/// Opens folds (Folds.h) of less than 128 degrees: the ends of the edge and the two corners beyond it move together, by the
/// least that their samples resist (least squares, with the angle as a constraint), and back if less than a third of the
/// edge's length is won for the edges around. Twice over, as one fold's opening may be another's.
void openFoldsOfBlock(GuardedOperations& operations, const FoldOptions& options = {});

} // namespace surgicalmesher
