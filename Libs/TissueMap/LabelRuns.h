// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Stretches of equal labels, as most of a map is made of.

#include "TissueMap.h"

#include <cstddef>
#include <cstdint>
#include <cstring>

namespace surgicalmesher
{

/// How many of `count` labels in memory, one at least, are like the first; four of them are looked at together.
inline std::size_t runLength(const Label* labels, std::size_t count)
{
  constexpr std::size_t together = sizeof(std::uint64_t) / sizeof(Label);
  const std::uint64_t likeFirst = labels[0] * std::uint64_t(0x0001000100010001);
  std::size_t i = 0;
  for (std::uint64_t next; i + together <= count; i += together)
  {
    std::memcpy(&next, labels + i, sizeof next);
    if (next != likeFirst) break;
  }
  while (i < count && labels[i] == labels[0]) ++i;
  return i;
}

/// Calls visit(label, begin, end) for every run of the labels from index `begin` up to `end`, in order: they are those from its
/// own begin up to its end.
template <class Visit>
void forEachLabelRun(const std::vector<Label>& labels, std::size_t begin, std::size_t end, Visit&& visit)
{
  for (std::size_t next; begin < end; begin = next)
  {
    next = begin + runLength(labels.data() + begin, end - begin);
    visit(labels[begin], begin, next);
  }
}

} // namespace surgicalmesher
