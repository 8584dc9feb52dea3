// SPDX-License-Identifier: Apache-2.0
#include "GeodesicFront.h"

#include <array>
#include <functional>
#include <limits>
#include <queue>

namespace surgicalmesher
{

std::vector<bool> reachedFrom(const Grid& grid, const std::vector<std::size_t>& seeds, const std::vector<bool>& isOpen,
                              double limit)
{
  using Entry = std::pair<double, std::size_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<Entry>> queue;
  std::vector<float> way(isOpen.size(), std::numeric_limits<float>::infinity());
  for (const std::size_t n : seeds)
  {
    if (!isOpen[n]) continue;
    way[n] = 0;
    queue.push({ 0, n });
  }
  const double farthest = limit > 0 ? limit : std::numeric_limits<double>::infinity();
  std::vector<bool> reached(isOpen.size(), false);
  while (!queue.empty())
  {
    const auto [here, n] = queue.top();
    queue.pop();
    if (reached[n]) continue;
    reached[n] = true;
    const int i = int(n % grid.size[0]);
    const int j = int(n / grid.size[0] % grid.size[1]);
    const int k = int(n / (std::size_t(grid.size[0]) * grid.size[1]));
    for (int step = 0; step < 27; ++step)
    {
      const std::array<int, 3> d{ step % 3 - 1, step / 3 % 3 - 1, step / 9 - 1 };
      if (!grid.contains(i + d[0], j + d[1], k + d[2])) continue;
      const std::size_t m = grid.index(i + d[0], j + d[1], k + d[2]);
      if (!isOpen[m] || reached[m]) continue;
      const double there = here + norm({ d[0] * grid.spacing.x, d[1] * grid.spacing.y, d[2] * grid.spacing.z });
      if (there > farthest || !(there < way[m])) continue;
      way[m] = float(there);
      queue.push({ there, m });
    }
  }
  return reached;
}

} // namespace surgicalmesher
