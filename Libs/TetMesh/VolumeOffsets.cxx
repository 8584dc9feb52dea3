// SPDX-License-Identifier: Apache-2.0
#include "VolumeOffsets.h"

#include <algorithm>

namespace surgicalmesher
{

TissueOffsets offsetsForVolumes(const std::map<Label, double>& lacking,
                                const std::map<std::pair<Label, Label>, double>& areas, double most)
{
  std::map<Label, double> result, area;
  for (const auto& [pair, a] : areas) area[pair.first] += a, area[pair.second] += a;
  for (int round = 0; round < 20; ++round)
  {
    std::map<Label, double> wanted = lacking;
    for (const auto& [pair, a] : areas)
    {
      wanted[pair.first] += a * result[pair.second];
      wanted[pair.second] += a * result[pair.first];
    }
    for (const auto& [label, sum] : wanted)
      if (label != 0 && area[label] > 0) result[label] = std::clamp(sum / area[label], -most, most);
  }
  return result;
}

} // namespace surgicalmesher
