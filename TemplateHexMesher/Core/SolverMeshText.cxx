// SPDX-License-Identifier: Apache-2.0
#include "SolverMeshText.h"

#include "Errors.h"
#include "TextFile.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <optional>
#include <unordered_map>

namespace surgicalmesher
{
namespace
{

using Fields = std::vector<std::string>;

[[noreturn]] void refuseLine(const std::string& file, std::size_t line, const std::string& text,
                             const std::string& expected)
{
  throw InputError(file + ":" + std::to_string(line + 1) + ": \"" + text.substr(0, 60) + "\", expected " + expected);
}

/// Returns the id in a field; 0 if the field is not an id.
std::int64_t idOf(const std::string& field)
{
  long value = 0;
  return text::parseInteger(text::trimmed(field), 1, std::numeric_limits<std::int32_t>::max(), value) ? value : 0;
}

/// Maps the ids of the file to indices from 0.
class Numbering
{
public:
  Numbering(const std::string& file, const char* what) : m_File(file), m_What(what) {}

  void add(std::int64_t id)
  {
    if (!m_Indices.emplace(id, std::int32_t(m_Indices.size())).second)
      throw InputError(m_File + ": " + m_What + " " + std::to_string(id) + " stands twice, expected every id once");
  }

  std::int32_t at(std::int64_t id) const
  {
    const auto found = m_Indices.find(id);
    if (found == m_Indices.end())
      throw InputError(m_File + ": " + m_What + " " + std::to_string(id) + " is not there, but it is referred to");
    return found->second;
  }

private:
  std::string m_File;
  const char* m_What;
  std::unordered_map<std::int64_t, std::int32_t> m_Indices;
};

std::optional<Eigen::Vector3d> coordinatesOf(const Fields& fields, std::size_t first)
{
  Eigen::Vector3d p = Eigen::Vector3d::Zero();
  for (std::size_t axis = 0; axis < 3 && first + axis < fields.size(); ++axis)
  {
    const std::string field = text::trimmed(fields[first + axis]);
    if (!field.empty() && !text::parseNumber(field, p[int(axis)])) return {};
  }
  return p;
}

Points columnsOf(const std::vector<Eigen::Vector3d>& points)
{
  Points columns(3, Eigen::Index(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i) columns.col(Eigen::Index(i)) = points[i];
  return columns;
}

void makeUnique(std::map<std::string, std::vector<std::int32_t>>& sets)
{
  for (auto& [name, ids] : sets)
  {
    std::sort(ids.begin(), ids.end());
    ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  }
}

// ---- Abaqus ---------------------------------------------------------------------------------------------------------

/// A line such as *ELEMENT, TYPE=C3D8, ELSET=skin. Keywords and parameter names in upper case.
struct Keyword
{
  std::string name;
  std::map<std::string, std::string> parameters;

  std::string operator[](const std::string& parameter) const
  {
    const auto found = parameters.find(parameter);
    return found == parameters.end() ? std::string() : found->second;
  }
};

std::string upperCase(std::string text)
{
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return char(std::toupper(c)); });
  return text;
}

Keyword parseKeyword(const std::string& line)
{
  const Fields fields = text::splitFields(line);
  Keyword keyword;
  keyword.name = upperCase(fields[0].substr(1));
  for (std::size_t i = 1; i < fields.size(); ++i)
  {
    const std::size_t equals = fields[i].find('=');
    keyword.parameters[upperCase(text::trimmed(fields[i].substr(0, equals)))] =
      equals == std::string::npos ? "" : text::trimmed(fields[i].substr(equals + 1));
  }
  return keyword;
}

bool isComment(const std::string& line) { return line.compare(0, 2, "**") == 0; }
bool isKeyword(const std::string& line) { return !line.empty() && line[0] == '*' && !isComment(line); }

std::optional<ElementShape> shapeOfAbaqus(const std::string& type)
{
  const std::pair<const char*, ElementShape> known[] = { { "C3D4", ElementShape::Tetrahedron },
                                                         { "C3D6", ElementShape::Wedge },
                                                         { "C3D8", ElementShape::Hexahedron },
                                                         { "S3", ElementShape::Triangle },
                                                         { "S4", ElementShape::Quad } };
  for (const auto& [name, shape] : known)
  {
    const std::string prefix = name;
    const bool longer = type.size() > prefix.size() && std::isdigit(static_cast<unsigned char>(type[prefix.size()]));
    if (type.compare(0, prefix.size(), prefix) == 0 && !longer) return shape;
  }
  return {};
}

class AbaqusReader
{
public:
  explicit AbaqusReader(const std::string& file) : m_File(file), m_Nodes(file, "node"), m_Elements(file, "element") {}

