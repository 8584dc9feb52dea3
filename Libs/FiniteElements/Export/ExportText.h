// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Text output that reads back as the same numbers, independent of the host's locale.

#include "Cell.h"
#include "TextNumbers.h"
#include "Vec3.h"

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

/// Writes point ids counted from 1, each preceded by a blank.
struct FromOne
{
  const Cell& ids;
};

inline std::ostream& operator<<(std::ostream& out, const FromOne& cell)
{
  for (const std::int32_t id : cell.ids) out << ' ' << id + 1;
  return out;
}

} // namespace surgicalmesher
