// SPDX-License-Identifier: Apache-2.0
#include "UniformBlocks.h"

#include "LocalTopology.h"
#include "PaddedMap.h"
#include "Parallel.h"

#include <algorithm>
#include <array>
#include <map>
#include <vector>

namespace surgicalmesher
{
namespace
{

constexpr int largestSide = 8;

using Balance = std::map<Label, int>; ///< net number of voxels that each label has lost

class Unifier
{
public:
  Unifier(PaddedMap& map, const ScaleField& scale, const UniformBlocksOptions& options)
    : m_Map(map), m_Scale(scale), m_Options(options), m_Around(neighbourSteps(map.grid))
  {
    findMixed();
  }

  /// Gives blocks of this side one label each, and tries refused blocks a second time, after their neighbours have
  /// changed. Blocks of equal parity along every axis change in parallel: none of them reads voxels that another
  /// writes.
  void unify(int side)
  {
    std::array<std::vector<Corners>, 8> refused;
    for (int parity = 0; parity < 8; ++parity) refused[parity] = unifyAll(blocksOf(side, parity), side);
    for (int parity = 0; parity < 8; ++parity) unifyAll(refused[parity], side);
  }

private:
  struct Share
  {
    Label label;
    int voxels;
  };

  using Corner = std::array<int, 3>; ///< first voxel of a block in the map
  using Corners = std::vector<Corner>;

  /// The blocks of one parity that may have several labels, by layers along k.
  std::vector<Corners> blocksOf(int side, int parity) const
  {
    const std::array<int, 3> first{ parity & 1, parity >> 1 & 1, parity >> 2 };
    const auto& size = m_Map.grid.size;
    std::array<int, 3> count;
    for (int a = 0; a < 3; ++a) count[a] = std::max(0, ((size[a] - 2 * m_Map.margin) / side - first[a] + 1) / 2);
    std::vector<Corners> layers(count[2]);
    parallelForEach(
      layers.size(),
      [&](std::size_t k)
      {
        for (int j = 0; j < count[1]; ++j)
          for (int i = 0; i < count[0]; ++i)
          {
            const Corner corner{ (2 * i + first[0]) * side, (2 * j + first[1]) * side, (2 * int(k) + first[2]) * side };
            if (mayBeMixed(corner)) layers[k].push_back(corner);
          }
      });
    return layers;
  }

  /// Unifies all blocks; returns those that should have a single label but kept several.
  std::vector<Corners> unifyAll(const std::vector<Corners>& layers, int side)
  {
    std::vector<Balance> lost(layers.size());
    std::vector<Corners> refused(layers.size());
    parallelForEach(layers.size(),
                    [&](std::size_t k)
                    {
                      for (const Corner& corner : layers[k])
                        if (!unify(corner, side, lost[k])) refused[k].push_back(corner);
                    });
    for (const Balance& of : lost)
      for (const auto& [label, voxels] : of) m_Lost[label] += voxels;
    return refused;
  }

  bool isFine(const Corner& corner, int side) const
  {
    const double half = 0.5 * (side - 1);
    const Grid& grid = m_Map.grid;
    Vec3 middle = grid.position(corner[0], corner[1], corner[2]);
    for (int a = 0; a < 3; ++a) middle[a] += half * grid.spacing[a];
    return side * grid.smallestSpacing() > m_Options.relativeSize * m_Scale(grid.gridToWorld(middle));
  }

  /// Finds the largest blocks that have several labels. Most have a single one, and nothing in them changes.
  void findMixed()
  {
    for (int a = 0; a < 3; ++a) m_Count[a] = (m_Map.grid.size[a] - 2 * m_Map.margin) / largestSide;
    m_IsMixed.assign(std::size_t(m_Count[0]) * m_Count[1] * m_Count[2], true);
    parallelForEach(std::size_t(m_Count[2]),
                    [&](std::size_t k)
                    {
                      for (int j = 0; j < m_Count[1]; ++j)
                        for (int i = 0; i < m_Count[0]; ++i)
                          m_IsMixed[(k * m_Count[1] + j) * m_Count[0] + i] =
                            isMixed({ i * largestSide, j * largestSide, int(k) * largestSide }, largestSide);
                    });
  }

  /// Whether the largest block that holds the corner, if there is a whole one, had several labels.
  bool mayBeMixed(const Corner& corner) const
  {
    Corner block;
    for (int a = 0; a < 3; ++a)
    {
      block[a] = corner[a] / largestSide;
      if (block[a] >= m_Count[a]) return true;
    }
    return m_IsMixed[(std::size_t(block[2]) * m_Count[1] + block[1]) * m_Count[0] + block[0]];
  }

  std::size_t voxelAt(const Corner& corner) const
  {
    const int margin = m_Map.margin;
    return m_Map.grid.index(corner[0] + margin, corner[1] + margin, corner[2] + margin);
  }

  template <class F>
  void forEachVoxel(const Corner& corner, int side, F&& f) const
  {
    for (int k = 0; k < side; ++k)
      for (int j = 0; j < side; ++j)
      {
        const std::size_t row = voxelAt({ corner[0], corner[1] + j, corner[2] + k });
        for (int i = 0; i < side; ++i) f(row + i);
      }
  }

