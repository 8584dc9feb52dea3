// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Disjoint sets over 0..n-1; the representative of a set is its smallest member, whatever the order of the unions.

#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace surgicalmesher
{

class UnionFind
{
public:
  UnionFind() = default;
  explicit UnionFind(std::size_t count) : m_Parent(count) { std::iota(m_Parent.begin(), m_Parent.end(), 0u); }

  /// Adds a set with one member and returns that member.
  std::uint32_t add()
  {
    m_Parent.push_back(std::uint32_t(m_Parent.size()));
    return m_Parent.back();
  }

  std::uint32_t find(std::uint32_t i)
  {
    while (m_Parent[i] != i) i = m_Parent[i] = m_Parent[m_Parent[i]];
    return i;
  }

  /// Joins the sets of a and b; returns whether they were different sets.
  bool unite(std::uint32_t a, std::uint32_t b)
  {
    a = find(a);
    b = find(b);
    if (a > b) std::swap(a, b);
    m_Parent[b] = a;
    return a != b;
  }

private:
  std::vector<std::uint32_t> m_Parent;
};

} // namespace surgicalmesher
