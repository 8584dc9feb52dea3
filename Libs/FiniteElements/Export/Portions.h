// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Element sets in formats whose parts have elements of one shape.

#include "FiniteElementModel.h"

namespace surgicalmesher
{

/// A set's elements of one shape, and what they are called.
struct Portion
{
  std::string name, shape; ///< tet4, tet10, penta6 or hex8
  std::vector<std::int32_t> elements;
};

/// One for each shape in the set, whose name has the shape's at its end if there are several.
std::vector<Portion> portionsOf(const FiniteElementModel& model, const ElementSet& set);

} // namespace surgicalmesher
