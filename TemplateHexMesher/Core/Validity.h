// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Whether a mesh has an invalid element, and what is said then.

#include "ElementMesh.h"

#include <string>

namespace surgicalmesher
{

/// Elements with a corner whose scaled Jacobian is not positive, and the worst of all.
struct Validity
{
  std::size_t invalid = 0;
  std::size_t worst = 0;
  double minimum = 2;
};

Validity validityOf(const std::vector<Element>& elements, const Points& points);

/// Throws EngineError with the worst element's place; `question` hints at what may be wrong.
[[noreturn]] void refuseInvalid(const ElementMesh& mesh, const Validity& validity, int rounds,
                                const std::string& question);

} // namespace surgicalmesher
