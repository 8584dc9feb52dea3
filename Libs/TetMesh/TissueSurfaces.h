// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The closed surface of each tissue, taken out of the complex that they share.

#include "MeshIO.h"

#include <map>
#include <optional>

namespace surgicalmesher
{

/// Per tissue, the triangles that have it on one side, turned so that it is behind their normals, and their points.
/// Faces between two tissues are in the surfaces of both. BoundaryDistance, whose sign is the complex's, is left out.
std::map<Label, SurfaceFile> tissueSurfaces(const SurfaceFile& content);

/// The tissue that `surface` is the surface of alone, as tissueSurfaces takes it out: it is behind all normals, and
/// what is in front is not in the file, or only in part. Its neighbours then become outside, 0. Otherwise none, and
/// nothing changes.
std::optional<Label> leaveNeighboursOut(SurfaceComplex& surface);

/// The text of a multi-block file (.vtm) that refers to one file per tissue, by their names as `files` has them, and
/// names each block after its tissue.
std::string multiBlockIndex(const std::map<Label, std::string>& files, const TissueTable& tissues);

} // namespace surgicalmesher
