// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The order in which the voxels of every tissue map and scale volume are held, whatever the order of their source.

#include "Grid.h"

#include <array>
#include <cstddef>

namespace surgicalmesher
{

/// Whether the axes, of any length, are pairwise perpendicular: the cosines of their angles are below 1e-3.
bool arePerpendicular(const std::array<Vec3, 3>& axes);

/// The nearest orthonormal frame.
std::array<Vec3, 3> orthonormalised(std::array<Vec3, 3> axes);

/// A source's grid with its axes permuted and flipped to run along +L, +P, +S as nearly as they can, and how to walk
/// the source in that order: its voxel for (i, j, k) is first + i * stride[0] + j * stride[1] + k * stride[2].
struct CanonicalGrid
{
  Grid grid;
  std::ptrdiff_t first = 0;
  std::array<std::ptrdiff_t, 3> stride{ 0, 0, 0 };
};

/// `source`: size, spacing, origin and axes as the voxels lie in memory, in LPS; its axes may be left-handed.
CanonicalGrid canonicalGrid(const Grid& source);

} // namespace surgicalmesher
