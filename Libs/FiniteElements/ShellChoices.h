// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Tissues that become shells, parsed from user input.

#include "FiniteElementModel.h"

#include <set>

namespace surgicalmesher
{

/// Parses texts of the form TISSUE or TISSUE:NEIGHBOUR, or several of these separated by commas. A tissue is a label or
/// a name (of `names`) among `present`; a neighbour may also be `outside` or 0. Without any text, returns the tissues
/// that `names` marks as shells. Throws UsageError for any other text. `thickness` in mm.
std::vector<ShellChoice> shellChoices(const std::vector<std::string>& texts, const TissueTable& names,
                                      const std::set<Label>& present, double thickness);

} // namespace surgicalmesher
