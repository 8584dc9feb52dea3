// SPDX-License-Identifier: Apache-2.0
#include "TissueLengths.h"

#include "Errors.h"
#include "TextFile.h"
#include "TextTable.h"
#include "TissueMapIO.h"

#include <algorithm>
#include <set>

namespace surgicalmesher
{

namespace
{

enum Column
{
  ColumnTissue,
  ColumnMinimum,
  ColumnMaximum,
  ColumnFactor,
  ColumnCount
};

int columnOf(const std::string& field)
{
  const std::string name = text::lowerCase(field);
  if (name == "label" || name == "name") return ColumnTissue;
  if (name == "minimum") return ColumnMinimum;
  if (name == "maximum") return ColumnMaximum;
  return name == "factor" ? ColumnFactor : -1;
}

double readValue(const TextTableRow& row, Column column, double missing)
{
  const std::string& field = row.fields[column];
  if (field.empty()) return missing;
  double value = 0;
  if (!text::parseNumber(field, value) || value <= 0)
  {
    row.fail("\"" + field + "\", expected a finite number above 0");
  }
  return value;
}

} // namespace

std::map<Label, TissueLength> readTissueLengths(const std::string& file, const LengthRange& range,
                                                const TissueTable& names)
{
  const TextTable table = readTextTable(file, ColumnCount, columnOf, "label, minimum, maximum, factor");
  if (!table.header.where.empty() && table.header.fields[ColumnTissue].empty())
    table.header.fail("no column label or name in the header row");
  std::map<Label, TissueLength> lengths;
  for (const TextTableRow& row : table.rows)
  {
    Label label = 0;
    const std::string& tissue = row.fields[ColumnTissue];
    if (!findTissue(tissue, names, label)) row.fail(whyNoTissue(tissue, names));
    if (label == 0) row.fail("\"" + tissue + "\" is neither a label from 1 to 65535 nor the name of a tissue");
    TissueLength length;
    length.range.minimum = readValue(row, ColumnMinimum, range.minimum);
    length.range.maximum = readValue(row, ColumnMaximum, range.maximum);
    length.factor = readValue(row, ColumnFactor, 1);
    if (length.range.minimum > length.range.maximum) row.fail("the minimum edge length is above the maximum");
    if (!lengths.emplace(label, length).second) row.fail("tissue " + tissue + " is listed for the second time");
  }
  if (lengths.empty()) throw InputError(file + ": no tissue, expected a header row and a row for each tissue");
  return lengths;
}

} // namespace surgicalmesher
