// SPDX-License-Identifier: Apache-2.0
#include "TissueMap.h"

#include "LabelRuns.h"
#include "Parallel.h"

#include <algorithm>

namespace surgicalmesher
{

std::vector<Label> presentLabels(const TissueMap& map)
{
  std::vector<Label> labels;
  for (const auto& [label, voxels] : countVoxels(map))
  {
    if (label != 0) labels.push_back(label);
  }
  return labels;
}

std::vector<Label> freeLabels(const TissueMap& map, std::size_t count, const std::set<Label>& named)
{
  std::set<Label> taken = named;
  taken.insert(0);
  for (const Label label : presentLabels(map)) taken.insert(label);
  for (const auto& entry : map.table) taken.insert(entry.first);
  const std::size_t next = std::size_t(*taken.rbegin()) + 1;
  std::vector<Label> labels;
  for (std::size_t label = next + count > labelCount ? 1 : next; label < labelCount && labels.size() < count; ++label)
    if (taken.count(Label(label)) == 0) labels.push_back(Label(label));
  return labels;
}

bool fillBackground(TissueMap& map, Label label)
{
  if (std::find(map.labels.begin(), map.labels.end(), label) != map.labels.end()) return false;
  std::replace(map.labels.begin(), map.labels.end(), Label(0), label);
  if (map.table[label].name.empty()) map.table[label].name = "surroundings";
  return true;
}

TissueMap everyNth(const TissueMap& map, int n)
{
  std::array<int, 3> size = map.grid.size;
  for (int& voxels : size) voxels = (voxels + n - 1) / n;
  return everyNth(map, n, {}, size);
}

TissueMap everyNth(const TissueMap& map, int n, const std::array<int, 3>& first, const std::array<int, 3>& size)
{
  TissueMap result;
  result.table = map.table;
  result.grid = map.grid;
  result.grid.origin = map.grid.gridToWorld(map.grid.position(first[0], first[1], first[2]));
  result.grid.spacing = double(n) * map.grid.spacing;
  result.grid.size = size;
  result.labels.reserve(result.grid.voxelCount());
  for (int k = 0; k < size[2]; ++k)
    for (int j = 0; j < size[1]; ++j)
    {
      const Label* row = map.labels.data() + map.grid.index(first[0], first[1] + j * n, first[2] + k * n);
      for (int i = 0; i < size[0]; ++i) result.labels.push_back(row[i * n]);
    }
  return result;
}

std::map<Label, std::size_t> countVoxels(const TissueMap& map)
{
  constexpr std::size_t most = 16, worthwhile = 1 << 20; // parts, voxels of each
  const std::size_t parts = std::clamp(map.labels.size() / worthwhile, std::size_t(1), most);
  std::vector<std::vector<std::size_t>> counts(parts, std::vector<std::size_t>(labelCount, 0));
  parallelForEach(parts,
                  [&](std::size_t n)
                  {
                    forEachLabelRun(map.labels, n * map.labels.size() / parts, (n + 1) * map.labels.size() / parts,
                                    [&](Label label, std::size_t begin, std::size_t end)
                                    { counts[n][label] += end - begin; });
                  });
  std::map<Label, std::size_t> result;
  for (std::size_t label = 0; label < labelCount; ++label)
  {
    std::size_t count = 0;
    for (const std::vector<std::size_t>& part : counts) count += part[label];
    if (count > 0) result[Label(label)] = count;
  }
  return result;
}

} // namespace surgicalmesher