  SolverMesh read()
  {
    const Fields lines = text::splitLines(text::readTextFile(m_File));
    for (m_Line = 0; m_Line < lines.size(); ++m_Line)
    {
      const std::string line = text::trimmed(lines[m_Line]);
      if (line.empty() || isComment(line)) continue;
      if (isKeyword(line)) beginBlock(line);
      else readData(line);
    }
    finish();
    return std::move(m_Mesh);
  }

private:
  /// A member of a set. Members are resolved at the end of the file, as sets may precede their nodes and elements.
  struct SetEntry
  {
    bool ofNodes;
    std::string set;
    std::int64_t id = 0;
    std::string otherSet;  ///< name of an included set, in place of an id
    std::int64_t last = 0; ///< if not 0, the entry is the ids that exist among id, id + step, ..., last
    std::int64_t step = 1;
  };

  void beginBlock(const std::string& line)
  {
    requireWholeElement();
    m_Keyword = parseKeyword(line);
    const std::string system = upperCase(m_Keyword["SYSTEM"]);
    if (m_Keyword.name == "NODE" && !system.empty() && system != "R")
      refuseLine(m_File, m_Line, line, "rectangular coordinates (SYSTEM=R)");
    if (m_Keyword.name != "ELEMENT") return;
    const std::string type = upperCase(m_Keyword["TYPE"]);
    const auto shape = shapeOfAbaqus(type);
    if (!shape) refuseLine(m_File, m_Line, line, "TYPE=C3D4, C3D6, C3D8, S3 or S4");
    m_Shape = *shape;
  }

  void readData(const std::string& line)
  {
    const Fields fields = text::splitFields(line);
    if (m_Keyword.name == "NODE") readNode(line, fields);
    else if (m_Keyword.name == "ELEMENT") readElement(line, fields);
    else if (m_Keyword.name == "SYSTEM")
      refuseLine(m_File, m_Line, line, "nodes in the global system, without a *SYSTEM of their own");
    else if (m_Keyword.name == "ELSET" || m_Keyword.name == "NSET") readSet(line, fields);
  }

  void readNode(const std::string& line, const Fields& fields)
  {
    const std::int64_t id = idOf(fields[0]);
    const auto position = coordinatesOf(fields, 1);
    if (!id || !position) refuseLine(m_File, m_Line, line, "a node's id and coordinates");
    m_Nodes.add(id);
    m_Mesh.nodeIds.push_back(id);
    m_Points.push_back(*position);
    addToSet(true, m_Keyword["NSET"], id);
  }

  /// The nodes of an element may continue over several lines.
  void readElement(const std::string& line, const Fields& fields)
  {
    for (const std::string& field : fields)
    {
      if (field.empty()) continue;
      const std::int64_t id = idOf(field);
      if (!id) refuseLine(m_File, m_Line, line, "ids of an element and its nodes");
      m_Pending.push_back(id);
    }
    const std::size_t wanted = std::size_t(nodeCount(m_Shape)) + 1;
    if (m_Pending.size() < wanted) return;
    if (m_Pending.size() > wanted) refuseLine(m_File, m_Line, line, std::to_string(wanted) + " ids");
    m_Elements.add(m_Pending[0]);
    m_Mesh.elementIds.push_back(m_Pending[0]);
    m_Shapes.push_back(m_Shape);
    m_NodesOf.insert(m_NodesOf.end(), m_Pending.begin() + 1, m_Pending.end());
    addToSet(false, m_Keyword["ELSET"], m_Pending[0]);
    m_Pending.clear();
  }

