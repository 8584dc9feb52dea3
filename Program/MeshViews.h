// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Facets of surfaces and meshes for pictures.

#include "MeshIO.h"
#include "Picture.h"

#include <functional>

namespace surgicalmesher
{

/// Returns the colours by label: those of the table, or, if the table has the same colour for all, distinct ones.
std::map<Label, Color> colorsOf(const std::vector<Label>& present, const TissueTable& tissues);

/// Returns the triangles that border on the outside, in the colours of the tissues behind them.
std::vector<Facet> outerFacets(const SurfaceFile& surface);

/// Returns the faces of the tetrahedra with kept(tetrahedron) that no other kept tetrahedron shares.
std::vector<Facet> facetsOf(const MeshFile& content, const std::function<bool(std::size_t tetrahedron)>& kept);

/// Returns the facets of the tetrahedra behind a plane, as seen from the direction `towards`. The plane is
/// perpendicular to `towards` and passes through `place`, or through the middle of the mesh if all tetrahedra would be
/// on one side.
std::vector<Facet> cutFacets(const MeshFile& content, const Vec3& place, const Vec3& towards);

/// Returns the facets of the finer sub-meshes only; empty if there is none.
std::vector<Facet> childFacets(const MeshFile& content);

// Directions towards the viewer, LPS.
constexpr Vec3 fromFront{ 0, -1, 0 };
constexpr Vec3 fromFrontLeftAbove{ 0.62, -0.68, 0.4 };

} // namespace surgicalmesher
