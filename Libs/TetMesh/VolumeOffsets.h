// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Offsets of tissue boundaries that restore volumes.

#include "TissueMap.h"

#include <map>
#include <utility>

namespace surgicalmesher
{

/// Distance (mm) by which the boundary of each tissue moves outwards; the boundary between two tissues moves by the
/// difference. Tissues without an entry have the offset 0.
using TissueOffsets = std::map<Label, double>;

/// Returns the distance by which the whole boundary of each tissue has to move outwards to gain the volume that it
/// lacks (`lacking`; negative: it has too much), limited to [-most, most]. A face between two tissues moves by the
/// difference of their offsets, a face towards the background by the offset of its tissue. `areas`: by the labels on
/// both sides, each pair once. All in one unit of length.
TissueOffsets offsetsForVolumes(const std::map<Label, double>& lacking,
                                const std::map<std::pair<Label, Label>, double>& areas, double most);

} // namespace surgicalmesher
