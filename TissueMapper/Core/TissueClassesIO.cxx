// SPDX-License-Identifier: Apache-2.0
#include "TissueClassesIO.h"

#include "Errors.h"
#include "TextFile.h"
#include "TextTable.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>

namespace surgicalmesher
{

namespace
{

enum Column
{
  ColumnLabel,
  ColumnName,
  ColumnCompartment,
  ColumnContiguity,
  ColumnLimit,
  ColumnCount
};

const std::array<const char*, ColumnCount> columnNames{ "label", "name", "compartment", "contiguity", "limit" };

int columnOf(const std::string& name)
{
  const auto found = std::find(columnNames.begin(), columnNames.end(), text::lowerCase(name));
  return found == columnNames.end() ? -1 : int(found - columnNames.begin());
}

Admission readAdmission(const TextTableRow& row, const std::string& name)
{
  const std::string field = text::lowerCase(row.fields[ColumnCompartment]);
  if (field.empty()) return usualAdmission(name);
  if (field == "intracranial") return Admission::Intracranial;
  if (field == "extracranial") return Admission::Extracranial;
  if (field == "intraorbital") return Admission::Intraorbital;
  if (field == "bone") return Admission::Bone;
  if (field == "any") return Admission::Anywhere;
  row.fail("compartment \"" + field + "\", expected intracranial, intraorbital, extracranial, bone or any");
}

bool readContiguity(const TextTableRow& row)
{
  const std::string field = text::lowerCase(row.fields[ColumnContiguity]);
  if (field == "yes") return true;
  if (field.empty() || field == "no") return false;
  row.fail("contiguity \"" + field + "\", expected yes or no");
}

void applyRow(const TextTableRow& row, TissueClass& tissue)
{
  long label = 0;
  const std::string field = row.fields[ColumnLabel];
  if (!text::parseInteger(field, 1, 65535, label)) row.fail("label \"" + field + "\", expected 1 to 65535");
  tissue.label = Label(label);
  tissue.admission = readAdmission(row, tissue.name);
  tissue.isContiguous = readContiguity(row);
  const std::string limit = row.fields[ColumnLimit];
  if (!limit.empty() && (!text::parseNumber(limit, tissue.limit) || tissue.limit < 0))
    row.fail("limit \"" + limit + "\", expected a distance in mm of at least 0");
  if (tissue.admission == Admission::Bone && isBound(tissue))
    row.fail("contiguity or a limit for bone, expected neither: bone is told by brightness alone");
}

std::vector<TissueClass>::iterator findClass(std::vector<TissueClass>& classes, const std::string& name)
{
  return std::find_if(classes.begin(), classes.end(),
                      [&](const TissueClass& tissue) { return text::lowerCase(tissue.name) == text::lowerCase(name); });
}

/// Applies the rows of the table to the classes. `source` names the origin of the training points in messages.
void applyTable(std::vector<TissueClass>& classes, const std::string& classesFile, const std::string& source)
{
  const TextTable table =
    readTextTable(classesFile, ColumnCount, columnOf, "label, name, compartment, contiguity and limit");
  std::vector<bool> isListed(classes.size(), false);
  for (const TextTableRow& row : table.rows)
  {
    const std::string name = row.fields[ColumnName];
    if (name.empty()) row.fail("no name, expected that of a class");
    const auto found = findClass(classes, name);
    if (found == classes.end()) row.fail("class " + name + " has no training point in " + source);
    const std::size_t number = std::size_t(found - classes.begin());
    if (isListed[number]) row.fail("class " + name + " is there twice");
    isListed[number] = true;
    applyRow(row, *found);
    for (std::size_t other = 0; other < classes.size(); ++other)
    {
      if (isListed[other] && other != number && classes[other].label == found->label)
        row.fail("label " + std::to_string(found->label) + " is that of " + classes[other].name);
    }
  }
  for (std::size_t n = 0; n < classes.size(); ++n)
  {
    if (!isListed[n])
      throw InputError(classesFile + ": class " + classes[n].name + " is trained, but not in the table");
  }
}

} // namespace

std::vector<TissueClass> trainedClasses(const std::vector<Markup>& training, const std::string& source)
{
  std::vector<TissueClass> classes;
  for (const Markup& markup : training)
  {
    for (std::size_t n = 0; n < markup.points.size(); ++n)
    {
      const std::string name = text::legible(text::trimmed(markup.labels[n]));
      if (name.empty()) throw InputError(source + ": a training point without a label, expected the name of its class");
      auto found = findClass(classes, name);
      if (found == classes.end())
      {
        TissueClass tissue;
        tissue.name = name;
        tissue.label = Label(classes.size() + 1);
        tissue.admission = usualAdmission(name);
        found = classes.insert(classes.end(), tissue);
      }
      found->points.push_back(markup.points[n]);
    }
  }
  return classes;
}

std::vector<TissueClass> tissueClasses(const std::vector<Markup>& training, const std::string& source,
                                       const std::string& classesFile)
{
  std::vector<TissueClass> classes = trainedClasses(training, source);
  if (classes.empty()) throw InputError(source + ": no training point, expected some of two classes or more");
  if (classes.size() < 2)
    throw InputError(source + ": one class, " + classes.front().name + ", is trained, expected two or more");
  if (!classesFile.empty()) applyTable(classes, classesFile, source);
  return classes;
}

std::vector<TissueClass> readTissueClasses(const std::string& trainingFile, const std::string& classesFile)
{
  return tissueClasses(readLabelledMarkups(trainingFile), trainingFile, classesFile);
}

void writeTissueNames(const TissueTable& table, const std::string& file)
{
  std::ofstream stream(file.c_str(), std::ios::binary);
  for (const auto& entry : table)
  {
    std::string name = entry.second.name;
    std::replace(name.begin(), name.end(), ' ', '_');
    stream << entry.first << ' ' << name;
    for (const double part : entry.second.color) stream << ' ' << std::lround(255 * part);
    stream << " 255\n";
  }
  stream << std::flush;
  if (!stream) throw InputError(file + ": the names cannot be written whole");
}

} // namespace surgicalmesher
