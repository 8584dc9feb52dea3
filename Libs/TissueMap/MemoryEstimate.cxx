// SPDX-License-Identifier: Apache-2.0
#include "MemoryEstimate.h"

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

constexpr double kBytes = 25e6, kBytesPerFace = 750, kBytesPerCube = 370, kBytesPerVoxel = 40;
constexpr double kRelativeSize = 0.8;       ///< of a cube to L
constexpr int kSmallest = -2, kLargest = 5; ///< powers of two of a cube's side, in voxels

/// Faces between voxels of different labels along one axis, and those of tissue at the map's ends.
std::size_t facesAcross(const TissueMap& map, int axis)
{
  const auto& size = map.grid.size;
  const std::array<std::size_t, 3> strides{ 1, std::size_t(size[0]), std::size_t(size[0]) * size[1] };
  std::size_t faces = 0;
  for (int k = 0; k < size[2]; ++k)
  {
    for (int j = 0; j < size[1]; ++j)
    {
      for (int i = 0; i < size[0]; ++i)
      {
        const std::array<int, 3> at{ i, j, k };
        const std::size_t n = map.grid.index(i, j, k);
        const Label label = map.labels[n];
        const bool isFirst = at[axis] == 0, isLast = at[axis] == size[axis] - 1;
        faces += isFirst ? label != 0 : label != map.labels[n - strides[axis]];
        faces += isLast && label != 0;
      }
    }
  }
  return faces;
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

} // namespace

std::uint64_t estimateSurfaceMemory(const TissueMap& map, const ScaleField& scale)
{
  const double voxel = map.grid.smallestSpacing();
  double faces = 0;
  for (int axis = 0; axis < 3; ++axis)
  {
    // A long voxel is cut into several cells, and its faces with it.
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    const double cells = std::round(map.grid.spacing[u] / voxel) * std::round(map.grid.spacing[v] / voxel);
    faces += cells * double(facesAcross(map, axis));
  }
  return std::uint64_t(kBytes + kBytesPerFace * faces + kBytesPerCube * countCubes(map, scale) +
                       kBytesPerVoxel * double(map.grid.voxelCount()));
}

void requireMemory(std::uint64_t needed, const std::optional<std::uint64_t>& available, const std::string& mapFile)
{
  if (!available || needed <= *available) return;
  throw InputError(mapFile + ": meshing this map at this scale takes about " + inGigabytes(needed) +
                   " of memory, found " + inGigabytes(*available) +
                   " available, expected more, or larger voxels or minimum edge length");
}

} // namespace surgicalmesher
