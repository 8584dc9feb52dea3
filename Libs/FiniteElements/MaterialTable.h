// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The table of tissues that have materials of their own.

#include "FiniteElementModel.h"

#include <set>

namespace surgicalmesher
{

/// Reads a CSV whose header row names its columns, in any order, upper or lower case, with or without blanks,
/// underscores and apostrophes ("Young's modulus"):
///
///     tissue         label or name (of `names`)
///     model          linear, neo-Hookean or empty (neo-Hookean): the law where tetrahedra are tagged nonlinear; the
///                    others are linear elastic with the same constants
///     youngsModulus  kPa, > 0
///     poissonsRatio  in (-1, 0.5)
///     density        kg/m^3, > 0; empty: 1000
///
/// Columns model and density may be left out. Lines that are empty or begin with # are skipped. Throws InputError with
/// file and line for anything else than that, a tissue that is not among `present`, one listed twice. Adds to `warnings` which
/// of `present` are left to the default, if any are.
std::map<Label, TissueMaterial> readMaterialTable(const std::string& file, const TissueTable& names,
                                                  const std::set<Label>& present,
                                                  std::vector<std::string>* warnings = nullptr);

} // namespace surgicalmesher
