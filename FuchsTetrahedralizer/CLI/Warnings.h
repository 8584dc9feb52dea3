// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What a run of the volume stage warns of: sentences for the user.

#include "ConstitutiveTags.h"
#include "MeshIO.h"
#include "SizingFunction.h"

#include <cstdint>
#include <string>
#include <vector>

namespace surgicalmesher
{

/// Targets and paths of which every point lies outside the box around the surface.
std::vector<std::string> warningsOfPlaces(const ConstitutiveRule& rule, const SurfaceComplex& surface);

/// That the surface's own target edge lengths are less than half or more than twice `length`, in the median; empty if
/// they are not, or if the surface has none.
std::string warningOfLengths(const SurfaceFile& surface, const SizingFunction& length);

/// That all tetrahedra of a mesh are null displacement; empty if they are not.
std::string warningOfStillness(const std::vector<std::int32_t>& constitutive);

} // namespace surgicalmesher
