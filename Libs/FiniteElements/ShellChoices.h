// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Which tissues become shells, from what a user typed.

#include "FiniteElementModel.h"

#include <set>

namespace surgicalmesher
{

/// Each text is TISSUE or TISSUE:NEIGHBOUR, or several of these separated by commas; a tissue is a label or a name (of
/// `names`) among `present`, a neighbour also `outside` or 0. Without any text, the tissues that `names` marks as
/// shells. Throws UsageError for anything else.
std::vector<ShellChoice> shellChoices(const std::vector<std::string>& texts, const TissueTable& names,
                                      const std::set<Label>& present, double thickness);

} // namespace surgicalmesher
