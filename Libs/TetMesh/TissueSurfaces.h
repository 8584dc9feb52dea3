// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The closed surface of each tissue, taken out of the complex that they share.

#include "MeshIO.h"

#include <map>
#include <optional>

namespace surgicalmesher
{

/// Returns, for each tissue, the triangles that have it on one side, oriented so that it is behind their normals, and
/// their points. Faces between two tissues are in the surfaces of both. BoundaryDistance is left out, as its sign
/// refers to the complex.
std::map<Label, SurfaceFile> tissueSurfaces(const SurfaceFile& content);

/// Detects a surface of one tissue alone, as tissueSurfaces() extracts it: the tissue is behind all normals, and the
/// surfaces of its neighbours are not in the file, or not all of them completely. Then sets the labels in front to
/// outside, 0, and returns the tissue. Otherwise returns nothing and changes nothing.
std::optional<Label> leaveNeighboursOut(SurfaceComplex& surface);

/// The text of a multi-block file (.vtm) that refers to one file per tissue, by their names as `files` has them, and
/// names each block after its tissue.
std::string multiBlockIndex(const std::map<Label, std::string>& files, const TissueTable& tissues);

} // namespace surgicalmesher
