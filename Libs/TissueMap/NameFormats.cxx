// SPDX-License-Identifier: Apache-2.0
#include "NameFormats.h"

#include "Errors.h"
#include "TextFile.h"

#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkXMLParser.h>

#include <algorithm>
#include <string>
#include <vector>

namespace surgicalmesher
{

namespace
{

bool endsWith(const std::string& text, const std::string& end)
{
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

std::vector<std::string> fieldsOf(const std::string& line, bool tabs)
{
  if (!tabs) return text::splitFields(line);
  std::vector<std::string> fields(1);
  for (const char c : line)
  {
    if (c == '\t') fields.emplace_back();
    else fields.back() += c;
  }
  for (std::string& field : fields) field = text::trimmed(field);
  return fields;
}

/// The columns of a header row by lower-case name.
class Columns
{
public:
  explicit Columns(std::vector<std::string> names) : m_Names(std::move(names))
  {
    for (std::string& name : m_Names) name = text::lowerCase(name);
  }

  /// The row's field in the first of the columns `names` that the table has and that is neither empty in the row nor
  /// BIDS' word for it.
  std::string field(const std::vector<std::string>& row, const std::vector<std::string>& names) const
  {
    for (const std::string& name : names)
    {
      const auto found = std::find(m_Names.begin(), m_Names.end(), name);
      const std::size_t at = std::size_t(found - m_Names.begin());
      if (found != m_Names.end() && at < row.size() && !row[at].empty() && row[at] != "n/a") return row[at];
    }
    return {};
  }

  bool has(const std::vector<std::string>& names) const { return !field(m_Names, names).empty(); }

private:
  std::vector<std::string> m_Names;
};

const std::vector<std::string> labelColumns{ "labelvalue", "label", "index", "id", "value" };
const std::vector<std::string> nameColumns{ "name", "type_codemeaning", "region", "abbreviation" };

/// Reads the colour from three columns of 0 to 255 or one of #RRGGBB; otherwise it stays grey.
void readColor(const Columns& columns, const std::vector<std::string>& row, Tissue& tissue)
{
  const std::vector<std::vector<std::string>> names{ { "color_r", "r", "red" },
                                                     { "color_g", "g", "green" },
                                                     { "color_b", "b", "blue" } };
  std::array<double, 3> rgb{};
  int found = 0;
  for (std::size_t c = 0; c < 3; ++c)
    found += text::parseNumber(columns.field(row, names[c]), rgb[c]) && rgb[c] >= 0 && rgb[c] <= 255;
  const std::string hex = columns.field(row, { "color", "colour" });
  if (hex.size() == 7 && hex[0] == '#' && hex.find_first_not_of("0123456789abcdefABCDEF", 1) == std::string::npos)
  {
    for (std::size_t c = 0; c < 3; ++c) rgb[c] = std::stoi(hex.substr(1 + 2 * c, 2), nullptr, 16);
    found = 3;
  }
  if (found == 3) tissue.color = { rgb[0] / 255, rgb[1] / 255, rgb[2] / 255 };
}

/// Extracts only the labels and the type of an atlas, however deep or wide the file is.
class FslParser : public vtkXMLParser
{
public:
  static FslParser* New();
  vtkTypeMacro(FslParser, vtkXMLParser);

  struct Entry
  {
    std::string index, name;
  };
  bool isAtlas = false;
  std::string type;
  std::vector<Entry> entries;

protected:
  void StartElement(const char* name, const char** attributes) override
  {
    m_Element = name;
    isAtlas = isAtlas || m_Element == "atlas";
    if (m_Element != "label") return;
    entries.emplace_back();
    for (; attributes[0] && attributes[1]; attributes += 2)
    {
      if (std::string(attributes[0]) == "index") entries.back().index = text::trimmed(attributes[1]);
    }
  }
  void EndElement(const char*) override { m_Element.clear(); }
  void CharacterDataHandler(const char* text, int length) override
  {
    if (m_Element == "label") entries.back().name.append(text, std::size_t(length));
    if (m_Element == "type") type.append(text, std::size_t(length));
  }

private:
  std::string m_Element;
};
vtkStandardNewMacro(FslParser);

} // namespace

void readNamedColumns(const std::string& file, const TissueRow& take)
{
  const bool tabs = endsWith(text::lowerCase(file), ".tsv");
  const std::vector<std::string> lines = text::splitLines(text::readTextFile(file));
  Columns columns({});
  bool isHeader = true;
  for (std::size_t n = 0; n < lines.size(); ++n)
  {
    if (text::trimmed(lines[n]).empty() || lines[n][0] == '#') continue;
    const std::vector<std::string> row = fieldsOf(lines[n], tabs);
    const std::string where = file + ":" + std::to_string(n + 1);
    if (!isHeader)
    {
      Tissue tissue;
      tissue.name = columns.field(row, nameColumns);
      std::replace(tissue.name.begin(), tissue.name.end(), '_', ' ');
      readColor(columns, row, tissue);
      take(where, columns.field(row, labelColumns), tissue);
      continue;
    }
    columns = Columns(row);
    isHeader = false;
    if (!columns.has(labelColumns) || !columns.has(nameColumns))
      throw InputError(where + ": \"" + lines[n].substr(0, 60) + "\", expected a header row with the columns " +
                       (tabs ? "index and name" : "LabelValue and Name"));
  }
}

void readFslAtlas(const std::string& file, const TissueRow& take)
{
  const std::string content = text::readTextFile(file);
  vtkNew<FslParser> parser;
  const bool isXml = parser->Parse(content.data(), unsigned(content.size())) != 0;
  if (!isXml || !parser->isAtlas)
    throw InputError(file + ": " + (isXml ? "XML of another kind" : "not well-formed XML") +
                     ", expected FSL's description of an atlas, an element atlas with elements label");
  const bool isProbabilistic = text::lowerCase(text::trimmed(parser->type)).compare(0, 4, "prob") == 0;
  for (const FslParser::Entry& entry : parser->entries)
  {
    Tissue tissue;
    tissue.name = text::trimmed(entry.name);
    long index = 0;
    const bool isNumber = text::parseInteger(entry.index, 0, 65535, index);
    take(file, isNumber && isProbabilistic ? std::to_string(index + 1) : entry.index, tissue);
  }
}

} // namespace surgicalmesher
