// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Estimates of the memory that meshing a map takes: a run that needs too much is refused at the start instead of being
/// killed by the system later.

#include "ScaleField.h"
#include "TissueMap.h"

#include <cstdint>
#include <optional>
#include <string>

namespace surgicalmesher
{

/// The figures of a map and its scale that determine the memory of meshing.
struct MeshingSize
{
  double faces = 0;   ///< voxel faces between labels, including those towards the outside
  double samples = 0; ///< samples of these faces: at most one each, and 16 per triangle of edge L
  /// Faces of the lattice cells at the start, of which a long voxel face has several. Where blocks of side up to L / 4
  /// stand for voxels (UniformBlocks.h), a voxel face counts as its share of the block's face.
  double startingFaces = 0;
  double startingCubes = 0; ///< cubes in tissue, of side a power of two times the voxel and at most 0.8 L
  double tetrahedra = 0;    ///< final number, including the background around tissue
  std::size_t voxels = 0;
  std::size_t lengths = 0; ///< number of lengths of the scale
};

/// Returns the figures of a map. `hasBlocks`: whether blocks are made uniform (UniformBlocks.h), as they are unless the
/// surface stays on the voxels. With V the volume of tissue, A the area of voxel faces between labels, B the part of A
/// towards background, and L at least shortestLatticeLength(),
///
///     tetrahedra = V / (0.12 L^3) + 6 A / L^2 + 7 B / L^2
///
/// Where tissues are thinner than L, there are more tetrahedra (MeshSizeEstimate.h).
MeshingSize meshingSize(const TissueMap& map, const ScaleField& scale, bool hasBlocks = true);

/// Returns the expected peak of the surface stage, bytes. It is reached at the beginning or, where elements are about
/// as small as voxels, at the end. With A the samples, F the startingFaces, K the startingCubes, T the tetrahedra, N
/// the voxels, and S the lengths of the scale,
///
///     bytes = 30 MB + 9.5 N + 16 S + max(230 A + 440 F + 370 K, 80 MB + 500 T)
///
/// The constants err on the safe side: Docs/Benchmarks.md#estimates.
std::uint64_t estimateSurfaceMemory(const MeshingSize& size);

/// Returns the same for the stage that fills the tissues with tetrahedra:
///
///     bytes = 45 MB + 560 T
std::uint64_t estimateTetrahedralMemory(const MeshingSize& size);

/// Returns the memory that reading a label map takes, whose labels have at most four bytes in the file. It is more than
/// meshing takes where voxels repeat often enough (RepeatedVoxels.h).
///
///     bytes = 30 MB + 6 N
std::uint64_t estimateReadingMemory(const Grid& grid);

/// Throws InputError, with the map's name and both figures, if less than `needed` bytes are available. Does nothing
/// where `available` is unknown (see availableMemory()).
void requireMemory(std::uint64_t needed, const std::optional<std::uint64_t>& available, const std::string& mapFile);

} // namespace surgicalmesher
