// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Check for invalid elements, and the error they cause.

#include "ElementMesh.h"

#include <string>

namespace surgicalmesher
{

/// The number of elements with a corner whose scaled Jacobian is not positive, and the worst element.
struct Validity
{
  std::size_t invalid = 0;
  std::size_t worst = 0;
  double minimum = 2;
};

Validity validityOf(const std::vector<Element>& elements, const Points& points);

/// Throws EngineError with the position of the worst element; `question` hints at a possible cause.
[[noreturn]] void refuseInvalid(const ElementMesh& mesh, const Validity& validity, int rounds,
                                const std::string& question);

} // namespace surgicalmesher
