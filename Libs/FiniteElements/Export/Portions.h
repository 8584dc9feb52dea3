// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Element sets and shells divided by element shape, for formats whose parts have elements of a single shape.

#include "FiniteElementModel.h"

namespace surgicalmesher
{

/// The elements of one shape in a set, or the cells of one shape in a shell.
struct Portion
{
  std::string name, shape;            ///< shape: tet4, tet10, penta6 or hex8; of shells tri3, tri6 or quad4
  std::vector<std::int32_t> elements; ///< of the model; of shells, indices into their cells
};

/// Returns one portion per shape in the set or shell; if there are several shapes, the name is that of the set followed
/// by the shape.
std::vector<Portion> portionsOf(const FiniteElementModel& model, const ElementSet& set);
std::vector<Portion> portionsOf(const Shell& shell);

} // namespace surgicalmesher
