// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Opens folds of the interface of a little more than a right angle to a little less, where the interface hardly has to
/// leave the boundary for that.

#include "GuardedOperations.h"
#include "TetQuality.h"

namespace surgicalmesher
{

struct FoldOptions
{
  double goodAngle = usualAngle; ///< degrees; a move may lower the worst angle at its vertex to this
  double from = 0;               ///< mm; vertices with smaller target lengths stay
};

/// Opens folds (Folds.h) of less than 128 degrees. The four vertices of a hinge move together, by the steps against
/// which their samples resist least (least squares with the angle as a constraint). The moves are undone unless they
/// reduce the folded length around these vertices by 0.3 of the edge's length. Makes two rounds, because opening one
/// fold may help to open another.
void openFoldsOfBlock(GuardedOperations& operations, const FoldOptions& options = {});

} // namespace surgicalmesher
