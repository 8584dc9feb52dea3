// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The table of tissues with materials of their own.

#include "FiniteElementModel.h"

#include <set>

namespace surgicalmesher
{

/// Reads a CSV file whose header row names its columns, in any order, in upper or lower case, with or without blanks,
/// underscores and apostrophes ("Young's modulus"):
///
///     tissue         label or name (of `names`)
///     model          linear, neo-Hookean or empty (neo-Hookean): the law where tetrahedra are tagged nonlinear; the
///                    others are linear elastic with the same constants
///     youngsModulus  kPa, > 0
///     poissonsRatio  in (-1, 0.5)
///     density        kg/m^3, > 0; empty: 1000
///
/// Columns model and density are optional. Empty lines and lines that begin with # are skipped. Throws InputError with
/// file and line for any violation of this format, for a tissue not in `present` and for a tissue listed twice. If
/// tissues in `present` have no row and so get the default material, a message naming them is appended to `warnings`.
std::map<Label, TissueMaterial> readMaterialTable(const std::string& file, const TissueTable& names,
                                                  const std::set<Label>& present,
                                                  std::vector<std::string>* warnings = nullptr);

} // namespace surgicalmesher
