// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Values sorted into groups by counting sort: the values of a group are contiguous, in the order of insertion.

#include "Parallel.h"

#include <array>
#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

namespace surgicalmesher
{

template <class Value>
class Grouped
{
public:
  Grouped() = default;

  /// `forEach(visit)` calls visit(group, value) for every value; it is called twice and must make the same calls both
  /// times. Groups are numbered from 0 to groups - 1.
  template <class ForEach>
  Grouped(std::size_t groups, const ForEach& forEach) : m_Start(groups + 1, 0)
  {
    forEach([&](std::size_t group, const Value&) { ++m_Start[group + 1]; });
    std::partial_sum(m_Start.begin(), m_Start.end(), m_Start.begin());
    m_Values.resize(m_Start.back());
    std::vector<std::size_t> next(m_Start.begin(), m_Start.end() - 1);
    forEach([&](std::size_t group, const Value& value) { m_Values[next[group]++] = value; });
  }

  /// The same on several threads, for the values of `count` items: `forEachOf(first, last, visit)` calls visit(group,
  /// value) for the values of the items in [first, last). It is called twice for each range, on any thread, must make
  /// the same calls both times, and must not throw.
  template <class ForEachOf>
  Grouped(std::size_t groups, std::size_t count, const ForEachOf& forEachOf) : m_Start(groups + 1)
  {
    constexpr std::size_t parts = 4; // each needs a counter per group: more cost more memory than they save time
    std::array<std::vector<std::size_t>, parts> next; // per part and group: number of values, then next place
    const auto inParts = [&](auto&& visitorOf)
    {
      parallelForEach(parts, [&](std::size_t p)
                      { forEachOf(count * p / parts, count * (p + 1) / parts, visitorOf(next[p])); });
    };
    for (auto& of : next) of.assign(groups, 0);
    inParts([](auto& of) { return [&of](std::size_t group, const Value&) { ++of[group]; }; });
    std::size_t at = 0;
    for (std::size_t group = 0; group < groups; ++group)
    {
      m_Start[group] = at;
      for (auto& of : next) at += std::exchange(of[group], at);
    }
    m_Start[groups] = at;
    m_Values.resize(at);
    inParts([this](auto& of)
            { return [this, &of](std::size_t group, const Value& value) { m_Values[of[group]++] = value; }; });
  }

  std::size_t groups() const { return m_Start.size() - 1; }
  std::size_t size(std::size_t group) const { return m_Start[group + 1] - m_Start[group]; }

  const Value* begin(std::size_t group) const { return m_Values.data() + m_Start[group]; }
  const Value* end(std::size_t group) const { return m_Values.data() + m_Start[group + 1]; }
  Value* begin(std::size_t group) { return m_Values.data() + m_Start[group]; }
  Value* end(std::size_t group) { return m_Values.data() + m_Start[group + 1]; }

private:
  std::vector<std::size_t> m_Start{ 0 }; ///< first value of each group in m_Values; the last entry is the end
  std::vector<Value> m_Values;
};

} // namespace surgicalmesher
