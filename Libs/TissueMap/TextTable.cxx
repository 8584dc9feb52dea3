// SPDX-License-Identifier: Apache-2.0
#include "TextTable.h"

#include "Errors.h"
#include "TextFile.h"

#include <algorithm>

namespace surgicalmesher
{

namespace
{

/// The column of each field of the first row.
std::vector<int> columnsOf(const TextTableRow& first, const std::function<int(const std::string&)>& columnOf,
                           const std::string& names)
{
  std::vector<int> columns;
  for (const std::string& field : first.fields)
  {
    const int column = columnOf(field);
    const bool isRepeated = std::find(columns.begin(), columns.end(), column) != columns.end();
    if (column < 0 || isRepeated) first.fail("column \"" + field + "\", expected " + names + ", each at most once");
    columns.push_back(column);
  }
  return columns;
}

std::vector<std::string> byColumn(const std::vector<std::string>& fields, const std::vector<int>& columnOfField,
                                  int columns)
{
  std::vector<std::string> result(columns);
  for (std::size_t n = 0; n < fields.size() && n < columnOfField.size(); ++n) result[columnOfField[n]] = fields[n];
  return result;
}

} // namespace

void TextTableRow::fail(const std::string& what) const { throw InputError(where + ": " + what); }

TextTable readTextTable(const std::string& file, int columns, const std::function<int(const std::string&)>& columnOf,
                        const std::string& names)
{
  TextTable table;
  std::vector<int> columnOfField;
  const std::vector<std::string> lines = text::splitLines(text::readTextFile(file));
  for (std::size_t n = 0; n < lines.size(); ++n)
  {
    const std::string line = text::trimmed(lines[n]);
    if (line.empty() || line[0] == '#') continue;
    TextTableRow row{ file + ":" + std::to_string(n + 1), text::splitFields(text::legible(line)) };
    const bool isHeader = table.header.where.empty();
    if (isHeader) columnOfField = columnsOf(row, columnOf, names);
    if (row.fields.size() > columnOfField.size())
      row.fail(std::to_string(row.fields.size()) + " fields, expected at most " + std::to_string(columnOfField.size()) +
               ", the columns of the header row");
    row.fields = byColumn(row.fields, columnOfField, columns);
    if (isHeader) table.header = row;
    else table.rows.push_back(row);
  }
  return table;
}

} // namespace surgicalmesher
