// SPDX-License-Identifier: Apache-2.0
#include "DigitalTopology.h"

#include "Grouped.h"
#include "LabelRuns.h"
#include "Parallel.h"
#include "UnionFind.h"

#include <algorithm>
#include <array>
#include <utility>

namespace surgicalmesher
{
namespace
{

using Index = std::uint32_t;
using Edge = std::pair<Index, Index>; // ascending region indices

/// The runs of a map and their sets during the union: set 0 is the outside, set r + 1 that of run r.
struct RunUnion
{
  const TissueMap& map;
  Regions regions;
  UnionFind sets;

  const Label* row(std::size_t row) const { return map.labels.data() + row * map.grid.size[0]; }
  Index end(std::size_t run, std::size_t row) const
  {
    return run + 1 < regions.rowBegins[row + 1] ? regions.runs[run + 1].begin : Index(map.grid.size[0]);
  }
};

/// The runs of a slice, and the number of runs in each of its rows.
struct SliceRuns
{
  std::vector<Run> runs;
  std::vector<std::size_t> perRow;
};

SliceRuns runsOf(const TissueMap& map, int k)
{
  SliceRuns result;
  const Index size = Index(map.grid.size[0]);
  for (int j = 0; j < map.grid.size[1]; ++j)
  {
    const std::size_t before = result.runs.size();
    const Label* labels = map.labels.data() + map.grid.index(0, j, k);
    for (Index i = 0; i < size; i += Index(runLength(labels + i, size - i))) result.runs.push_back({ i, 0 });
    result.perRow.push_back(result.runs.size() - before);
  }
  return result;
}

/// All runs of the map, each in a set of its own.
RunUnion separateRuns(const TissueMap& map)
{
  std::vector<SliceRuns> slices(map.grid.size[2]);
  parallelForEach(slices.size(), [&](std::size_t k) { slices[k] = runsOf(map, int(k)); });
  RunUnion u{ map, {}, {} };
  u.regions.rowBegins.assign(1, 0);
  for (const SliceRuns& slice : slices)
  {
    u.regions.runs.insert(u.regions.runs.end(), slice.runs.begin(), slice.runs.end());
    for (const std::size_t runs : slice.perRow) u.regions.rowBegins.push_back(u.regions.rowBegins.back() + runs);
  }
  u.sets = UnionFind(u.regions.runs.size() + 1);
  return u;
}

/// Unites the background runs of a row that touch the outside with `outside`, another set that does (0: none is known
/// yet, and the first one found becomes it).
void uniteWithOutside(RunUnion& u, std::size_t row, bool atBorder, Index& outside)
{
  const std::size_t begin = u.regions.rowBegins[row], end = u.regions.rowBegins[row + 1];
  for (std::size_t r = begin; r < end; ++r)
  {
    if ((!atBorder && r != begin && r + 1 != end) || u.row(row)[u.regions.runs[r].begin] != 0) continue;
    if (outside == 0) outside = Index(r + 1);
    u.sets.unite(Index(r + 1), outside);
  }
}

/// Unites the overlapping runs of equal label in two neighbouring rows.
void uniteRows(RunUnion& u, std::size_t rowA, std::size_t rowB)
{
  const auto& runs = u.regions.runs;
  std::size_t a = u.regions.rowBegins[rowA], b = u.regions.rowBegins[rowB];
  const std::size_t endA = u.regions.rowBegins[rowA + 1], endB = u.regions.rowBegins[rowB + 1];
  while (a < endA && b < endB)
  {
    if (u.row(rowA)[runs[a].begin] == u.row(rowB)[runs[b].begin]) u.sets.unite(Index(a + 1), Index(b + 1));
    const Index stopA = u.end(a, rowA), stopB = u.end(b, rowB);
    a += stopA <= stopB;
    b += stopB <= stopA;
  }
}

/// Unites touching runs within the slices [begin, end), without access to sets of other slices. Returns a set that
/// touches the outside; 0 if none does.
Index uniteSlices(RunUnion& u, int begin, int end)
{
  const int sizeJ = u.map.grid.size[1], sizeK = u.map.grid.size[2];
  Index outside = 0;
  for (int k = begin; k < end; ++k)
    for (int j = 0; j < sizeJ; ++j)
    {
      const std::size_t row = std::size_t(k) * sizeJ + j;
      uniteWithOutside(u, row, j == 0 || k == 0 || j + 1 == sizeJ || k + 1 == sizeK, outside);
      if (j > 0) uniteRows(u, row - 1, row);
      if (k > begin) uniteRows(u, row - sizeJ, row);
    }
  return outside;
}

/// Division of slices among threads: part n has the slices [begin(n), begin(n + 1)).
struct SliceParts
{
  int slices, count;

