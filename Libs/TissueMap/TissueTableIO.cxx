// SPDX-License-Identifier: Apache-2.0
#include "TissueMapIO.h"

#include "Errors.h"
#include "NameFormats.h"
#include "TextFile.h"

#include <algorithm>
#include <filesystem>

namespace surgicalmesher
{

namespace
{

/// Whether words[from .. from + count) are numbers in [0, maximum].
bool parseNumbers(const std::vector<std::string>& words, std::size_t from, std::size_t count, double maximum,
                  double* out)
{
  if (from + count > words.size()) return false;
  for (std::size_t n = 0; n < count; ++n)
  {
    if (!text::parseNumber(words[from + n], out[n]) || out[n] < 0 || out[n] > maximum) return false;
  }
  return true;
}

/// Joins words [from, to), and turns the underscores that colour tables write for blanks back into blanks.
std::string joined(const std::vector<std::string>& words, std::size_t from, std::size_t to)
{
  std::string name;
  for (std::size_t n = from; n < to; ++n) name += (n > from ? " " : "") + words[n];
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

/// Parses a line of one of three forms, distinguished by the position of the numbers:
///   label R G B A visible mesh "name"   ITK-SNAP: colours to 255, A to 1
///   label name R G B [A]                Slicer: colours to 255
///   label name                          atlases; a number after the name is dropped
bool parseTissue(const std::vector<std::string>& words, Tissue& tissue)
{
  double rgba[6] = { 0, 0, 0, 0, 0, 0 };
  double index = 0;
  const std::size_t count = words.size();
  const bool isSnap = count == 8 && parseNumbers(words, 1, 6, 255, rgba);
  const bool hasAlpha = !isSnap && count >= 6 && parseNumbers(words, count - 4, 4, 255, rgba);
  const bool isSlicer = hasAlpha || (!isSnap && count >= 5 && parseNumbers(words, count - 3, 3, 255, rgba));
  if (isSnap || isSlicer) tissue.color = { rgba[0] / 255, rgba[1] / 255, rgba[2] / 255 };
  if (isSnap) tissue.name = words.back();
  else if (isSlicer) tissue.name = joined(words, 1, count - (hasAlpha ? 4 : 3));
  else tissue.name = joined(words, 1, count > 2 && text::parseNumber(words.back(), index) ? count - 1 : count);
  return count >= 2;
}

/// Reads lines of words, without a header row.
void readWords(const std::string& file, const TissueRow& take)
{
  const std::vector<std::string> lines = text::splitLines(text::readTextFile(file));
  for (std::size_t n = 0; n < lines.size(); ++n)
  {
    const std::string line = text::trimmed(lines[n]);
    if (line.empty() || line[0] == '#') continue;
    const std::string where = file + ":" + std::to_string(n + 1);
    const std::vector<std::string> words = text::splitWords(line);
    long label = 0;
    Tissue tissue;
    if (!text::parseInteger(words[0], 0, 65535, label) || !parseTissue(words, tissue))
      throw InputError(where + ": \"" + line.substr(0, 60) +
                       "\", expected a label from 0 to 65535, a name and a colour");
    take(where, words[0], tissue);
  }
}

std::string comparable(std::string name)
{
  std::replace(name.begin(), name.end(), '_', ' ');
  return text::trimmed(name);
}

} // namespace

TissueTable readTissueTable(const std::string& file, std::vector<std::string>* warnings)
{
  TissueTable table;
  const auto take = [&](const std::string& where, const std::string& text, const Tissue& tissue)
  {
    long label = 0;
    if (!text::parseInteger(text, 0, 65535, label))
      throw InputError(where + ": label \"" + text.substr(0, 60) + "\", expected one from 0 to 65535");
    if (label == 0) return;
    const bool isNew = table.count(Label(label)) == 0;
    if (!isNew && warnings && table[Label(label)].name != tissue.name)
      warnings->push_back(where + ": label " + std::to_string(label) +
                          " is listed for the second time, this row counts");
    table[Label(label)] = tissue;
  };
  const std::string extension = text::extensionOf(file);
  if (extension == ".csv" || extension == ".tsv") readNamedColumns(file, take);
  else if (extension == ".xml") readFslAtlas(file, take);
  else readWords(file, take);
  if (table.empty()) throw InputError(file + ": no tissue, expected lines of a label, a name and a colour");
  return table;
}

void completeTissueTable(TissueMap& map, const std::string& file, std::vector<std::string>* warnings)
{
  const TissueTable given = file.empty() ? TissueTable() : readTissueTable(file, warnings);
  for (const auto& [label, tissue] : given)
  {
    if (!map.table[label].isNullDisplacement) map.table[label] = tissue;
  }
  TissueTable present;
  for (const Label label : presentLabels(map))
  {
    const auto entry = map.table.find(label);
    if (entry == map.table.end()) continue;
    present.insert(*entry);
    present[label].name = text::legible(entry->second.name);
  }
  map.table = present;
}

namespace
{

std::vector<Label> tissuesNamed(const std::string& text, const TissueTable& names)
{
  std::vector<Label> found;
  for (const auto& [label, tissue] : names)
    if (!tissue.name.empty() && comparable(tissue.name) == comparable(text)) found.push_back(label);
  return found;
}

} // namespace

bool findTissue(const std::string& text, const TissueTable& names, Label& label)
{
  long number = 0;
  if (text::parseInteger(text::trimmed(text), 0, 65535, number))
  {
    label = Label(number);
    return true;
  }
  const std::vector<Label> found = tissuesNamed(text, names);
  if (found.size() != 1) return false;
  label = found.front();
  return true;
}

std::string whyNoTissue(const std::string& text, const TissueTable& names)
{
  std::vector<std::string> labels;
  for (const Label label : tissuesNamed(text, names)) labels.push_back(std::to_string(label));
  if (labels.size() < 2) return "\"" + text + "\" is neither a label nor the name of a tissue";
  return "\"" + text + "\" is the name of the tissues " + text::joined(labels, ", ") + ", expected a label";
}

} // namespace surgicalmesher