  void requireWholeElement() const
  {
    if (m_Pending.empty()) return;
    throw InputError(m_File + ": element " + std::to_string(m_Pending[0]) + " has " +
                     std::to_string(m_Pending.size() - 1) + " of its " + std::to_string(nodeCount(m_Shape)) +
                     " nodes, expected all its nodes");
  }

  void readSet(const std::string& line, const Fields& fields)
  {
    const bool ofNodes = m_Keyword.name == "NSET";
    const std::string set = m_Keyword[m_Keyword.name];
    if (m_Keyword.parameters.count("GENERATE"))
    {
      const std::int64_t first = idOf(fields[0]), last = fields.size() > 1 ? idOf(fields[1]) : 0;
      const std::int64_t step = fields.size() > 2 && !fields[2].empty() ? idOf(fields[2]) : 1;
      if (!first || !last || !step) refuseLine(m_File, m_Line, line, "first, last and step of a set");
      if (!set.empty()) m_Entries.push_back({ ofNodes, spelled(ofNodes, set), first, "", last, step });
      return;
    }
    for (const std::string& field : fields)
    {
      if (field.empty()) continue;
      const std::int64_t id = idOf(field);
      m_Entries.push_back({ ofNodes, spelled(ofNodes, set), id, id ? "" : spelled(ofNodes, field) });
    }
  }

  /// Returns the name of a set as it was first written, because upper and lower case are the same in Abaqus.
  std::string spelled(bool ofNodes, const std::string& set)
  {
    return m_Spellings[ofNodes].try_emplace(upperCase(set), set).first->second;
  }

  void addToSet(bool ofNodes, const std::string& set, std::int64_t id)
  {
    if (!set.empty()) m_Entries.push_back({ ofNodes, spelled(ofNodes, set), id, "" });
  }

  void finish()
  {
    requireWholeElement();
    m_Mesh.mesh.points = columnsOf(m_Points);
    std::size_t next = 0;
    for (const ElementShape shape : m_Shapes)
    {
      Element element{ shape, {} };
      for (int i = 0; i < nodeCount(shape); ++i) element.nodes[i] = m_Nodes.at(m_NodesOf[next++]);
      m_Mesh.mesh.elements.push_back(element);
    }
    for (const SetEntry& entry : m_Entries)
    {
      const std::vector<std::int32_t> members = membersOf(entry);
      std::vector<std::int32_t>& set = (entry.ofNodes ? m_Mesh.nodeSets : m_Mesh.elementSets)[entry.set];
      set.insert(set.end(), members.begin(), members.end());
    }
    makeUnique(m_Mesh.nodeSets);
    makeUnique(m_Mesh.elementSets);
  }

  std::vector<std::int32_t> membersOf(const SetEntry& entry) const
  {
    if (entry.last != 0) return membersInRange(entry);
    if (entry.otherSet.empty()) return { (entry.ofNodes ? m_Nodes : m_Elements).at(entry.id) };
    const auto& sets = entry.ofNodes ? m_Mesh.nodeSets : m_Mesh.elementSets;
    const auto other = sets.find(entry.otherSet);
    if (entry.otherSet != entry.set && other != sets.end()) return other->second;
    throw InputError(m_File + ": set " + entry.set + " refers to " + entry.otherSet + ", which is not there");
  }

