// SPDX-License-Identifier: Apache-2.0
#pragma once
/// How much memory meshing a map will take, before it is meshed: better refused at once than ended by the system later.

#include "ScaleField.h"
#include "TissueMap.h"

#include <cstdint>
#include <optional>
#include <string>

namespace surgicalmesher
{

/// Voxel faces between labels (those towards the outside included) that the complex begins with. With `hasBlocks`, as it
/// is by default, blocks of up to L / 4 stand for voxels (UniformBlocks.h), and a face counts by the share of a block's
/// that it is.
double startingFaces(const TissueMap& map, const ScaleField& scale, bool hasBlocks = true);

/// Expected peak of the surface stage, bytes. The complex begins as cubes of a power of two times the voxel and at most
/// 0.8 L, of voxels or blocks of them where tissues meet; nothing later is as large. With F the startingFaces, K the
/// number of these cubes in tissue, N the voxels, and S the lengths of the scale,
///
///     bytes = 25 MB + 640 F + 370 K + 9.5 N + 16 S
///
/// The constants err on the safe side: Docs/Benchmarks.md#estimates.
std::uint64_t estimateSurfaceMemory(const TissueMap& map, const ScaleField& scale, double startingFaces);

/// What it takes to read a label map, in whose file labels have four bytes at most: more than meshing does where voxels
/// repeat often enough (RepeatedVoxels.h).
///
///     bytes = 25 MB + 6 N
std::uint64_t estimateReadingMemory(const Grid& grid);

/// Throws InputError, with the map's name and both figures, if less than `needed` bytes are available. Does nothing
/// where `available` is unknown (see availableMemory()).
void requireMemory(std::uint64_t needed, const std::optional<std::uint64_t>& available, const std::string& mapFile);

} // namespace surgicalmesher
