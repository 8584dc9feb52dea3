// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The table of tissues that have edge lengths of their own.

#include "SurgicalScale.h"

#include <string>

namespace surgicalmesher
{

/// Reads a CSV whose header row names its columns: `label` (or `name`: a label or a name of `names`), `minimum`,
/// `maximum`, `factor`, in any order, the last three optional. An empty field means the general value: `range`, and
/// factor 1. Lines that are empty or begin with # are skipped. Throws InputError with file and line for anything else
/// than that, values that are not finite and positive, a minimum above the maximum, an unknown name, a tissue listed
/// twice.
std::map<Label, TissueLength> readTissueLengths(const std::string& file, const LengthRange& range,
                                                const TissueTable& names);

} // namespace surgicalmesher
