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

/// All of a map and its scale that the memory which meshing takes depends on.
struct MeshingSize
{
  double faces = 0;   ///< of voxels between labels, those towards the outside included
  double samples = 0; ///< of these, what stands for them: 16 for a triangle of edge L
  /// What the complex begins with, long faces in several cells: where blocks of up to L / 4 stand for voxels
  /// (UniformBlocks.h), a face counts by the share of a block's that it is.
  double startingFaces = 0;
  double startingCubes = 0; ///< in tissue, of a power of two times the voxel and at most 0.8 L
  double tetrahedra = 0;    ///< in the end, those of the background around tissue included
  std::size_t voxels = 0;
  std::size_t lengths = 0; ///< of the scale
};

/// `hasBlocks`: as it is unless the surface stays on the voxels. With V the volume of tissue, A the area of voxel faces
/// between labels and B the part of it towards background, and L no less than voxels give,
///
///     tetrahedra = V / (0.12 L^3) + 6 A / L^2 + 7 B / L^2
///
/// Where tissues are thinner than L there are more (MeshSizeEstimate.h).
MeshingSize meshingSize(const TissueMap& map, const ScaleField& scale, bool hasBlocks = true);

/// Expected peak of the surface stage, bytes: as it begins or, where elements are about as small as voxels, when it is
/// done. With A the samples, F the startingFaces, K the cubes, T the tetrahedra, N the voxels, and S the lengths of the
/// scale,
///
///     bytes = 30 MB + 9.5 N + 16 S + max(230 A + 440 F + 370 K, 80 MB + 500 T)
///
/// The constants err on the safe side: Docs/Benchmarks.md#estimates.
std::uint64_t estimateSurfaceMemory(const MeshingSize& size);

/// The same of the stage that makes the tetrahedra of tissues:
///
///     bytes = 45 MB + 560 T
std::uint64_t estimateTetrahedralMemory(const MeshingSize& size);

/// What it takes to read a label map, in whose file labels have four bytes at most: more than meshing does where voxels
/// repeat often enough (RepeatedVoxels.h).
///
///     bytes = 30 MB + 6 N
std::uint64_t estimateReadingMemory(const Grid& grid);

/// Throws InputError, with the map's name and both figures, if less than `needed` bytes are available. Does nothing
/// where `available` is unknown (see availableMemory()).
void requireMemory(std::uint64_t needed, const std::optional<std::uint64_t>& available, const std::string& mapFile);

} // namespace surgicalmesher
