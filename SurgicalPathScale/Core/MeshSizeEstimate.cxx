// SPDX-License-Identifier: Apache-2.0
#include "MeshSizeEstimate.h"

#include "BoundaryFaces.h"

#include <algorithm>
#include <cmath>

namespace surgicalmesher
{

namespace
{

// Constants of the model, fitted to the project's meshes of the maps in Docs/Benchmarks.md#estimates.
/// c: mean volume at unit edge length; regular tetrahedra have 0.118, BCC ones 0.110.
constexpr double tetrahedronVolume = 0.12;
constexpr double tetrahedraPerTriangle = 0.95; ///< b
/// s: edge length of interface triangles at unit edge length, shorter than inside.
constexpr double surfaceEdge = 0.83;
/// Area of the smooth interface per area of voxel faces, mean over directions.
constexpr double smoothArea = 2.0 / 3.0;
constexpr double edgePerThickness = 1.4; ///< longest edge length in a tissue of unit thickness 4 V / A
constexpr double blockSide = 4;          ///< mm; thickness is measured over 3 x 3 x 3 blocks

/// Volume and boundary area of a tissue in a block.
struct Share
{
  Label label;
  double volume; ///< mm^3
  double area;   ///< mm^2 of smooth boundary
};

using Index = std::array<int, 3>;
using Shares = std::vector<Share>; ///< of one block

/// The map divided into blocks with sides of about 4 mm.
class Blocks
{
public:
  explicit Blocks(const TissueMap& map) : m_Grid(map.grid)
  {
    const Vec3& spacing = map.grid.spacing;
    for (int axis = 0; axis < 3; ++axis)
    {
      m_Side[axis] = std::max(1, int(std::lround(blockSide / spacing[axis])));
      m_Size[axis] = (map.grid.size[axis] + m_Side[axis] - 1) / m_Side[axis];
      m_FaceArea[axis] = smoothArea * spacing[(axis + 1) % 3] * spacing[(axis + 2) % 3];
    }
    m_VoxelVolume = spacing.x * spacing.y * spacing.z;
  }

  const Index& size() const { return m_Size; }
  const Index& side() const { return m_Side; } ///< voxels
  std::size_t perLayer() const { return std::size_t(m_Size[0]) * m_Size[1]; }
  double voxelVolume() const { return m_VoxelVolume; }
  double faceArea(int axis) const { return m_FaceArea[axis]; }

  /// Returns the first voxel of a block along an axis, and the one after its last.
  int begin(int block, int axis) const { return block * m_Side[axis]; }
  int end(int block, int axis) const { return std::min((block + 1) * m_Side[axis], m_Grid.size[axis]); }

