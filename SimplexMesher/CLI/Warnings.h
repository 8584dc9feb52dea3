// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What a run of the surface stage warns of: sentences for the user.

#include "ScaleField.h"
#include "TissueFidelity.h"
#include "TissueMap.h"
#include "TissueSettings.h"

#include <string>
#include <vector>

namespace surgicalmesher
{

/// That tissue asks for shorter edges than the lattice gives; empty if it does not. `labelMap` names the map.
std::string warningOfShortLengths(const TissueMap& map, const ScaleField& scale, const std::string& labelMap);

/// Groups whose members are not contiguous, with their pieces.
std::vector<std::string> warningsOfGroups(const TissueSelection& selection);

/// Where the surface is farther from the map than `bound` (mm), from either side; empty if it is nowhere. `world` is
/// the frame of the files, the fidelity's places are in the map's own.
std::vector<std::string> warningsOfDistance(const std::map<Label, TissueFidelity>& fidelity, double bound,
                                            const Grid& world);

/// Tissues of 27 voxels or more that have lost or gained over a quarter of their volume in `map`, the worst first; empty if
/// none has.
std::string warningOfVolumes(const std::map<Label, TissueFidelity>& fidelity, const TissueMap& map);

} // namespace surgicalmesher