  /// Goes through the ids that exist, since a range may have far more.
  std::vector<std::int32_t> membersInRange(const SetEntry& entry) const
  {
    const std::vector<std::int64_t>& ids = entry.ofNodes ? m_Mesh.nodeIds : m_Mesh.elementIds;
    std::vector<std::int32_t> members;
    for (std::size_t i = 0; i < ids.size(); ++i)
    {
      if (ids[i] >= entry.id && ids[i] <= entry.last && (ids[i] - entry.id) % entry.step == 0)
        members.push_back(std::int32_t(i));
    }
    if (!members.empty()) return members;
    throw InputError(m_File + ": set " + entry.set + " has no member from " + std::to_string(entry.id) + " to " +
                     std::to_string(entry.last) + ", expected ids that are there");
  }

  std::string m_File;
  SolverMesh m_Mesh;
  Numbering m_Nodes, m_Elements;
  std::vector<Eigen::Vector3d> m_Points;
  std::vector<ElementShape> m_Shapes;
  std::vector<std::int64_t> m_NodesOf, m_Pending;
  std::vector<SetEntry> m_Entries;
  std::map<std::string, std::string> m_Spellings[2]; ///< of element sets, of node sets, by name in upper case
  Keyword m_Keyword;
  ElementShape m_Shape = ElementShape::Hexahedron;
  std::size_t m_Line = 0;
};

// ---- Ansys ----------------------------------------------------------------------------------------------------------

Fields columnsOf(const std::string& line, const std::vector<std::size_t>& widths)
{
  Fields fields;
  std::size_t begin = 0;
  for (const std::size_t width : widths)
  {
    fields.push_back(begin < line.size() ? text::trimmed(line.substr(begin, width)) : "");
    begin += width;
  }
  return fields;
}

bool isColumn(const std::string& field) { return field.find_first_of(" \t") == std::string::npos; }

/// Whether a column that begins at `begin` would cut a word.
bool cutsAt(const std::string& line, std::size_t begin)
{
  return line.size() > begin && line[begin - 1] != ' ' && line[begin] != ' ' && line[begin] != '-';
}

/// A node's id and coordinates, and what follows them in its line, such as rotation angles.
struct NodeLine
{
  Fields fields;
  std::string rest;
};

std::string afterWords(const std::string& line, int words)
{
  std::size_t end = 0;
  for (int n = 0; n < words && end != std::string::npos; ++n)
    end = line.find_first_of(" \t", line.find_first_not_of(" \t", end));
  return end == std::string::npos ? std::string() : line.substr(end);
}

/// Splits a line by columns, unless they would cut a word or the line contains a tab.
NodeLine nodeLineOf(const std::string& line)
{
  const Fields columns = columnsOf(line, { 8, 20, 20, 20 });
  const bool fits = line.find('\t') == std::string::npos && !columns[0].empty() &&
                    std::all_of(columns.begin(), columns.end(), isColumn) && coordinatesOf(columns, 1);
  const bool cuts = cutsAt(line, 8) || cutsAt(line, 28) || cutsAt(line, 48) || cutsAt(line, 68);
  if (!fits || cuts) return { text::splitWords(line), afterWords(line, 4) };
  return { columns, line.size() > 68 ? line.substr(68) : std::string() };
}

Fields elementFields(const std::string& line)
{
  const bool tabs = line.find('\t') != std::string::npos;
  const Fields columns = columnsOf(line, std::vector<std::size_t>((line.size() + 5) / 6, 6));
  const bool fits =
    !tabs && columns.size() >= 9 &&
    std::all_of(columns.begin(), columns.end(), [](const std::string& c) { return !c.empty() && isColumn(c); });
  return fits ? columns : text::splitWords(line);
}

/// Returns the element that the distinct nodes of a hexahedron with repeated nodes form.
std::optional<Element> elementOf(const std::array<std::int32_t, 8>& n)
{
  const bool noBaseEdge = n[2] == n[3], noTopEdge = n[6] == n[7], isApex = n[4] == n[5] && n[5] == n[6] && n[6] == n[7];
  if (noBaseEdge && isApex) return Element{ ElementShape::Tetrahedron, { n[0], n[1], n[2], n[4] } };
  if (noBaseEdge && noTopEdge) return Element{ ElementShape::Wedge, { n[0], n[1], n[2], n[4], n[5], n[6] } };
  std::array<std::int32_t, 8> sorted = n;
  std::sort(sorted.begin(), sorted.end());
  if (std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end()) return {};
  return Element{ ElementShape::Hexahedron, n };
}

} // namespace

