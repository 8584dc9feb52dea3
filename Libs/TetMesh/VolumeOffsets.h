// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Offsets of tissues' boundaries that give back volumes.

#include "TissueMap.h"

#include <map>
#include <utility>

namespace surgicalmesher
{

/// How far (mm) the boundary of each tissue goes outwards; that between two tissues goes by the difference. Nothing said
/// of a tissue is no way at all.
using TissueOffsets = std::map<Label, double>;

/// How far each tissue's whole boundary has to go outwards for the volume that it is lacking (negative: has too much),
/// `most` at most. A face between two tissues moves by the difference of theirs, towards the background by its own
/// tissue's: `areas` by the labels on both sides, each pair once. In one unit of length.
TissueOffsets offsetsForVolumes(const std::map<Label, double>& lacking,
                                const std::map<std::pair<Label, Label>, double>& areas, double most);

} // namespace surgicalmesher
