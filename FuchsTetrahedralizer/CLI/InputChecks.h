// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What the volume stage refuses or warns of before it begins.

#include "ConstitutiveTags.h"
#include "FiniteElementModel.h"
#include "SizingFunction.h"
#include "TetMesh.h"

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace surgicalmesher
{

/// Throws InputError if a surface from elsewhere is smaller than one of its edges is to be: its coordinates are hardly
/// millimetres, and the mesh would be a flat tetrahedron.
void requireMillimetres(const SurfaceComplex& surface, const SizingFunction& edgeLength, const std::string& name);

/// Tetrahedra that fill the closed surfaces of all tissues: a regular tetrahedron's worth of volume each, with the edge
/// lengths asked for over the bounding box.
double estimateTetrahedra(const SurfaceComplex& surface, const SizingFunction& edgeLength);

/// Throws InputError, with both estimates, if that many tetrahedra do not fit into `available` bytes.
void requireMemoryFor(double tetrahedra, const std::optional<std::uint64_t>& available, const std::string& name);

/// Targets and paths of which every point lies outside the box around the surface.
std::vector<std::string> warningsOfPlaces(const ConstitutiveRule& rule, const SurfaceComplex& surface);

/// That all tetrahedra of a mesh are null displacement; empty if they are not.
std::string warningOfStillness(const std::vector<std::int32_t>& constitutive);

/// The tissues without a material of their own; empty if there is none.
std::string warningOfMaterials(const FiniteElementOptions& options, const std::set<Label>& present,
                               const TissueTable& names, const std::string& file);

} // namespace surgicalmesher
