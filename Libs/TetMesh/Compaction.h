// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Renumbering of the points that cells use, without gaps.

#include "Parallel.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

namespace surgicalmesher
{

/// Returns the values at `ids`, in their order; empty if `values` is empty. Runs on several threads.
template <class Value>
std::vector<Value> valuesAt(const std::vector<Value>& values, const std::vector<std::int32_t>& ids)
{
  static_assert(!std::is_same_v<Value, bool>, "neighbouring bits cannot be written at once");
  if (values.empty()) return {};
  std::vector<Value> result(ids.size());
  parallelForIfIdle(ids.size(), [&](std::size_t n) { result[n] = values[ids[n]]; });
  return result;
}

/// Renumbers the points of `cells` without gaps, in the order of their old ids; the first `kept` of all `pointCount`
/// points stay, used or not. Returns the old ids in the new order.
template <std::size_t Corners>
std::vector<std::int32_t> compactPoints(std::vector<std::array<std::int32_t, Corners>>& cells, std::size_t pointCount,
                                        std::size_t kept = 0)
{
  std::vector<std::int32_t> newId(pointCount, -1), oldId;
  for (std::size_t i = 0; i < kept; ++i) newId[i] = 0;
  for (const auto& cell : cells)
    for (const std::int32_t id : cell) newId[id] = 0;
  for (std::size_t i = 0; i < pointCount; ++i)
  {
    if (newId[i] < 0) continue;
    newId[i] = std::int32_t(oldId.size());
    oldId.push_back(std::int32_t(i));
  }
  for (auto& cell : cells)
    for (std::int32_t& id : cell) id = newId[id];
  return oldId;
}

/// The same in the order in which the cells first use the points, so that neighbours in space are close in memory.
template <std::size_t Corners>
std::vector<std::int32_t> compactPointsByUse(std::vector<std::array<std::int32_t, Corners>>& cells,
                                             std::size_t pointCount)
{
  std::vector<std::int32_t> newId(pointCount, -1), oldId;
  for (auto& cell : cells)
    for (std::int32_t& id : cell)
    {
      if (newId[id] < 0)
      {
        newId[id] = std::int32_t(oldId.size());
        oldId.push_back(id);
      }
      id = newId[id];
    }
  return oldId;
}

} // namespace surgicalmesher
