// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Runs of equal labels, of which most of a map consists.

#include "TissueMap.h"

#include <cstddef>
#include <cstdint>
#include <cstring>

namespace surgicalmesher
{

/// Returns how many labels at the beginning of `labels` equal the first, at most `count`, which is at least 1. Compares
/// four labels at a time.
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

/// Calls visit(label, runBegin, runEnd), in order, for every run of equal labels within the indices [begin, end); the
/// run has the indices [runBegin, runEnd).
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
