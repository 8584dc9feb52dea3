// SPDX-License-Identifier: Apache-2.0
#include "DigitalTopology.h"

#include <gtest/gtest.h>

#include <functional>
#include <random>

using namespace surgicalmesher;

namespace
{

TissueMap emptyMap(int sizeI, int sizeJ, int sizeK)
{
  TissueMap map;
  map.grid.size = { sizeI, sizeJ, sizeK };
  map.labels.assign(map.grid.voxelCount(), 0);
  return map;
}

TissueMap noise(std::mt19937& random, int maximumSize, int labels)
{
  const auto size = [&] { return 1 + int(random() % maximumSize); };
  TissueMap map = emptyMap(size(), size(), size());
  for (Label& label : map.labels) label = Label(random() % (labels + 1));
  return map;
}

/// Of so many slices that threads share them; most voxels are like the one below.
TissueMap tallNoise(std::mt19937& random, int labels)
{
  TissueMap map = emptyMap(1 + int(random() % 5), 1 + int(random() % 5), 30 + int(random() % 70));
  const std::size_t slice = std::size_t(map.grid.size[0]) * map.grid.size[1];
  for (std::size_t v = 0; v < map.labels.size(); ++v)
    map.labels[v] = v >= slice && random() % 8 != 0 ? map.labels[v - slice] : Label(random() % (labels + 1));
  return map;
}

/// Voxels for which `inside` holds, on the grid with a margin of one voxel.
struct VoxelSet
{
  std::array<int, 3> size;
  std::vector<char> voxels;

  bool at(int i, int j, int k) const
  {
    if (i < 0 || j < 0 || k < 0 || i >= size[0] || j >= size[1] || k >= size[2]) return false;
    return voxels[(std::size_t(k) * size[1] + j) * size[0] + i];
  }
};

VoxelSet paddedSet(const TissueMap& map, const std::function<bool(Label)>& inside)
{
  const auto& n = map.grid.size;
  VoxelSet set{ { n[0] + 2, n[1] + 2, n[2] + 2 }, {} };
  for (int k = -1; k <= n[2]; ++k)
  {
    for (int j = -1; j <= n[1]; ++j)
    {
      for (int i = -1; i <= n[0]; ++i)
      {
        set.voxels.push_back(inside(labelAt(map, { i, j, k })));
      }
    }
  }
  return set;
}

/// Components by flood fill; neighbours differ by at most one in each axis and by at most `reach` in all.
int components(VoxelSet set, int reach)
{
  int count = 0;
  for (std::size_t seed = 0; seed < set.voxels.size(); ++seed)
  {
    if (!set.voxels[seed]) continue;
    ++count;
    std::vector<std::size_t> front{ seed };
    set.voxels[seed] = 0;
    while (!front.empty())
    {
      const std::size_t v = front.back();
      front.pop_back();
      const int i = int(v % set.size[0]), j = int(v / set.size[0] % set.size[1]),
                k = int(v / set.size[0] / set.size[1]);
      for (int n = 0; n < 27; ++n)
      {
        const int di = n % 3 - 1, dj = n / 3 % 3 - 1, dk = n / 9 - 1;
        if (std::abs(di) + std::abs(dj) + std::abs(dk) > reach || !set.at(i + di, j + dj, k + dk)) continue;
        const std::size_t w = (std::size_t(k + dk) * set.size[1] + j + dj) * set.size[0] + i + di;
        set.voxels[w] = 0;
        front.push_back(w);
      }
    }
  }
  return count;
}

/// Voxels - face pairs + squares of four - cubes of eight.
int eulerNumber(const VoxelSet& set)
{
  int euler = 0;
  for (int k = 0; k < set.size[2]; ++k)
  {
    for (int j = 0; j < set.size[1]; ++j)
    {
      for (int i = 0; i < set.size[0]; ++i)
      {
        for (int extent = 0; extent < 8; ++extent) // a voxel, pair, square or cube along the axes in `extent`
        {
          bool all = true;
          for (int c = 0; c < 8; ++c) all &= (c & ~extent) != 0 || set.at(i + (c & 1), j + (c >> 1 & 1), k + (c >> 2));
          const int axes = (extent & 1) + (extent >> 1 & 1) + (extent >> 2);
          euler += all ? (axes % 2 ? -1 : 1) : 0;
        }
      }
    }
  }
  return euler;
}

Betti bruteForce(const TissueMap& map, Label label)
{
  const VoxelSet inside = paddedSet(map, [&](Label l) { return l == label; });
  const int b0 = components(inside, 1);
  const int b2 = components(paddedSet(map, [&](Label l) { return l != label; }), 3) - 1;
  return { b0, b0 + b2 - eulerNumber(inside), b2 };
}

void fill(TissueMap& map, Label label, const std::function<bool(int, int, int)>& inside)
{
  for (int k = 0; k < map.grid.size[2]; ++k)
  {
    for (int j = 0; j < map.grid.size[1]; ++j)
    {
      for (int i = 0; i < map.grid.size[0]; ++i)
      {
        if (inside(i, j, k)) map.labels[map.grid.index(i, j, k)] = label;
      }
    }
  }
}

} // namespace

