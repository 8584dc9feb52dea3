// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The table of tissues with edge lengths of their own.

#include "SurgicalScale.h"

#include <string>

namespace surgicalmesher
{

/// Reads a CSV file whose header row names its columns: `label` (or `name`: a label or a name of `names`), `minimum`,
/// `maximum` and `factor`, in any order, the last three optional. An empty field stands for the general value: `range`,
/// and a factor of 1. Empty lines and lines that begin with # are skipped. Throws InputError with file and line for any
/// violation of this format, values that are not finite and positive, a minimum above the maximum, an unknown name, and
/// a tissue listed twice.
std::map<Label, TissueLength> readTissueLengths(const std::string& file, const LengthRange& range,
                                                const TissueTable& names);

} // namespace surgicalmesher
