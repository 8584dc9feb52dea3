#include "TissueLengths.h"

#include "Errors.h"
#include "TextFile.h"
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

/// Field number of each column; -1 for one that the header row lacks.
using Columns = std::array<int, ColumnCount>;

[[noreturn]] void fail(const std::string& where, const std::string& what) { throw InputError(where + ": " + what); }

Columns readHeader(const std::vector<std::string>& fields, const std::string& where)
{
  Columns columns{ -1, -1, -1, -1 };
  for (std::size_t n = 0; n < fields.size(); ++n)
  {
    const std::string name = text::lowerCase(fields[n]);
    int column = ColumnCount;
    if (name == "label" || name == "name") column = ColumnTissue;
    else if (name == "minimum") column = ColumnMinimum;
    else if (name == "maximum") column = ColumnMaximum;
    else if (name == "factor") column = ColumnFactor;
    if (column == ColumnCount || columns[column] >= 0)
    {
      fail(where, "column \"" + fields[n] + "\", expected label, minimum, maximum, factor, each at most once");
    }
    columns[column] = int(n);
  }
  if (columns[ColumnTissue] < 0) fail(where, "no column label or name in the header row");
  return columns;
}

double readValue(const std::vector<std::string>& fields, int column, double missing, const std::string& where)
{
  if (column < 0 || column >= int(fields.size()) || fields[column].empty()) return missing;
  double value = 0;
  if (!text::parseNumber(fields[column], value) || value <= 0)
  {
    fail(where, "\"" + fields[column] + "\", expected a finite number above 0");
  }
  return value;
}

} // namespace

std::map<Label, TissueLength> readTissueLengths(const std::string& file, const LengthRange& range,
                                                const TissueTable& names)
{
  std::map<Label, TissueLength> lengths;
  Columns columns{};
  bool hasHeader = false;
  const std::vector<std::string> lines = text::splitLines(text::readTextFile(file));
  for (std::size_t n = 0; n < lines.size(); ++n)
  {
    const std::string line = text::trimmed(lines[n]);
    if (line.empty() || line[0] == '#') continue;
    const std::string where = file + ":" + std::to_string(n + 1);
    const std::vector<std::string> fields = text::splitFields(line);
    if (!hasHeader)
    {
      columns = readHeader(fields, where);
      hasHeader = true;
      continue;
    }
    Label label = 0;
    const std::string tissue = columns[ColumnTissue] < int(fields.size()) ? fields[columns[ColumnTissue]] : "";
    if (!findTissue(tissue, names, label) || label == 0)
    {
      fail(where, "\"" + tissue + "\" is neither a label from 1 to 65535 nor the name of a tissue");
    }
    TissueLength length;
    length.range.minimum = readValue(fields, columns[ColumnMinimum], range.minimum, where);
    length.range.maximum = readValue(fields, columns[ColumnMaximum], range.maximum, where);
    length.factor = readValue(fields, columns[ColumnFactor], 1, where);
    if (length.range.minimum > length.range.maximum) fail(where, "the minimum edge length is above the maximum");
    if (!lengths.emplace(label, length).second) fail(where, "tissue " + tissue + " is listed for the second time");
  }
  if (lengths.empty()) throw InputError(file + ": no tissue, expected a header row and a row for each tissue");
  return lengths;
}

} // namespace surgicalmesher
