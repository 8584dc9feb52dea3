// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Warnings of the surface stage, as sentences for the user.

#include "ScaleField.h"
#include "TissueFidelity.h"
#include "TissueMap.h"
#include "TissueSettings.h"

#include <string>
#include <vector>

namespace surgicalmesher
{

/// Warns if tissue requires shorter edges than the lattice can give; empty otherwise. `labelMap` names the map.
std::string warningOfShortLengths(const TissueMap& map, const ScaleField& scale, const std::string& labelMap);

/// Warns of groups whose members are not contiguous, and lists their pieces.
std::vector<std::string> warningsOfGroups(const TissueSelection& selection);

/// Warns where the surface is farther from the map than `bound` (mm), or the map from the surface; empty if nowhere.
/// `world` is the frame of the files; places in `fidelity` are in the map's own frame.
std::vector<std::string> warningsOfDistance(const std::map<Label, TissueFidelity>& fidelity, double bound,
                                            const Grid& world);

/// Warns of tissues of 27 or more voxels in `map` whose volume has changed by more than a quarter, the worst first;
/// empty if there are none.
std::string warningOfVolumes(const std::map<Label, TissueFidelity>& fidelity, const TissueMap& map);

} // namespace surgicalmesher
