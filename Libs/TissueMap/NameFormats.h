// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Formats of tissue tables whose columns or elements have names.

#include "TissueMap.h"

#include <functional>
#include <string>

namespace surgicalmesher
{

/// Receives one row: its place (FILE:LINE; FILE alone for XML), the label as in the file, and the tissue.
using TissueRow = std::function<void(const std::string& where, const std::string& label, const Tissue& tissue)>;

/// Reads Slicer's colour table (.csv: LabelValue, Name, Color_R, Color_G, Color_B, and columns of terminology codes) or
/// a BIDS look-up table (.tsv: index, name, color as #RRGGBB). Other columns are ignored. Throws InputError if the
/// first row does not name a column of labels and one of names.
void readNamedColumns(const std::string& file, const TissueRow& take);

/// Reads FSL's description of an atlas (.xml): <label index="0">name</label>. In a probabilistic atlas, whose
/// maximum-probability map has 0 for background, index N stands for voxel value N + 1. Throws InputError for other XML.
void readFslAtlas(const std::string& file, const TissueRow& take);

} // namespace surgicalmesher
