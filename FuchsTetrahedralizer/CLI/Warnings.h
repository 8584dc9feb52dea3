// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Warnings of the volume stage, as sentences for the user.

#include "ConstitutiveTags.h"
#include "SizingFunction.h"
#include "TetMesh.h"

#include <cstdint>
#include <string>
#include <vector>

namespace surgicalmesher
{

/// Warns of targets outside the bounding box of the surface, and of paths with all their points outside.
std::vector<std::string> warningsOfPlaces(const ConstitutiveRule& rule, const SurfaceComplex& surface);

/// Warns if the median edge of the surface is less than half or more than twice its target length (mm); empty
/// otherwise.
std::string warningOfLengths(const SurfaceComplex& surface, const SizingFunction& length);

/// Warns if all tetrahedra of a mesh are null displacement; empty otherwise.
std::string warningOfStillness(const std::vector<std::int32_t>& constitutive);

} // namespace surgicalmesher
