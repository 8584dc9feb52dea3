// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Formats of tissue tables whose columns or elements have names.

#include "TissueMap.h"

#include <functional>
#include <string>

namespace surgicalmesher
{

/// Takes one row: where it stands (FILE:LINE), the label as the file has it, the tissue.
using TissueRow = std::function<void(const std::string& where, const std::string& label, const Tissue& tissue)>;

/// Slicer's colour table (.csv: LabelValue, Name, Color_R, Color_G, Color_B, and what terminologies call the tissue)
/// and a BIDS look-up table (.tsv: index, name, color as #RRGGBB). Other columns don't count. Throws InputError where
/// the first row does not name a column of labels and one of names.
void readNamedColumns(const std::string& file, const TissueRow& take);

/// FSL's description of an atlas (.xml): <label index="0">name</label>. Of a probabilistic atlas, whose
/// maximum-probability map has 0 for background, label N is voxel value N + 1. Throws InputError for other XML.
void readFslAtlas(const std::string& file, const TissueRow& take);

} // namespace surgicalmesher
