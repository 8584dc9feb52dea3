// SPDX-License-Identifier: Apache-2.0
#include "TissueMap.h"

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

bool fillBackground(TissueMap& map, Label label)
{
  if (std::find(map.labels.begin(), map.labels.end(), label) != map.labels.end()) return false;
  std::replace(map.labels.begin(), map.labels.end(), Label(0), label);
  if (map.table[label].name.empty()) map.table[label].name = "surroundings";
  return true;
}

std::map<Label, std::size_t> countVoxels(const TissueMap& map)
{
  std::vector<std::size_t> counts(labelCount, 0);
  for (const Label label : map.labels) ++counts[label];
  std::map<Label, std::size_t> result;
  for (std::size_t label = 0; label < counts.size(); ++label)
  {
    if (counts[label] > 0) result[Label(label)] = counts[label];
  }
  return result;
}

} // namespace surgicalmesher
