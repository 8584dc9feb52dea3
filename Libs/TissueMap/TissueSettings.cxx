// SPDX-License-Identifier: Apache-2.0
#include "TissueSettings.h"

#include "Errors.h"
#include "LabelRuns.h"
#include "TextFile.h"
#include "TextTable.h"
#include "TissueMapIO.h"
#include "UnionFind.h"

#include <algorithm>

namespace surgicalmesher
{

namespace
{

enum Column
{
  ColumnLabel,
  ColumnName,
  ColumnRole,
  ColumnMinimum,
  ColumnMaximum,
  ColumnProtected,
  ColumnIslands,
  ColumnCavities,
  ColumnCount
};

const std::array<const char*, ColumnCount> columnNames{ "label",   "name",      "role",    "minimum",
                                                        "maximum", "protected", "islands", "cavities" };

int columnOf(const std::string& name)
{
  const auto found = std::find(columnNames.begin(), columnNames.end(), text::lowerCase(name));
  return found == columnNames.end() ? -1 : int(found - columnNames.begin());
}

Label readTissue(const TextTableRow& row, const TissueMap& map, const std::vector<Label>& present)
{
  const std::string tissue = row.fields[ColumnLabel].empty() ? row.fields[ColumnName] : row.fields[ColumnLabel];
  Label label = 0;
  if (!findTissue(tissue, map.table, label)) row.fail(whyNoTissue(tissue, map.table));
  if (label == 0) row.fail("\"" + tissue + "\" is neither a label from 1 to 65535 nor the name of a tissue");
  if (!std::binary_search(present.begin(), present.end(), label))
  {
    row.fail("tissue " + tissue + " has no voxel in the map, expected one that has");
  }
  return label;
}

void readRole(const TextTableRow& row, TissueSetting& setting)
{
  const std::string role = row.fields[ColumnRole];
  const std::string word = text::lowerCase(role.substr(0, role.find_first_of(" \t")));
  if (word == "group") setting.group = text::trimmed(role.substr(word.size()));
  if (word.empty() || text::lowerCase(role) == "mesh") setting.role = TissueRole::Mesh;
  else if (text::lowerCase(role) == "shell") setting.role = TissueRole::Shell;
  else if (text::lowerCase(role) == "leave") setting.role = TissueRole::Leave;
  else if (!setting.group.empty()) setting.role = TissueRole::Group;
  else row.fail("role \"" + role + "\", expected mesh, group NAME, shell or leave");
}

/// Reads a number; an empty field leaves `value` as it is.
void readNumber(const TextTableRow& row, Column column, bool mayBeZero, double& value)
{
  const std::string field = row.fields[column];
  double number = 0;
  if (field.empty()) return;
  if (!text::parseNumber(field, number) || number < 0 || (number == 0 && !mayBeZero))
  {
    row.fail(std::string(columnNames[column]) + " \"" + field + "\", expected a finite number " +
             (mayBeZero ? "of at least 0" : "above 0"));
  }
  value = number;
}

bool readProtected(const TextTableRow& row)
{
  const std::string field = text::lowerCase(row.fields[ColumnProtected]);
  if (field == "yes" || field == "true" || field == "1") return true;
  if (field.empty() || field == "no" || field == "false" || field == "0") return false;
  row.fail("protected \"" + field + "\", expected yes or no");
}

TissueSetting readSetting(const TextTableRow& row)
{
  TissueSetting setting;
  readRole(row, setting);
  readNumber(row, ColumnMinimum, false, setting.minimumEdgeLength);
  readNumber(row, ColumnMaximum, false, setting.maximumEdgeLength);
  readNumber(row, ColumnIslands, true, setting.islandVolume);
  readNumber(row, ColumnCavities, true, setting.cavityVolume);
  setting.isProtected = readProtected(row);
  double& minimum = setting.minimumEdgeLength;
  double& maximum = setting.maximumEdgeLength;
  if (minimum > 0 && maximum > 0 && minimum > maximum) row.fail("the minimum edge length is above the maximum");
  if (setting.role != TissueRole::Shell) return setting;
  if (minimum > 0 && maximum > 0 && minimum < maximum)
    row.fail("a shell of two edge lengths, expected one, as minimum or maximum");
  minimum = maximum = std::max(minimum, maximum);
  return setting;
}

/// The smaller of two values, each of which may be `open`, that is, not set.
double smaller(double a, double b, double open) { return a == open ? b : b == open ? a : std::min(a, b); }

/// The setting of a group, from those of two of its members. A minimum that is not set is a minimum of 0.
TissueSetting joined(const TissueSetting& a, const TissueSetting& b)
{
  TissueSetting both = a;
  both.minimumEdgeLength = std::min(a.minimumEdgeLength, b.minimumEdgeLength);
  both.maximumEdgeLength = smaller(a.maximumEdgeLength, b.maximumEdgeLength, 0);
  both.islandVolume = smaller(a.islandVolume, b.islandVolume, -1);
  both.cavityVolume = smaller(a.cavityVolume, b.cavityVolume, -1);
  both.isProtected = a.isProtected || b.isProtected;
  return both;
}

std::vector<TissueGroup> groupsOf(const TissueSettings& settings)
{
  std::map<std::string, TissueGroup> byName;
  for (const auto& [label, setting] : settings)
  {
    if (setting.role != TissueRole::Group) continue;
    TissueGroup& group = byName[setting.group];
    group.name = setting.group;
    group.members.push_back(label);
    group.label = group.members.front();
  }
  std::vector<TissueGroup> groups;
  for (const auto& [name, group] : byName) groups.push_back(group);
  std::sort(groups.begin(), groups.end(), [](const auto& a, const auto& b) { return a.label < b.label; });
  return groups;
}

/// Finds the pieces of all groups: members of one group are connected where two of their voxels share a face.
void findPieces(const TissueMap& map, std::vector<TissueGroup>& groups)
{
  std::vector<std::size_t> groupOf(labelCount, groups.size());
  for (std::size_t g = 0; g < groups.size(); ++g)
    for (const Label member : groups[g].members) groupOf[member] = g;
  UnionFind pieces(labelCount);
  const auto& [ni, nj, nk] = map.grid.size;
  const auto touch = [&](Label a, std::size_t other)
  {
    const Label b = map.labels[other];
    if (a != b && groupOf[a] == groupOf[b]) pieces.unite(a, b);
  };
  for (int k = 0; k < nk; ++k)
    for (int j = 0; j < nj; ++j)
      for (int i = 0; i < ni; ++i)
      {
        const Label a = map.labels[map.grid.index(i, j, k)];
        if (groupOf[a] == groups.size()) continue;
        if (i + 1 < ni) touch(a, map.grid.index(i + 1, j, k));
        if (j + 1 < nj) touch(a, map.grid.index(i, j + 1, k));
        if (k + 1 < nk) touch(a, map.grid.index(i, j, k + 1));
      }
  for (TissueGroup& group : groups)
  {
    std::map<std::uint32_t, std::vector<Label>> byRoot; // roots are the smallest members
    for (const Label member : group.members) byRoot[pieces.find(member)].push_back(member);
    for (auto& [root, members] : byRoot) group.pieces.push_back(std::move(members));
  }
}

void joinGroup(const TissueGroup& group, TissueMap& map, TissueSettings& settings)
{
  TissueSetting together = settings.at(group.label);
  const bool isHeld = std::all_of(group.members.begin(), group.members.end(),
                                  [&](Label member) { return map.table[member].isNullDisplacement; });
  for (const Label member : group.members)
  {
    together = joined(together, settings.at(member));
    if (member == group.label) continue;
    settings.erase(member);
    map.table.erase(member);
  }
  settings[group.label] = together;
  map.table[group.label].name = group.name;
  map.table[group.label].isNullDisplacement = isHeld;
}

} // namespace

TissueSettings readTissueSettings(const std::string& file, const TissueMap& map)
{
  const std::vector<Label> present = presentLabels(map);
  const TextTable table =
    readTextTable(file, ColumnCount, columnOf, "label, name, role, minimum, maximum, protected, islands, cavities");
  const TextTableRow& header = table.header;
  if (!header.where.empty() && header.fields[ColumnLabel].empty() && header.fields[ColumnName].empty())
    header.fail("no column label or name in the header row");
  TissueSettings settings;
  for (const TextTableRow& row : table.rows)
  {
    const Label label = readTissue(row, map, present);
    if (!settings.emplace(label, readSetting(row)).second)
      row.fail("tissue " + std::to_string(label) + " is listed for the second time");
  }
  if (settings.empty()) throw InputError(file + ": no tissue, expected a header row and a row for each tissue");
  const auto isLeft = [&](Label label)
  {
    const auto found = settings.find(label);
    return found != settings.end() && found->second.role == TissueRole::Leave;
  };
  if (std::all_of(present.begin(), present.end(), isLeft))
    throw InputError(file + ": every tissue is left out, expected one to mesh");
  return settings;
}

TissueSelection selectTissues(TissueMap& map, TissueSettings& settings)
{
  TissueSelection selection;
  selection.tableOfInput = map.table;
  selection.groups = groupsOf(settings);
  if (!selection.groups.empty()) findPieces(map, selection.groups);
  std::vector<Label> becomes(std::size_t(1) << 16);
  for (std::size_t label = 0; label < becomes.size(); ++label) becomes[label] = Label(label);
  for (const TissueGroup& group : selection.groups)
  {
    for (const Label member : group.members) becomes[member] = group.label;
    joinGroup(group, map, settings);
  }
  for (const auto& [label, setting] : settings)
  {
    if (setting.role == TissueRole::Shell) map.table[label].isShell = true;
    if (setting.role != TissueRole::Leave) continue;
    becomes[label] = 0;
    selection.voxelsLeft[label] = 0;
    map.table.erase(label);
  }
  if (selection.groups.empty() && selection.voxelsLeft.empty()) return selection;
  forEachLabelRun(map.labels, 0, map.labels.size(),
                  [&](Label label, std::size_t begin, std::size_t end)
                  {
                    if (label != 0 && becomes[label] == 0) selection.voxelsLeft[label] += end - begin;
                    if (becomes[label] == label) return;
                    std::fill(map.labels.data() + begin, map.labels.data() + end, becomes[label]);
                  });
  return selection;
}

} // namespace surgicalmesher