  bool isMixed(const Corner& corner, int side) const
  {
    const Label first = m_Map.labels[voxelAt(corner)];
    bool mixed = false;
    forEachVoxel(corner, side, [&](std::size_t v) { mixed |= m_Map.labels[v] != first; });
    return mixed;
  }

  /// The label with the most voxels in the block; of equals, the one that has lost most elsewhere.
  Label majority(const std::vector<Share>& shares) const
  {
    const auto lost = [&](Label label)
    {
      const auto at = m_Lost.find(label);
      return at == m_Lost.end() ? 0 : at->second;
    };
    const auto less = [&](const Share& a, const Share& b)
    { return a.voxels != b.voxels ? a.voxels < b.voxels : lost(a.label) < lost(b.label); };
    return std::max_element(shares.begin(), shares.end(), less)->label;
  }

  /// Unifies a block. Returns false if the block should have a single label but cannot.
  bool unify(const Corner& corner, int side, Balance& lost)
  {
    if (!isMixed(corner, side) || isFine(corner, side)) return true;
    std::vector<Share> shares;
    forEachVoxel(corner, side,
                 [&](std::size_t v)
                 {
                   const Label label = m_Map.labels[v];
                   const auto at =
                     std::find_if(shares.begin(), shares.end(), [&](const Share& s) { return s.label == label; });
                   if (at == shares.end()) shares.push_back({ label, 1 });
                   else ++at->voxels;
                 });
    for (const Share& s : shares)
      if (m_Options.protectedLabels.count(s.label)) return true;
    return give(corner, side, majority(shares), shares, lost);
  }

  struct Change
  {
    std::size_t voxel;
    Label before;
  };

  /// Gives all voxels of the block to `label`, or none.
  bool give(const Corner& corner, int side, Label label, const std::vector<Share>& shares, Balance& lost)
  {
    std::vector<std::size_t> left;
    forEachVoxel(corner, side,
                 [&](std::size_t v)
                 {
                   if (m_Map.labels[v] != label) left.push_back(v);
                 });
    std::vector<Change> changes;
    for (std::size_t before = 0; left.size() != before;)
    {
      before = left.size();
      const auto isGiven = [&](std::size_t v)
      {
        if (!isSimple(gather(m_Map, v, m_Around), label)) return false;
        changes.push_back({ v, m_Map.labels[v] });
        m_Map.labels[v] = label;
        return true;
      };
      left.erase(std::remove_if(left.begin(), left.end(), isGiven), left.end());
    }
    if (!left.empty() || leavesContacts(corner, side) || leavesBehind(changes, side / 2))
    {
      for (const Change& c : changes) m_Map.labels[c.voxel] = c.before;
      return false;
    }
    for (const Share& s : shares) lost[s.label] += s.voxels;
    lost[label] -= side * side * side;
    return true;
  }

  /// Whether a label has no voxel left within `most` voxels, along an axis, of a voxel that it has lost: the end of a
  /// thin piece must not recede farther than a wall does.
  bool leavesBehind(const std::vector<Change>& changes, int most) const
  {
    const auto isNear = [&](const Change& c)
    {
      return std::any_of(sixNeighbours.begin(), sixNeighbours.end(),
                         [&](int face)
                         {
                           for (int n = 1; n <= most; ++n)
                             if (m_Map.labels[c.voxel + n * m_Around[face]] == c.before) return true;
                           return false;
                         });
    };
    return !std::all_of(changes.begin(), changes.end(), isNear);
  }

  /// Whether labels touch themselves only along an edge or a corner around the block.
  bool leavesContacts(const Corner& corner, int side) const
  {
    const auto& n = m_Around;
    const std::array<std::ptrdiff_t, 8> cube{ 0, n[14], n[16], n[17], n[22], n[23], n[25], n[26] };
    for (int k = -1; k < side; ++k)
      for (int j = -1; j < side; ++j)
        for (int i = -1; i < side; ++i)
        {
          const bool isInside = std::min({ i, j, k }) >= 0 && std::max({ i, j, k }) < side - 1;
          if (!isInside && isCritical(gather(m_Map, voxelAt({ corner[0] + i, corner[1] + j, corner[2] + k }), cube)))
            return true;
        }
    return false;
  }

  PaddedMap& m_Map;
  const ScaleField& m_Scale;
  const UniformBlocksOptions& m_Options;
  const std::array<std::ptrdiff_t, 27> m_Around;
  std::array<int, 3> m_Count;  ///< number of whole blocks of the largest side
  std::vector<char> m_IsMixed; ///< by these blocks, i fastest
  Balance m_Lost;
};

bool hasCubicVoxels(const Grid& grid) { return grid.largestSpacing() < 1.5 * grid.smallestSpacing(); }

} // namespace

TissueMap withUniformBlocks(const TissueMap& map, const ScaleField& scale, const UniformBlocksOptions& options)
{
  TissueMap result = map;
  if (!hasCubicVoxels(map.grid)) return result;
  PaddedMap work = padded(map, largestSide / 2);
  Unifier unifier(work, scale, options);
  for (int side = 2; side <= largestSide; side *= 2) unifier.unify(side);
  copyWithoutMargin(work, result);
  return result;
}

} // namespace surgicalmesher
