// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The boundaries of tissues, each offset by a way of its own.

#include "GuardedOperations.h"
#include "TetQuality.h"
#include "VolumeOffsets.h"

namespace surgicalmesher
{

/// A face at a vertex, seen from one of its labels.
struct SheetSide
{
  Label from, to;
  Vec3 area; ///< vector, mm^2, from the one to the other
};
SheetSide sideOf(const TetComplex& complex, const SheetFace& face);

/// The step (mm) of a vertex to where the tissues' boundaries in its `sheet` meet when they are offset: least squares.
Vec3 meetingStep(const TetComplex& complex, const Sheet& sheet, const TissueOffsets& offsets);

/// Moves v by the way (mm), a half or a quarter of it: the longest that the guards let pass and that leaves the worst
/// quality at v at `floor` or above.
bool moveAlong(GuardedOperations& operations, std::int32_t v, const Vec3& way, double floor);

struct TissueOffsetOptions
{
  TissueOffsets offsets;
  double goodAngle = usualAngle; ///< degrees; the worst angle at a vertex may fall to this
};

/// Moves the vertices between labels by what the offsets of their tissues ask for.
void offsetTissuesOfBlock(GuardedOperations& operations, const TissueOffsetOptions& options);

} // namespace surgicalmesher
