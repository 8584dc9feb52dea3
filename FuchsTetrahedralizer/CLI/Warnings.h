// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Warnings of the volume stage, as sentences for the user.

#include "ConstitutiveTags.h"
#include "MeshIO.h"
#include "SizingFunction.h"

#include <cstdint>
#include <string>
#include <vector>

namespace surgicalmesher
{

/// Warns of targets outside the bounding box of the surface, and of paths with all their points outside.
std::vector<std::string> warningsOfPlaces(const ConstitutiveRule& rule, const SurfaceComplex& surface);

/// Warns if the target edge lengths that the surface carries are less than half or more than twice `length`, in the
/// median; empty otherwise, or if it carries none.
std::string warningOfLengths(const SurfaceFile& surface, const SizingFunction& length);

/// Warns if all tetrahedra of a mesh are null displacement; empty otherwise.
std::string warningOfStillness(const std::vector<std::int32_t>& constitutive);

} // namespace surgicalmesher
