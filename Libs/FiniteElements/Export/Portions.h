// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Element sets divided by element shape, for formats whose parts have elements of a single shape.

#include "FiniteElementModel.h"

namespace surgicalmesher
{

/// The elements of one shape in a set.
struct Portion
{
  std::string name, shape; ///< shape: tet4, tet10, penta6 or hex8
  std::vector<std::int32_t> elements;
};

/// Returns one portion per shape in the set; if there are several shapes, the name is that of the set followed by the
/// shape.
std::vector<Portion> portionsOf(const FiniteElementModel& model, const ElementSet& set);

} // namespace surgicalmesher
