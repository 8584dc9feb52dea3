// SPDX-License-Identifier: Apache-2.0
#include "ToolPath.h"

#include "Errors.h"
#include "Text.h"
#include "TextTable.h"

#include <algorithm>
#include <array>

namespace surgicalmesher
{
namespace
{

constexpr std::array<const char*, 4> kColumns{ "seconds", "x", "y", "z" };
constexpr const char* kColumnNames = "seconds, x, y, z";

int columnOf(const std::string& name)
{
  const auto found = std::find(kColumns.begin(), kColumns.end(), text::lowerCase(name));
  return found == kColumns.end() ? -1 : int(found - kColumns.begin());
}

double numberIn(const TextTableRow& row, std::size_t column)
{
  double value = 0;
  if (!text::parseNumber(row.fields[column], value))
    row.fail(std::string(kColumns[column]) + " \"" + row.fields[column] + "\", expected a finite number");
  return value;
}

} // namespace

ToolPath readToolPath(const std::string& file)
{
  const TextTable table = readTextTable(file, int(kColumns.size()), columnOf, kColumnNames);
  ToolPath path;
  for (const TextTableRow& row : table.rows)
  {
    const double seconds = numberIn(row, 0);
    if (!path.seconds.empty() && seconds <= path.seconds.back())
      row.fail("time " + row.fields[0] + " s, expected one later than the row before it");
    path.seconds.push_back(seconds);
    path.tips.push_back({ numberIn(row, 1), numberIn(row, 2), numberIn(row, 3) });
  }
  if (path.tips.size() < 2)
    throw InputError(file + ": " + std::to_string(path.tips.size()) + " rows, expected a header row (" + kColumnNames +
                     ") and two places of the tool or more");
  return path;
}

Vec3 tipAt(const ToolPath& path, double seconds)
{
  const auto after = std::upper_bound(path.seconds.begin(), path.seconds.end(), seconds);
  if (after == path.seconds.begin()) return path.tips.front();
  if (after == path.seconds.end()) return path.tips.back();
  const auto k = std::size_t(after - path.seconds.begin());
  const double share = (seconds - path.seconds[k - 1]) / (path.seconds[k] - path.seconds[k - 1]);
  return path.tips[k - 1] + share * (path.tips[k] - path.tips[k - 1]);
}

} // namespace surgicalmesher
