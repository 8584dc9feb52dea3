// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Offsets of tissue boundaries along their normals, each tissue by its own distance.

#include "GuardedOperations.h"
#include "TetQuality.h"
#include "VolumeOffsets.h"

namespace surgicalmesher
{

/// An interface face with an orientation, from one of its labels to the other.
struct SheetSide
{
  Label from, to;
  Vec3 area; ///< area vector, mm^2, pointing from `from` to `to`
};
SheetSide sideOf(const TetComplex& complex, const SheetFace& face);

/// Returns the step (mm) that takes a vertex to where the offset boundaries of the tissues in its `sheet` meet, by
/// least squares.
Vec3 meetingStep(const TetComplex& complex, const Sheet& sheet, const TissueOffsets& offsets);

/// Moves v by `way` (mm), or by a half or a quarter of it: the longest of these that the guards allow and that leaves
/// the worst quality at v at `floor` or above. Returns whether v has moved.
bool moveAlong(GuardedOperations& operations, std::int32_t v, const Vec3& way, double floor);

struct TissueOffsetOptions
{
  TissueOffsets offsets;
  double goodAngle = usualAngle; ///< degrees; the worst angle at a vertex may fall to this
};

/// Moves the unlocked interface vertices so that the tissues' boundaries are offset as `options` say.
void offsetTissuesOfBlock(GuardedOperations& operations, const TissueOffsetOptions& options);

} // namespace surgicalmesher
