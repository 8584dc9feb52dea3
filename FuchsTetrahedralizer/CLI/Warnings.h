// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What a run of the volume stage warns of: sentences for the user.

#include "ConstitutiveTags.h"
#include "SizingFunction.h"
#include "TetMesh.h"

#include <cstdint>
#include <string>
#include <vector>

namespace surgicalmesher
{

/// Targets and paths of which every point lies outside the box around the surface.
std::vector<std::string> warningsOfPlaces(const ConstitutiveRule& rule, const SurfaceComplex& surface);

/// That the median edge of the surface is less than half or more than twice as long (mm) as asked for; empty if not.
std::string warningOfLengths(const SurfaceComplex& surface, const SizingFunction& length);

/// That all tetrahedra of a mesh are null displacement; empty if they are not.
std::string warningOfStillness(const std::vector<std::int32_t>& constitutive);

} // namespace surgicalmesher