  /// Returns the index, within its layer, of the block that contains a voxel.
  std::size_t inLayer(const Index& voxel) const
  {
    return std::size_t(voxel[1] / m_Side[1]) * m_Size[0] + voxel[0] / m_Side[0];
  }

private:
  const Grid& m_Grid;
  Index m_Side;
  Index m_Size;
  std::array<double, 3> m_FaceArea;
  double m_VoxelVolume;
};

Share& shareOf(Shares& shares, Label label)
{
  for (Share& share : shares)
  {
    if (share.label == label) return share;
  }
  shares.push_back({ label, 0, 0 });
  return shares.back();
}

/// Adds the voxels of a layer of blocks to the volumes of their tissues.
void addVolumes(const TissueMap& map, const Blocks& blocks, int layer, Shares* shares)
{
  for (int k = blocks.begin(layer, 2); k < blocks.end(layer, 2); ++k)
    for (int j = 0; j < map.grid.size[1]; ++j)
      for (int i = 0; i < map.grid.size[0]; i += blocks.side()[0])
      {
        Shares& own = shares[blocks.inLayer({ i, j, k })];
        const Label *at = &map.labels[map.grid.index(0, j, k)] + i,
                    *end = at + std::min(blocks.side()[0], map.grid.size[0] - i);
        while (at != end)
        {
          const Label* const next = std::find_if(at, end, [at](Label label) { return label != *at; });
          shareOf(own, *at).volume += double(next - at) * blocks.voxelVolume();
          at = next;
        }
      }
}

/// Adds the faces of a layer of blocks to the areas of the tissues in it.
void addAreas(const TissueMap& map, const Blocks& blocks, int layer, Shares* shares)
{
  const int begin = blocks.begin(layer, 2), end = blocks.end(layer, 2);
  for (int k = begin - 1; k < end; ++k)
    forEachBoundaryFace(map, k,
                        [&](const VoxelFace& face)
                        {
                          for (const Index& voxel : { face.lower, face.upper() })
                            if (voxel[2] >= begin && voxel[2] < end && isInside(map.grid, voxel))
                              shareOf(shares[blocks.inLayer(voxel)], labelAt(map, voxel)).area +=
                                blocks.faceArea(face.axis);
                        });
}

/// Returns the sums over a block and those around it.
Shares neighbourhood(const Blocks& blocks, const std::vector<Shares>& shares, std::size_t block)
{
  Shares sum;
  const Index& size = blocks.size();
  const auto [x, y, z] = Index{ int(block % size[0]), int(block / size[0] % size[1]), int(block / blocks.perLayer()) };
  for (int k = std::max(0, z - 1); k <= std::min(z + 1, size[2] - 1); ++k)
    for (int j = std::max(0, y - 1); j <= std::min(y + 1, size[1] - 1); ++j)
      for (int i = std::max(0, x - 1); i <= std::min(x + 1, size[0] - 1); ++i)
        for (const Share& share : shares[(std::size_t(k) * size[1] + j) * size[0] + i])
        {
          Share& total = shareOf(sum, share.label);
          total.volume += share.volume;
          total.area += share.area;
        }
  return sum;
}

/// Returns the longest edge that the thickness of the tissue allows; background outside the map allows any.
double longestEdge(const Shares& shares, Label label)
{
  for (const Share& share : shares)
  {
    if (share.label == label && share.area > 0) return edgePerThickness * 4 * share.volume / share.area;
  }
  return HUGE_VAL;
}

/// Returns the number of tetrahedra inside the tissues of a layer, sampled at a subset of the voxels where they are
/// small: L varies slowly.
double tetrahedraInside(const TissueMap& map, const ScaleField& scale, const Blocks& blocks, int layer,
                        const std::vector<Shares>& around)
{
  constexpr int samplesPerSide = 4; // of a block, per side
  Index step;
  for (int axis = 0; axis < 3; ++axis) step[axis] = std::max(1, blocks.side()[axis] / samplesPerSide);
  const Grid& grid = map.grid;
  double sum = 0;
  for (int k = blocks.begin(layer, 2) + step[2] / 2; k < blocks.end(layer, 2); k += step[2])
    for (int j = step[1] / 2; j < grid.size[1]; j += step[1])
      for (int i = step[0] / 2; i < grid.size[0]; i += step[0])
      {
        const Label label = map.labels[grid.index(i, j, k)];
        if (label == 0) continue;
        const double thickness = longestEdge(around[blocks.inLayer({ i, j, k })], label);
        const double edge = std::min(scale(grid.gridToWorld(grid.position(i, j, k))), thickness);
        sum += 1 / (edge * edge * edge);
      }
  return sum * step[0] * step[1] * step[2] * blocks.voxelVolume() / tetrahedronVolume;
}

/// Returns the number of triangles of the faces whose inner, or otherwise lower, voxel is in a layer.
double trianglesOf(const TissueMap& map, const ScaleField& scale, const Blocks& blocks, int layer,
                   const std::vector<Shares>& around)
{
  const Grid& grid = map.grid;
  double sum = 0;
  for (int k = layer == 0 ? -1 : blocks.begin(layer, 2); k < blocks.end(layer, 2); ++k)
    forEachBoundaryFace(map, k,
                        [&](const VoxelFace& face)
                        {
                          const Index voxel = voxelInside(grid, face);
                          const Shares& shares = around[blocks.inLayer(voxel)];
                          const double edge =
                            surfaceEdge *
                            std::min({ scale(grid.gridToWorld(grid.position(voxel[0], voxel[1], voxel[2]))),
                                       longestEdge(shares, labelAt(map, face.lower)),
                                       longestEdge(shares, labelAt(map, face.upper())) });
                          sum += blocks.faceArea(face.axis) / (std::sqrt(3.0) / 4 * edge * edge);
                        });
  return sum;
}

} // namespace

MeshSizeEstimate estimateMeshSize(const TissueMap& map, const ScaleField& scale)
{
  const Blocks blocks(map);
  const std::size_t layers = std::size_t(blocks.size()[2]), perLayer = blocks.perLayer();
  std::vector<Shares> shares(layers * perLayer);
  parallelForEach(layers,
                  [&](std::size_t layer)
                  {
                    addVolumes(map, blocks, int(layer), &shares[layer * perLayer]);
                    addAreas(map, blocks, int(layer), &shares[layer * perLayer]);
                  });
  std::vector<MeshSizeEstimate> parts(layers);
  parallelForEach(layers,
                  [&](std::size_t layer)
                  {
                    std::vector<Shares> around;
                    for (std::size_t n = 0; n < perLayer; ++n)
                      around.push_back(neighbourhood(blocks, shares, layer * perLayer + n));
                    parts[layer] = { trianglesOf(map, scale, blocks, int(layer), around),
                                     tetrahedraInside(map, scale, blocks, int(layer), around) };
                  });
  MeshSizeEstimate sum; // in the order of the layers, independent of the number of threads
  for (const MeshSizeEstimate& part : parts)
  {
    sum.triangles += part.triangles;
    sum.tetrahedra += part.tetrahedra;
  }
  sum.tetrahedra += tetrahedraPerTriangle * sum.triangles;
  return sum;
}

} // namespace surgicalmesher