SolverMesh readAbaqusMesh(const std::string& file) { return AbaqusReader(file).read(); }

SolverMesh readAnsysMesh(const std::string& nodeFile, const std::string& elementFile)
{
  SolverMesh result;
  Numbering nodes(nodeFile, "node"), elements(elementFile, "element");
  std::vector<Eigen::Vector3d> points;
  const Fields nodeLines = text::splitLines(text::readTextFile(nodeFile));
  for (std::size_t i = 0; i < nodeLines.size(); ++i)
  {
    if (text::trimmed(nodeLines[i]).empty()) continue;
    const Fields fields = nodeLineOf(nodeLines[i]).fields;
    const std::int64_t id = idOf(fields[0]);
    const auto position = coordinatesOf(fields, 1);
    if (!id || !position) refuseLine(nodeFile, i, nodeLines[i], "a node's id and coordinates");
    nodes.add(id);
    result.nodeIds.push_back(id);
    points.push_back(*position);
  }
  result.mesh.points = columnsOf(points);
  const Fields elementLines = text::splitLines(text::readTextFile(elementFile));
  for (std::size_t i = 0; i < elementLines.size(); ++i)
  {
    if (text::trimmed(elementLines[i]).empty()) continue;
    const Fields fields = elementFields(elementLines[i]);
    const std::int64_t id = fields.size() >= 9 ? idOf(fields.back()) : 0;
    std::array<std::int32_t, 8> corners{};
    for (std::size_t k = 0; k < 8 && id; ++k)
    {
      const std::int64_t node = idOf(fields[k]);
      if (!node) refuseLine(elementFile, i, elementLines[i], "eight ids of nodes first");
      corners[k] = nodes.at(node);
    }
    const auto element = id ? elementOf(corners) : std::optional<Element>();
    if (!element)
      refuseLine(elementFile, i, elementLines[i], "a hexahedron, wedge or tetrahedron by eight nodes, and its id last");
    elements.add(id);
    result.elementIds.push_back(id);
    result.mesh.elements.push_back(*element);
  }
  return result;
}

std::string abaqusWithPoints(const std::string& file, const Points& points)
{
  std::string result;
  bool inNodes = false;
  Eigen::Index next = 0;
  for (const std::string& line : text::splitLines(text::readTextFile(file)))
  {
    const std::string content = text::trimmed(line);
    if (isKeyword(content)) inNodes = parseKeyword(content).name == "NODE";
    if (!inNodes || content.empty() || content[0] == '*') result += line + "\n";
    else
    {
      char row[128];
      const Eigen::Vector3d p = points.col(next++);
      std::snprintf(row, sizeof(row), "%s, %.12g, %.12g, %.12g\n", text::splitFields(content)[0].c_str(), p.x(), p.y(),
                    p.z());
      result += row;
    }
  }
  return result;
}

std::string ansysNodesWithPoints(const std::string& nodeFile, const Points& points)
{
  std::string result;
  Eigen::Index next = 0;
  for (const std::string& line : text::splitLines(text::readTextFile(nodeFile)))
  {
    if (text::trimmed(line).empty()) continue;
    const NodeLine node = nodeLineOf(line);
    char row[128];
    const Eigen::Vector3d p = points.col(next++);
    std::snprintf(row, sizeof(row), "%8lld%20.12g%20.12g%20.12g", static_cast<long long>(idOf(node.fields[0])), p.x(),
                  p.y(), p.z());
    result += row + node.rest + "\n";
  }
  return result;
}

} // namespace surgicalmesher
