// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What pictures of surfaces and meshes show.

#include "MeshIO.h"
#include "Picture.h"

#include <functional>

namespace surgicalmesher
{

/// Colours by label: those of the table, or, where it has one for all, such that labels are told apart.
std::map<Label, Color> colorsOf(const std::vector<Label>& present, const TissueTable& tissues);

/// The triangles towards the outside, in the colours of the tissues behind them.
std::vector<Facet> outerFacets(const SurfaceFile& surface);

/// The faces of whole tetrahedra that `kept` says, where there is none of them beyond.
std::vector<Facet> facetsOf(const MeshFile& content, const std::function<bool(std::size_t tetrahedron)>& kept);

/// The tetrahedra on the far side, for a viewer in the direction `towards`, of a plane across it through `place`; of
/// the middle of the mesh if the plane there leaves nothing or all.
std::vector<Facet> cutFacets(const MeshFile& content, const Vec3& place, const Vec3& towards);

/// The finer sub-meshes alone; empty if there is none.
std::vector<Facet> childFacets(const MeshFile& content);

// Towards the viewer, LPS.
constexpr Vec3 fromFront{ 0, -1, 0 };
constexpr Vec3 fromFrontLeftAbove{ 0.62, -0.68, 0.4 };

} // namespace surgicalmesher