  explicit SliceParts(int slices) : slices(slices), count(std::clamp(slices / worthwhile, 1, most)) {}
  int begin(std::size_t part) const { return int(part) * slices / count; }

private:
  static constexpr int most = 8, worthwhile = 16; // most parts; fewest slices per part
};

/// Unites runs within each part of the slices in parallel, then across the borders of the parts.
void uniteAll(RunUnion& u)
{
  const int sizeJ = u.map.grid.size[1];
  const SliceParts parts(u.map.grid.size[2]);
  std::vector<Index> outside(parts.count);
  parallelForEach(outside.size(),
                  [&](std::size_t n) { outside[n] = uniteSlices(u, parts.begin(n), parts.begin(n + 1)); });
  for (std::size_t n = 0; n < outside.size(); ++n)
  {
    u.sets.unite(outside[n], 0);
    const std::size_t row = std::size_t(parts.begin(n)) * sizeJ;
    for (int j = 0; n > 0 && j < sizeJ; ++j) uniteRows(u, row + j - sizeJ, row + j);
  }
}

/// Numbers the sets in the order of their first runs and counts their voxels.
void numberRegions(RunUnion& u)
{
  u.regions.list.assign(1, {});
  for (std::size_t row = 0; row + 1 < u.regions.rowBegins.size(); ++row)
  {
    for (std::size_t r = u.regions.rowBegins[row]; r < u.regions.rowBegins[row + 1]; ++r)
    {
      Run& run = u.regions.runs[r];
      const Index set = u.sets.find(Index(r + 1));
      if (set == r + 1)
      {
        run.region = Index(u.regions.list.size());
        u.regions.list.push_back({ u.row(row)[run.begin], 0 });
      }
      else
      {
        run.region = set == 0 ? 0 : u.regions.runs[set - 1].region;
      }
      u.regions.list[run.region].voxels += u.end(r, row) - run.begin;
    }
  }
}

/// The region indices of one slice, with a margin of one voxel that belongs to the outside.
class RegionSlice
{
public:
  explicit RegionSlice(const Grid& grid)
    : m_Size(grid.size), m_Stride(grid.size[0] + 2), m_Regions(m_Stride * (grid.size[1] + 2), 0)
  {
  }

  const Index* row(int j) const { return m_Regions.data() + (j + 1) * m_Stride; }

  /// Slices -1 and size[2] are outside.
  void load(const Regions& regions, int k)
  {
    std::fill(m_Regions.begin(), m_Regions.end(), 0);
    if (k < 0 || k >= m_Size[2]) return;
    for (int j = 0; j < m_Size[1]; ++j)
    {
      const std::size_t row = std::size_t(k) * m_Size[1] + j;
      Index* out = m_Regions.data() + (j + 1) * m_Stride + 1;
      for (std::size_t r = regions.rowBegins[row]; r < regions.rowBegins[row + 1]; ++r)
      {
        const Index end = r + 1 < regions.rowBegins[row + 1] ? regions.runs[r + 1].begin : Index(m_Size[0]);
        std::fill(out + regions.runs[r].begin, out + end, regions.runs[r].region);
      }
    }
  }

private:
  std::array<int, 3> m_Size;
  std::size_t m_Stride;
  std::vector<Index> m_Regions;
};

/// Data from the 2x2x2 blocks of regions: Euler numbers, and which regions share a block (26-adjacency).
class BlockCounts
{
public:
  explicit BlockCounts(std::size_t regions) : euler(regions, 0) { m_Recent.fill({ 0, 0 }); }

  std::vector<int> euler; ///< by region; for the outside without the space beyond the grid

  /// Corner 0 is the voxel with the lowest i, j, k; bit 0 of a corner's number is i, bit 1 j, bit 2 k.
  void add(const std::array<Index, 8>& block)
  {
    countEuler(block);
    for (int a = 0; a < 8; ++a)
    {
      for (int b = a + 1; b < 8; ++b)
      {
        if (block[a] != block[b]) addEdge(std::minmax(block[a], block[b]));
      }
    }
  }

  void add(const BlockCounts& part)
  {
    for (std::size_t r = 0; r < euler.size(); ++r) euler[r] += part.euler[r];
    m_Edges.insert(m_Edges.end(), part.m_Edges.begin(), part.m_Edges.end());
  }

  /// Every pair of adjacent regions once, ascending.
  std::vector<Edge> takeEdges()
  {
    std::sort(m_Edges.begin(), m_Edges.end());
    m_Edges.erase(std::unique(m_Edges.begin(), m_Edges.end()), m_Edges.end());
    return std::move(m_Edges);
  }

private:
  /// Voxels - face pairs + squares - cubes of one region, each counted at its lowest corner.
  void countEuler(const std::array<Index, 8>& block)
  {
    const auto same = [&](int corner) { return block[corner] == block[0]; };
    const int pairs = same(1) + same(2) + same(4);
    const bool ij = same(1) && same(2) && same(3), ik = same(1) && same(4) && same(5),
               jk = same(2) && same(4) && same(6);
    euler[block[0]] += 1 - pairs + ij + ik + jk - (ij && ik && jk && same(7));
  }

  /// A small cache of recent pairs keeps most repetitions out of the list.
  void addEdge(const Edge& edge)
  {
    Edge& recent = m_Recent[(edge.first * 31 + edge.second) % m_Recent.size()];
    if (recent == edge) return;
    recent = edge;
    m_Edges.push_back(edge);
  }

