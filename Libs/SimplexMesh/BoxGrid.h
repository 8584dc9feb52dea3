// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Spatial hash: items are stored in the cells of a regular grid that their bounding boxes touch, for proximity
/// queries.

#include "Vec3.h"

#include <algorithm>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace surgicalmesher
{

struct Box
{
  Vec3 low, high;

  static Box around(const Vec3& p, double reach = 0)
  {
    return { p - Vec3{ reach, reach, reach }, p + Vec3{ reach, reach, reach } };
  }
  bool contains(const Vec3& p) const
  {
    return p.x >= low.x && p.x <= high.x && p.y >= low.y && p.y <= high.y && p.z >= low.z && p.z <= high.z;
  }
  void add(const Vec3& p)
  {
    for (int a = 0; a < 3; ++a)
    {
      low[a] = std::min(low[a], p[a]);
      high[a] = std::max(high[a], p[a]);
    }
  }
};

class BoxGrid
{
public:
  explicit BoxGrid(double cellSize) : m_Size(cellSize) {}

  void insert(std::int32_t item, const Box& box)
  {
    forCells(box, [&](std::uint64_t key) { m_Cells[key].push_back(item); });
  }

  /// Removes an item; `box` must be the one it was inserted with.
  void remove(std::int32_t item, const Box& box)
  {
    forCells(box,
             [&](std::uint64_t key)
             {
               auto& items = m_Cells[key];
               items.erase(std::find(items.begin(), items.end(), item));
             });
  }

  /// Calls visit(item) for the items of all cells that the box touches, until it returns false. An item may come
  /// several times. The order depends only on the preceding insertions and removals.
  template <class Visit>
  void visit(const Box& box, const Visit& visit) const
  {
    bool goesOn = true;
    forCells(box,
             [&](std::uint64_t key)
             {
               const auto at = goesOn ? m_Cells.find(key) : m_Cells.end();
               if (at == m_Cells.end()) return;
               for (std::size_t i = 0; i < at->second.size() && goesOn; ++i) goesOn = visit(at->second[i]);
             });
  }

private:
  template <class Action>
  void forCells(const Box& box, const Action& action) const
  {
    std::int64_t from[3], to[3];
    for (int a = 0; a < 3; ++a)
    {
      from[a] = std::int64_t(std::floor(box.low[a] / m_Size));
      to[a] = std::int64_t(std::floor(box.high[a] / m_Size));
    }
    for (std::int64_t k = from[2]; k <= to[2]; ++k)
      for (std::int64_t j = from[1]; j <= to[1]; ++j)
        for (std::int64_t i = from[0]; i <= to[0]; ++i)
          action((std::uint64_t(i) & mask) | (std::uint64_t(j) & mask) << 21 | (std::uint64_t(k) & mask) << 42);
  }

  static constexpr std::uint64_t mask = (1u << 21) - 1;
  double m_Size;
  // Only looked up, never iterated over: its order is unspecified.
  std::unordered_map<std::uint64_t, std::vector<std::int32_t>> m_Cells;
};

} // namespace surgicalmesher