TEST(DigitalTopology, ShellAroundRingAroundNothing)
{
  TissueMap map = emptyMap(11, 11, 11);
  const auto distance = [](int i, int j, int k) {
    return std::max({ std::abs(i - 5), std::abs(j - 5), std::abs(k - 5) });
  };
  fill(map, 3, [&](int i, int j, int k) { return distance(i, j, k) == 5; });
  fill(map, 7, [&](int i, int j, int k) { return k == 5 && std::max(std::abs(i - 5), std::abs(j - 5)) == 2; });
  const std::map<Label, Betti> expected{ { 3, { 1, 0, 1 } }, { 7, { 1, 1, 0 } } };
  EXPECT_EQ(tissueTopology(map), expected);
}

TEST(DigitalTopology, CornerContactSeparatesATissueAndPiercesItsComplement)
{
  TissueMap map = emptyMap(2, 2, 2);
  map.labels = { 1, 2, 2, 2, 2, 2, 2, 1 };
  const std::map<Label, Betti> expected{ { 1, { 2, 0, 0 } }, { 2, { 1, 1, 0 } } };
  EXPECT_EQ(tissueTopology(map), expected);
}

TEST(DigitalTopology, AgreesWithTheDefinitionOnNoise)
{
  std::mt19937 random(1);
  for (int trial = 0; trial < 1500; ++trial)
  {
    const int labels = 1 + trial % 5;
    const TissueMap map = noise(random, 7, labels);
    const auto topology = tissueTopology(map);
    for (const Label label : presentLabels(map))
    {
      ASSERT_TRUE(topology.count(label)) << "trial " << trial << " label " << label;
      EXPECT_EQ(topology.at(label), bruteForce(map, label)) << "trial " << trial << " label " << label;
    }
    EXPECT_EQ(topology.size(), presentLabels(map).size());
  }
}

TEST(DigitalTopology, AgreesWithTheDefinitionWhereThreadsShareTheMap)
{
  std::mt19937 random(4);
  for (int trial = 0; trial < 200; ++trial)
  {
    const TissueMap map = tallNoise(random, 1 + trial % 3);
    for (const auto& [label, betti] : tissueTopology(map))
      EXPECT_EQ(betti, bruteForce(map, label)) << "trial " << trial;
  }
}

TEST(DigitalTopology, AgreesWithTheDefinitionOnNestedBoxes)
{
  std::mt19937 random(2);
  for (int trial = 0; trial < 200; ++trial)
  {
    TissueMap map = emptyMap(12, 12, 12);
    for (int box = 0; box < 12; ++box)
    {
      const auto range = [&] { return std::minmax({ int(random() % 12), int(random() % 12) }); };
      const std::pair<int, int> a = range(), b = range(), c = range();
      fill(map, Label(random() % 4),
           [&](int i, int j, int k)
           { return i >= a.first && i <= a.second && j >= b.first && j <= b.second && k >= c.first && k <= c.second; });
    }
    for (const auto& [label, betti] : tissueTopology(map))
      EXPECT_EQ(betti, bruteForce(map, label)) << "trial " << trial;
  }
}

TEST(DigitalTopology, RegionsPartitionTheMap)
{
  std::mt19937 random(3);
  for (int trial = 0; trial < 100; ++trial)
  {
    const TissueMap map = trial % 2 ? tallNoise(random, 3) : noise(random, 9, 3);
    const Regions regions = connectedRegions(map);
    std::uint32_t numbered = 0; // up to that; 0 is the outside
    for (const auto& run : regions.runs)
    {
      EXPECT_LE(run.region, numbered + 1);
      numbered = std::max(numbered, run.region);
    }
    std::size_t voxels = 0;
    for (const Region& region : regions.list) voxels += region.voxels;
    EXPECT_EQ(voxels, map.labels.size());
    for (std::size_t row = 0; row + 1 < regions.rowBegins.size(); ++row)
    {
      for (std::size_t r = regions.rowBegins[row]; r < regions.rowBegins[row + 1]; ++r)
      {
        const Label label = map.labels[row * map.grid.size[0] + regions.runs[r].begin];
        EXPECT_EQ(regions.list[regions.runs[r].region].label, label);
      }
    }
  }
}
