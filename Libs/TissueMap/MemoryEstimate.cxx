// SPDX-License-Identifier: Apache-2.0
#include "MemoryEstimate.h"

#include "BoundaryFaces.h"
#include "Errors.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <locale>
#include <sstream>

namespace surgicalmesher
{
namespace
{

constexpr double kBytes = 25e6, kBytesPerFace = 640, kBytesPerCube = 370, kBytesPerVoxel = 9.5, kBytesPerLength = 16;
constexpr double kRelativeSize = 0.8;       ///< of a cube to L
constexpr int kSmallest = -2, kLargest = 5; ///< powers of two of a cube's side, in voxels

/// What a voxel face counts where blocks of voxels stand for them (UniformBlocks.h).
double shareOfFace(double length, double voxel)
{
  constexpr double relativeSize = 0.25; // of a block to L; 0.34 in the lattice, but samples are as many then
  constexpr int largest = 8;            // voxels
  int side = 1;
  while (side < largest && 2 * side * voxel <= relativeSize * length) side *= 2;
  return 1.0 / (side * side);
}

/// Cubes per voxel where the target edge length is `length`.
double cubesPerVoxel(double length, double voxel)
{
  const double power = std::floor(std::log2(kRelativeSize * length / voxel));
  return std::pow(8.0, -std::clamp(power, double(kSmallest), double(kLargest)));
}

/// Cubes in tissue, from a voxel in every few: L varies slowly.
double countCubes(const TissueMap& map, const ScaleField& scale)
{
  constexpr std::size_t mostSamplesPerAxis = 64;
  const Grid& grid = map.grid;
  std::array<int, 3> step;
  for (int axis = 0; axis < 3; ++axis) step[axis] = int((grid.size[axis] - 1) / mostSamplesPerAxis) + 1;
  const double voxel = grid.smallestSpacing();
  const double nearCubes = grid.spacing.x * grid.spacing.y * grid.spacing.z / (voxel * voxel * voxel); // per voxel
  double cubes = 0;
  for (int k = 0; k < grid.size[2]; k += step[2])
  {
    for (int j = 0; j < grid.size[1]; j += step[1])
    {
      for (int i = 0; i < grid.size[0]; i += step[0])
      {
        if (map.labels[grid.index(i, j, k)] == 0) continue;
        const Vec3 p{ i * grid.spacing.x, j * grid.spacing.y, k * grid.spacing.z };
        cubes += nearCubes * cubesPerVoxel(scale(grid.gridToWorld(p)), voxel);
      }
    }
  }
  return cubes * step[0] * step[1] * step[2];
}

std::string inGigabytes(std::uint64_t bytes)
{
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text << std::fixed << std::setprecision(1) << double(bytes) / 1e9 << " GB";
  return text.str();
}

/// A long voxel is cut into several cells, and its faces with it.
std::array<double, 3> cellsOfFaces(const Grid& grid)
{
  const double voxel = grid.smallestSpacing();
  std::array<double, 3> cells;
  for (int axis = 0; axis < 3; ++axis)
    cells[axis] = std::round(grid.spacing[(axis + 1) % 3] / voxel) * std::round(grid.spacing[(axis + 2) % 3] / voxel);
  return cells;
}

} // namespace

double startingFaces(const TissueMap& map, const ScaleField& scale, bool hasBlocks)
{
  const Grid& grid = map.grid;
  const double voxel = grid.smallestSpacing();
  const std::array<double, 3> cells = cellsOfFaces(grid);
  const bool mayHaveBlocks = hasBlocks && std::max({ cells[0], cells[1], cells[2] }) == 1;
  const auto share = [&](const VoxelFace& face)
  {
    if (!mayHaveBlocks) return 1.0;
    const auto [i, j, k] = voxelInside(grid, face);
    return shareOfFace(scale(grid.gridToWorld(grid.position(i, j, k))), voxel);
  };
  return sumOverBoundarySlices<double>(
    map,
    [&](int k)
    {
      double faces = 0;
      forEachBoundaryFace(map, k, [&](const VoxelFace& face) { faces += cells[face.axis] * share(face); });
      return faces;
    });
}

std::uint64_t estimateSurfaceMemory(const TissueMap& map, const ScaleField& scale, double startingFaces)
{
  return std::uint64_t(kBytes + kBytesPerFace * startingFaces + kBytesPerCube * countCubes(map, scale) +
                       kBytesPerVoxel * double(map.grid.voxelCount()) + kBytesPerLength * double(scale.lengths.size()));
}

std::uint64_t estimateReadingMemory(const Grid& grid)
{
  constexpr std::size_t inFile = 4, held = sizeof(Label);
  return std::uint64_t(kBytes) + (inFile + held) * grid.voxelCount();
}

void requireMemory(std::uint64_t needed, const std::optional<std::uint64_t>& available, const std::string& mapFile)
{
  if (!available || needed <= *available) return;
  throw InputError(mapFile + ": meshing this map at this scale takes about " + inGigabytes(needed) +
                   " of memory, found " + inGigabytes(*available) +
                   " available, expected more, or larger voxels or minimum edge length");
}

} // namespace surgicalmesher
