// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Small tables of comma-separated values whose first row names the columns. Empty lines and lines that begin with #
/// are skipped.

#include <functional>
#include <string>
#include <vector>

namespace surgicalmesher
{

struct TextTableRow
{
  std::string where;               ///< FILE:LINE
  std::vector<std::string> fields; ///< by column; empty where the table or this row lacks it

  /// Throws InputError: "FILE:LINE: what".
  [[noreturn]] void fail(const std::string& what) const;
};

struct TextTable
{
  TextTableRow header; ///< the names as the file has them, by column; `where` is empty in a file without any row
  std::vector<TextTableRow> rows;
};

/// Reads a table of `columns` columns. `columnOf` maps a name of the first row to its column, from 0 to columns - 1;
/// -1: unknown. `names` lists all names for messages. Throws InputError if the file cannot be read, for unknown or
/// repeated names, and for rows with more fields than the first.
TextTable readTextTable(const std::string& file, int columns, const std::function<int(const std::string&)>& columnOf,
                        const std::string& names);

} // namespace surgicalmesher
