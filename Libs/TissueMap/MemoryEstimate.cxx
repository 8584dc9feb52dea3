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

constexpr double kBytes = 30e6, kBytesPerVoxel = 9.5, kBytesPerLength = 16;
constexpr double kBytesPerSample = 230, kBytesPerStartingFace = 440,
                 kBytesPerCube = 370;                                      ///< at the beginning of the surface stage
constexpr double kBytesAtEnd = 80e6, kBytesPerTetrahedron = 500;           ///< at its end
constexpr double kBytesInTissues = 45e6, kBytesPerTissueTetrahedron = 560; ///< of the tetrahedral stage
constexpr double kTetrahedronVolume = 0.12, kTetrahedraPerArea = 6, kMorePerOuterArea = 7; ///< at unit edge
constexpr double kSamplesPerTriangle = 16, kTriangleArea = 0.433;                          ///< at unit edge
constexpr double kRelativeSize = 0.8;                                                      ///< of a cube's side to L
constexpr int kSmallest = -2, kLargest = 5; ///< powers of two of a cube's side, in voxels

/// The share of one voxel face in the face of a block, where blocks stand for voxels (UniformBlocks.h).
double shareOfFace(double length, double voxel)
{
  constexpr double relativeSize = 0.25; // of a block to L; 0.34 in the lattice, but the number of samples is the same
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

/// Number of lattice cells per voxel face, by axis: long voxels, and so their faces, are divided into several cells.
std::array<double, 3> cellsOfFaces(const Grid& grid)
{
  const double voxel = grid.smallestSpacing();
  std::array<double, 3> cells;
  for (int axis = 0; axis < 3; ++axis)
    cells[axis] = std::round(grid.spacing[(axis + 1) % 3] / voxel) * std::round(grid.spacing[(axis + 2) % 3] / voxel);
  return cells;
}

double areaOf(const Grid& grid, int axis) { return grid.spacing[(axis + 1) % 3] * grid.spacing[(axis + 2) % 3]; }

/// Edge length at a voxel, mm.
double lengthAt(const ScaleField& scale, const Grid& grid, const std::array<int, 3>& voxel)
{
  const Vec3 p = grid.gridToWorld(grid.position(voxel[0], voxel[1], voxel[2]));
  return std::max(scale(p), shortestLatticeLength(grid));
}

/// Adds the cubes and tetrahedra within tissue, estimated from a subset of the voxels, since L varies slowly.
void addFilled(const TissueMap& map, const ScaleField& scale, MeshingSize& size)
{
  constexpr std::size_t mostSamplesPerAxis = 64;
  const Grid& grid = map.grid;
  std::array<int, 3> step;
  for (int axis = 0; axis < 3; ++axis) step[axis] = int((grid.size[axis] - 1) / mostSamplesPerAxis) + 1;
  const double voxel = grid.smallestSpacing(), volume = grid.spacing.x * grid.spacing.y * grid.spacing.z;
  const double nearCubes = volume / (voxel * voxel * voxel); // per voxel
  double cubes = 0, tetrahedra = 0;
  for (int k = 0; k < grid.size[2]; k += step[2])
    for (int j = 0; j < grid.size[1]; j += step[1])
      for (int i = 0; i < grid.size[0]; i += step[0])
      {
        if (map.labels[grid.index(i, j, k)] == 0) continue;
        const double length = lengthAt(scale, grid, { i, j, k });
        cubes += nearCubes * cubesPerVoxel(length, voxel);
        tetrahedra += volume / (kTetrahedronVolume * std::pow(length, 3));
      }
  const double voxelsPerSample = double(step[0]) * step[1] * step[2];
  size.startingCubes = voxelsPerSample * cubes;
  size.tetrahedra = voxelsPerSample * tetrahedra;
}

/// Contribution of the faces of a slice.
struct Faces
{
  double all = 0, samples = 0, starting = 0, tetrahedra = 0;
  Faces& operator+=(const Faces& more)
  {
    all += more.all;
    samples += more.samples;
    starting += more.starting;
    tetrahedra += more.tetrahedra;
    return *this;
  }
};

void addInterface(const TissueMap& map, const ScaleField& scale, bool hasBlocks, MeshingSize& size)
{
  const Grid& grid = map.grid;
  const double voxel = grid.smallestSpacing();
  const std::array<double, 3> cells = cellsOfFaces(grid);
  const bool mayHaveBlocks = hasBlocks && std::max({ cells[0], cells[1], cells[2] }) == 1;
  const auto add = [&](const VoxelFace& face, Faces& faces)
  {
    const double length = lengthAt(scale, grid, voxelInside(grid, face));
    const double area = areaOf(grid, face.axis) / (length * length);
    const bool isOuter = labelAt(map, face.lower) == 0 || labelAt(map, face.upper()) == 0;
    faces.all += 1;
    faces.samples += std::min(1.0, kSamplesPerTriangle / kTriangleArea * area);
    faces.starting += cells[face.axis] * (mayHaveBlocks ? shareOfFace(length, voxel) : 1);
    faces.tetrahedra += (kTetrahedraPerArea + (isOuter ? kMorePerOuterArea : 0)) * area;
  };
  const auto ofSlice = [&](int k)
  {
    Faces faces;
    forEachBoundaryFace(map, k, [&](const VoxelFace& face) { add(face, faces); });
    return faces;
  };
  const Faces faces = sumOverBoundarySlices<Faces>(map, ofSlice);
  size.faces = faces.all;
  size.samples = faces.samples;
  size.startingFaces = faces.starting;
  size.tetrahedra += faces.tetrahedra;
}

std::string inGigabytes(std::uint64_t bytes)
{
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text << std::fixed << std::setprecision(1) << double(bytes) / 1e9 << " GB";
  return text.str();
}

} // namespace

MeshingSize meshingSize(const TissueMap& map, const ScaleField& scale, bool hasBlocks)
{
  MeshingSize size;
  size.voxels = map.grid.voxelCount();
  size.lengths = scale.lengths.size();
  addFilled(map, scale, size);
  addInterface(map, scale, hasBlocks, size);
  return size;
}

std::uint64_t estimateSurfaceMemory(const MeshingSize& size)
{
  const double start =
    kBytesPerSample * size.samples + kBytesPerStartingFace * size.startingFaces + kBytesPerCube * size.startingCubes;
  const double end = kBytesAtEnd + kBytesPerTetrahedron * size.tetrahedra;
  return std::uint64_t(kBytes + kBytesPerVoxel * double(size.voxels) + kBytesPerLength * double(size.lengths) +
                       std::max(start, end));
}

std::uint64_t estimateTetrahedralMemory(const MeshingSize& size)
{
  return std::uint64_t(kBytesInTissues + kBytesPerTissueTetrahedron * size.tetrahedra);
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
