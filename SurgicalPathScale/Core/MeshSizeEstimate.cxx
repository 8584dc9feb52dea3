// SPDX-License-Identifier: Apache-2.0
#include "MeshSizeEstimate.h"

#include <vtkSMPTools.h>

#include <algorithm>
#include <cmath>

namespace surgicalmesher
{

namespace
{

// The model's constants, fitted to the project's meshes of the maps that the header names.
constexpr double tetrahedronVolume = 0.12;     ///< c: mean volume at unit edge; regular ones have 0.118, BCC ones 0.110
constexpr double tetrahedraPerTriangle = 0.95; ///< b
constexpr double surfaceEdge = 0.83;           ///< s: edge of interface triangles at unit edge, shorter than inside
constexpr double smoothArea = 2.0 / 3.0;       ///< smooth area per area of voxel faces, mean over directions
constexpr double edgePerThickness = 1.4;       ///< longest edge in a tissue of unit thickness 4 V / A
constexpr double blockSide = 4;                ///< mm; thickness is measured over 3 x 3 x 3 blocks

/// What one tissue has in one block.
struct Share
{
  Label label;
  double volume; ///< mm^3
  double area;   ///< mm^2 of smooth boundary
};

/// The map in blocks of about 4 mm side.
class Blocks
{
public:
  explicit Blocks(const TissueMap& map) : m_Map(map)
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

  int count() const { return m_Size[0] * m_Size[1] * m_Size[2]; }
  std::array<int, 3> size() const { return m_Size; }
  std::array<int, 3> position(int block) const
  {
    return { block % m_Size[0], block / m_Size[0] % m_Size[1], block / m_Size[0] / m_Size[1] };
  }
  double voxelVolume() const { return m_VoxelVolume; }
  double faceArea(int axis) const { return m_FaceArea[axis]; }

  Label label(int i, int j, int k) const { return labelAt(m_Map, { i, j, k }); }

  /// visit(i, j, k, label) of the block's voxels.
  template <typename Visit>
  void forEachVoxel(int block, Visit visit) const
  {
    const std::array<int, 3> p = position(block);
    std::array<int, 3> end;
    for (int axis = 0; axis < 3; ++axis) end[axis] = std::min((p[axis] + 1) * m_Side[axis], m_Map.grid.size[axis]);
    for (int k = p[2] * m_Side[2]; k < end[2]; ++k)
    {
      for (int j = p[1] * m_Side[1]; j < end[1]; ++j)
      {
        for (int i = p[0] * m_Side[0]; i < end[0]; ++i) visit(i, j, k, m_Map.labels[m_Map.grid.index(i, j, k)]);
      }
    }
  }

private:
  const TissueMap& m_Map;
  std::array<int, 3> m_Side;
  std::array<int, 3> m_Size;
  std::array<double, 3> m_FaceArea;
  double m_VoxelVolume;
};

Share& shareOf(std::vector<Share>& shares, Label label)
{
  for (Share& share : shares)
  {
    if (share.label == label) return share;
  }
  shares.push_back({ label, 0, 0 });
  return shares.back();
}

std::vector<Share> sharesOf(const Blocks& blocks, int block)
{
  std::vector<Share> shares;
  blocks.forEachVoxel(block,
                      [&](int i, int j, int k, Label label)
                      {
                        Share& share = shareOf(shares, label);
                        share.volume += blocks.voxelVolume();
                        for (int axis = 0; axis < 3; ++axis)
                        {
                          for (const int step : { -1, 1 })
                          {
                            const Label other = blocks.label(i + (axis == 0 ? step : 0), j + (axis == 1 ? step : 0),
                                                             k + (axis == 2 ? step : 0));
                            if (other != label) share.area += blocks.faceArea(axis);
                          }
                        }
                      });
  return shares;
}

std::vector<Share> neighbourhood(const Blocks& blocks, const std::vector<std::vector<Share>>& shares, int block)
{
  std::vector<Share> sum;
  const std::array<int, 3> p = blocks.position(block);
  const std::array<int, 3> size = blocks.size();
  for (int n = 0; n < 27; ++n)
  {
    const std::array<int, 3> q{ p[0] + n % 3 - 1, p[1] + n / 3 % 3 - 1, p[2] + n / 9 - 1 };
    bool inside = true;
    for (int axis = 0; axis < 3; ++axis) inside = inside && q[axis] >= 0 && q[axis] < size[axis];
    if (!inside) continue;
    for (const Share& share : shares[(q[2] * size[1] + q[1]) * size[0] + q[0]])
    {
      Share& total = shareOf(sum, share.label);
      total.volume += share.volume;
      total.area += share.area;
    }
  }
  return sum;
}

/// The longest edge that the tissue's thickness allows; background outside the map allows any.
double longestEdge(const std::vector<Share>& shares, Label label)
{
  for (const Share& share : shares)
  {
    if (share.label == label && share.area > 0) return edgePerThickness * 4 * share.volume / share.area;
  }
  return HUGE_VAL;
}

MeshSizeEstimate estimateBlock(const Blocks& blocks, int block, const std::vector<Share>& shares, const Grid& grid,
                               const ScaleField& scale)
{
  MeshSizeEstimate sum;
  blocks.forEachVoxel(
    block,
    [&](int i, int j, int k, Label label)
    {
      const double L = scale(grid.gridToWorld({ i * grid.spacing.x, j * grid.spacing.y, k * grid.spacing.z }));
      const double thickness = longestEdge(shares, label);
      const double edge = std::min(L, thickness);
      if (label != 0) sum.tetrahedra += blocks.voxelVolume() / (tetrahedronVolume * edge * edge * edge);
      for (int axis = 0; axis < 3; ++axis)
      {
        for (const int step : { -1, 1 })
        {
          const std::array<int, 3> q{ i + (axis == 0 ? step : 0), j + (axis == 1 ? step : 0),
                                      k + (axis == 2 ? step : 0) };
          const Label other = blocks.label(q[0], q[1], q[2]);
          if (other == label || (step < 0 && grid.contains(q[0], q[1], q[2])))
            continue; // a face within the map counts once
          const double faceEdge = surfaceEdge * std::min(edge, longestEdge(shares, other));
          sum.triangles += blocks.faceArea(axis) / (std::sqrt(3.0) / 4 * faceEdge * faceEdge);
        }
      }
    });
  return sum;
}

} // namespace

MeshSizeEstimate estimateMeshSize(const TissueMap& map, const ScaleField& scale)
{
  const Blocks blocks(map);
  std::vector<std::vector<Share>> shares(blocks.count());
  vtkSMPTools::For(0, blocks.count(),
                   [&](vtkIdType begin, vtkIdType end)
                   {
                     for (int block = int(begin); block < int(end); ++block) shares[block] = sharesOf(blocks, block);
                   });
  std::vector<MeshSizeEstimate> parts(blocks.count());
  vtkSMPTools::For(0, blocks.count(),
                   [&](vtkIdType begin, vtkIdType end)
                   {
                     for (int block = int(begin); block < int(end); ++block)
                     {
                       const std::vector<Share> around = neighbourhood(blocks, shares, block);
                       if (around.size() == 1 && around[0].label == 0) continue;
                       parts[block] = estimateBlock(blocks, block, around, map.grid, scale);
                     }
                   });
  MeshSizeEstimate sum; // in the order of the blocks, whatever the threads
  for (const MeshSizeEstimate& part : parts)
  {
    sum.triangles += part.triangles;
    sum.tetrahedra += part.tetrahedra;
  }
  sum.tetrahedra += tetrahedraPerTriangle * sum.triangles;
  return sum;
}

} // namespace surgicalmesher
