#include "MaterialTable.h"

#include "Errors.h"
#include "TextFile.h"
#include "TissueMapIO.h"

#include <algorithm>
#include <cctype>

namespace surgicalmesher
{
namespace
{

constexpr double kMegaPascal = 1e-3;   ///< per kPa
constexpr double kTonnePerMm3 = 1e-12; ///< per kg/m^3
constexpr const char* kColumnNames[] = { "tissue", "model", "youngsmodulus", "poissonsratio", "density" };

enum Column
{
  ColumnTissue,
  ColumnModel,
  ColumnYoung,
  ColumnPoisson,
  ColumnDensity,
  ColumnCount
};

/// Field number of each column; -1 for one that the header row lacks.
using Columns = std::array<int, ColumnCount>;

[[noreturn]] void fail(const std::string& where, const std::string& what) { throw InputError(where + ": " + what); }

std::string lettersOf(const std::string& text)
{
  std::string letters;
  for (const unsigned char c : text)
  {
    if (std::isalpha(c)) letters += static_cast<char>(std::tolower(c));
  }
  return letters;
}

Columns readHeader(const std::vector<std::string>& fields, const std::string& where)
{
  const std::string expected = "expected tissue, model, youngsModulus, poissonsRatio, density, each at most once";
  Columns columns;
  columns.fill(-1);
  for (std::size_t n = 0; n < fields.size(); ++n)
  {
    const auto found = std::find(std::begin(kColumnNames), std::end(kColumnNames), lettersOf(fields[n]));
    const auto column = static_cast<std::size_t>(found - std::begin(kColumnNames));
    if (column == ColumnCount || columns[column] >= 0) fail(where, "column \"" + fields[n] + "\", " + expected);
    columns[column] = static_cast<int>(n);
  }
  for (const Column column : { ColumnTissue, ColumnYoung, ColumnPoisson })
  {
    if (columns[column] < 0) fail(where, std::string("no column ") + kColumnNames[column] + ", " + expected);
  }
  return columns;
}

/// One row of the table.
struct Row
{
  std::string where; ///< file and line
  std::vector<std::string> fields;
  const Columns& columns;

  std::string at(Column column) const
  {
    const int n = columns[column];
    return n >= 0 && n < static_cast<int>(fields.size()) ? fields[n] : std::string();
  }

  double number(Column column, double low, double high, const std::string& expected) const
  {
    double value = 0;
    if (text::parseNumber(at(column), value) && value > low && value < high) return value;
    fail(where, std::string(kColumnNames[column]) + " \"" + at(column) + "\", expected " + expected);
  }
};

Label readTissue(const Row& row, const TissueTable& names, const std::set<Label>& present)
{
  const std::string tissue = row.at(ColumnTissue);
  Label label = 0;
  if (!findTissue(tissue, names, label)) fail(row.where, "\"" + tissue + "\" is neither a label nor a tissue's name");
  if (present.count(label) == 0) fail(row.where, "tissue " + tissue + " is not in the mesh, expected one that is");
  return label;
}

MaterialLaw readLaw(const Row& row)
{
  const std::string model = lettersOf(row.at(ColumnModel));
  if (row.at(ColumnModel).empty() || model == "neohookean") return MaterialLaw::NeoHookean;
  if (model == "linear" || model == "linearelastic") return MaterialLaw::LinearElastic;
  fail(row.where, "model \"" + row.at(ColumnModel) + "\", expected linear or neo-Hookean");
}

TissueMaterial readMaterial(const Row& row)
{
  constexpr double huge = 1e30;
  TissueMaterial material;
  material.nonlinearLaw = readLaw(row);
  material.youngsModulus = kMegaPascal * row.number(ColumnYoung, 0, huge, "a finite number above 0 (kPa)");
  material.poissonsRatio = row.number(ColumnPoisson, -1, 0.5, "a number between -1 and 0.5");
  if (!row.at(ColumnDensity).empty())
    material.density = kTonnePerMm3 * row.number(ColumnDensity, 0, huge, "a finite number above 0 (kg/m^3)");
  return material;
}

} // namespace

std::map<Label, TissueMaterial> readMaterialTable(const std::string& file, const TissueTable& names,
                                                  const std::set<Label>& present)
{
  std::map<Label, TissueMaterial> materials;
  Columns columns{};
  bool hasHeader = false;
  const std::vector<std::string> lines = text::splitLines(text::readTextFile(file));
  for (std::size_t n = 0; n < lines.size(); ++n)
  {
    const std::string line = text::trimmed(lines[n]);
    if (line.empty() || line[0] == '#') continue;
    const Row row{ file + ":" + std::to_string(n + 1), text::splitFields(line), columns };
    if (!hasHeader) columns = readHeader(row.fields, row.where);
    else if (!materials.emplace(readTissue(row, names, present), readMaterial(row)).second)
      fail(row.where, "tissue " + row.at(ColumnTissue) + " is listed for the second time");
    hasHeader = true;
  }
  if (materials.empty()) throw InputError(file + ": no tissue, expected a header row and a row for each tissue");
  return materials;
}

} // namespace surgicalmesher
