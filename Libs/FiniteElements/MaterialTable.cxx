// SPDX-License-Identifier: Apache-2.0
#include "MaterialTable.h"

#include "Errors.h"
#include "Structures.h"
#include "TextFile.h"
#include "TextTable.h"
#include "TissueMapIO.h"

#include <algorithm>
#include <cctype>

namespace surgicalmesher
{
namespace
{

// Divisors rather than factors: powers of ten are exact in binary floating point, their inverses are not, and 9 kPa
// must become 0.009 MPa.
constexpr double kKiloPascal = 1e3;     ///< per MPa
constexpr double kKilogramPerM3 = 1e12; ///< per tonne/mm^3
constexpr const char* kColumnNames[] = { "tissue", "model", "youngsModulus", "poissonsRatio", "density" };

enum Column
{
  ColumnTissue,
  ColumnModel,
  ColumnYoung,
  ColumnPoisson,
  ColumnDensity,
  ColumnCount
};

std::string lettersOf(const std::string& text)
{
  std::string letters;
  for (const unsigned char c : text)
  {
    if (std::isalpha(c)) letters += static_cast<char>(std::tolower(c));
  }
  return letters;
}

int columnOf(const std::string& name)
{
  const auto found = std::find_if(std::begin(kColumnNames), std::end(kColumnNames),
                                  [&](const char* known) { return lettersOf(known) == lettersOf(name); });
  return found == std::end(kColumnNames) ? -1 : int(found - std::begin(kColumnNames));
}

double numberIn(const TextTableRow& row, Column column, double low, double high, const std::string& expected)
{
  const std::string& field = row.fields[column];
  double value = 0;
  if (text::parseNumber(field, value) && value > low && value < high) return value;
  row.fail(std::string(kColumnNames[column]) + " \"" + field + "\", expected " + expected);
}

Label readTissue(const TextTableRow& row, const TissueTable& names, const std::set<Label>& present)
{
  const std::string tissue = row.fields[ColumnTissue];
  Label label = 0;
  if (!findTissue(tissue, names, label)) row.fail(whyNoTissue(tissue, names));
  if (present.count(label) == 0) row.fail("tissue " + tissue + " is not in the mesh, expected one that is");
  return label;
}

MaterialLaw readLaw(const TextTableRow& row)
{
  const std::string model = lettersOf(row.fields[ColumnModel]);
  if (row.fields[ColumnModel].empty() || model == "neohookean") return MaterialLaw::NeoHookean;
  if (model == "linear" || model == "linearelastic") return MaterialLaw::LinearElastic;
  row.fail("model \"" + row.fields[ColumnModel] + "\", expected linear or neo-Hookean");
}

TissueMaterial readMaterial(const TextTableRow& row)
{
  constexpr double huge = 1e30;
  TissueMaterial material;
  material.nonlinearLaw = readLaw(row);
  material.youngsModulus = numberIn(row, ColumnYoung, 0, huge, "a number above 0 and below 1e30 (kPa)") / kKiloPascal;
  material.poissonsRatio = numberIn(row, ColumnPoisson, -1, 0.5, "a number between -1 and 0.5");
  if (!row.fields[ColumnDensity].empty())
    material.density =
      numberIn(row, ColumnDensity, 0, huge, "a number above 0 and below 1e30 (kg/m^3)") / kKilogramPerM3;
  return material;
}

std::string warningOfMissing(const std::map<Label, TissueMaterial>& materials, const std::set<Label>& present,
                             const TissueTable& names, const std::string& file)
{
  std::vector<std::string> missing;
  for (const Label label : present)
    if (materials.count(label) == 0) missing.push_back(nameOf(label, names));
  if (missing.empty()) return {};
  return file + ": no row for " + std::to_string(missing.size()) + " of " + std::to_string(present.size()) +
         " tissues, which get the default of soft tissue, 3 kPa: " + text::joined(missing, ", ");
}

} // namespace

std::map<Label, TissueMaterial> readMaterialTable(const std::string& file, const TissueTable& names,
                                                  const std::set<Label>& present, std::vector<std::string>* warnings)
{
  const std::string columnNames = "tissue, model, youngsModulus, poissonsRatio, density";
  const TextTable table = readTextTable(file, ColumnCount, columnOf, columnNames);
  for (const Column column : { ColumnTissue, ColumnYoung, ColumnPoisson })
  {
    if (!table.header.where.empty() && table.header.fields[column].empty())
      table.header.fail(std::string("no column ") + kColumnNames[column] + ", expected " + columnNames +
                        ", each at most once");
  }
  std::map<Label, TissueMaterial> materials;
  for (const TextTableRow& row : table.rows)
  {
    if (!materials.emplace(readTissue(row, names, present), readMaterial(row)).second)
      row.fail("tissue " + row.fields[ColumnTissue] + " is listed for the second time");
  }
  if (materials.empty()) throw InputError(file + ": no tissue, expected a header row and a row for each tissue");
  const std::string missing = warnings ? warningOfMissing(materials, present, names, file) : std::string();
  if (!missing.empty()) warnings->push_back(missing);
  return materials;
}

} // namespace surgicalmesher
