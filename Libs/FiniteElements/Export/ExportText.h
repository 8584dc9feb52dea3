// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Text that reads back as the same numbers, whatever the host's locale.

#include "TextNumbers.h"
#include "Vec3.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <locale>
#include <sstream>

namespace surgicalmesher
{

class ExportText : public std::ostringstream
{
public:
  ExportText() { imbue(std::locale::classic()); }
};

inline std::ostream& operator<<(std::ostream& out, const Vec3& p)
{
  return out << textOf(p.x) << ' ' << textOf(p.y) << ' ' << textOf(p.z);
}

/// Point ids, counted from 1, with a blank before each.
template <std::size_t N>
struct FromOne
{
  const std::array<std::int32_t, N>& ids;
};
template <std::size_t N>
FromOne(const std::array<std::int32_t, N>&) -> FromOne<N>;

template <std::size_t N>
std::ostream& operator<<(std::ostream& out, const FromOne<N>& cell)
{
  for (const std::int32_t id : cell.ids) out << ' ' << id + 1;
  return out;
}

} // namespace surgicalmesher