  std::array<Edge, 4096> m_Recent;
  std::vector<Edge> m_Edges;
};

/// Adds the blocks that are not uniform between `rows`: two at j and j + 1, and the same two one slice up.
void addBlockRow(BlockCounts& counts, const std::array<const Index*, 4>& rows, std::size_t size,
                 std::vector<Index>& differs)
{
  const auto [a, b, c, d] = rows;
  for (std::size_t i = 0; i < size; ++i) differs[i] = (a[i] ^ b[i]) | (a[i] ^ c[i]) | (a[i] ^ d[i]);
  for (std::size_t i = 0; i + 1 < size; ++i)
  {
    if ((differs[i] | differs[i + 1] | (a[i] ^ a[i + 1])) == 0) continue;
    counts.add({ a[i], a[i + 1], b[i], b[i + 1], c[i], c[i + 1], d[i], d[i + 1] });
  }
}

/// Adds the blocks whose lower voxels are in the slices [begin, end).
void addBlocks(BlockCounts& counts, const Grid& grid, const Regions& regions, int begin, int end)
{
  RegionSlice below(grid), above(grid);
  const std::size_t rowSize = grid.size[0] + 2;
  std::vector<Index> differs(rowSize);
  above.load(regions, begin);
  for (int k = begin; k < end; ++k)
  {
    std::swap(below, above);
    above.load(regions, k + 1);
    for (int j = -1; j < grid.size[1]; ++j)
      addBlockRow(counts, { below.row(j), below.row(j + 1), above.row(j), above.row(j + 1) }, rowSize, differs);
  }
}

BlockCounts countBlocks(const Grid& grid, const Regions& regions)
{
  const SliceParts parts(grid.size[2] + 1); // including the slice below the map
  std::vector<BlockCounts> counts(parts.count, BlockCounts(regions.list.size()));
  parallelForEach(counts.size(), [&](std::size_t n)
                  { addBlocks(counts[n], grid, regions, parts.begin(n) - 1, parts.begin(n + 1) - 1); });
  for (std::size_t n = 1; n < counts.size(); ++n) counts[0].add(counts[n]);
  return std::move(counts[0]);
}

using Adjacency = Grouped<Index>; ///< neighbours of every region

Adjacency adjacency(std::size_t regions, const std::vector<Edge>& edges)
{
  return Adjacency(regions,
                   [&](auto&& visit)
                   {
                     for (const Edge& e : edges)
                     {
                       visit(e.first, e.second);
                       visit(e.second, e.first);
                     }
                   });
}

/// Number of parts that each region cuts off from the outside: the number of components of the connected graph without
/// the region, minus one. Depth-first search from the outside after Hopcroft and Tarjan 1973, without recursion.
std::vector<int> enclosedParts(const Adjacency& graph)
{
  const std::size_t count = graph.groups();
  std::vector<int> enclosed(count, 0);
  std::vector<Index> order(count, 0), low(count, 0), path{ 0 };
  std::vector<std::size_t> next(count, 0); // of each region's neighbours
  Index visited = 1;
  order[0] = low[0] = visited;
  while (!path.empty())
  {
    const Index region = path.back();
    if (next[region] < graph.size(region))
    {
      const Index neighbour = graph.begin(region)[next[region]++];
      if (order[neighbour] == 0)
      {
        order[neighbour] = low[neighbour] = ++visited;
        path.push_back(neighbour);
      }
      low[region] = std::min(low[region], order[neighbour]);
      continue;
    }
    path.pop_back();
    if (path.empty()) break;
    const Index parent = path.back();
    low[parent] = std::min(low[parent], low[region]);
    if (low[region] >= order[parent]) ++enclosed[parent];
  }
  return enclosed;
}

} // namespace

Regions connectedRegions(const TissueMap& map)
{
  RunUnion u = separateRuns(map);
  uniteAll(u);
  numberRegions(u);
  return std::move(u.regions);
}

std::vector<Betti> regionTopology(const TissueMap& map, const Regions& regions)
{
  BlockCounts counts = countBlocks(map.grid, regions);
  // Regions are disjoint sets in the continuous sense too, so each one's cavities are the parts that it alone cuts off.
  const std::vector<int> cavities = enclosedParts(adjacency(regions.list.size(), counts.takeEdges()));
  std::vector<Betti> result(regions.list.size());
  for (std::size_t r = 1; r < result.size(); ++r)
  {
    result[r] = { 1, 1 + cavities[r] - counts.euler[r], cavities[r] };
  }
  return result;
}

std::map<Label, Betti> tissueTopology(const TissueMap& map)
{
  const Regions regions = connectedRegions(map);
  const std::vector<Betti> topology = regionTopology(map, regions);
  std::map<Label, Betti> result;
  for (std::size_t r = 1; r < topology.size(); ++r)
  {
    if (regions.list[r].label != 0) result[regions.list[r].label] += topology[r];
  }
  return result;
}

} // namespace surgicalmesher
