// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Settings of single tissues: which are meshed, together or apart, as solids or shells, and how finely.

#include "TissueMap.h"

#include <map>
#include <string>
#include <vector>

namespace surgicalmesher
{

enum class TissueRole
{
  Mesh,  ///< a tissue of its own
  Group, ///< part of one tissue with the other members of its group
  Shell, ///< a surface of constant edge length, which the volume stage may leave hollow
  Leave  ///< not meshed: becomes background
};

struct TissueSetting
{
  TissueRole role = TissueRole::Mesh;
  std::string group;            ///< name of the group
  double minimumEdgeLength = 0; ///< mm; 0: no limit
  double maximumEdgeLength = 0; ///< mm; 0: no limit. A shell has one length: the two are the same
  bool isProtected = false;     ///< exempt from simplification
  double islandVolume = -1;     ///< mm^3; smaller pieces of the tissue are removed; 0: none; negative: general value
  double cavityVolume = -1;     ///< mm^3; the same for background enclosed by the tissue
};

using TissueSettings = std::map<Label, TissueSetting>;

/// Reads a CSV of one row per tissue. The header row names the columns, in any order: `label` or `name` (or both: the
/// label counts), `role` (mesh, group NAME, shell, leave), `minimum`, `maximum`, `protected` (yes, no), `islands`,
/// `cavities`; an empty field means the default. Lines that are empty or begin with # are skipped. Throws InputError
/// with file and line for any other content: a column that is unknown or repeated, no column for the tissue, a tissue
/// that is unknown, absent from the map or listed twice, values out of range, a minimum above the maximum, no tissue
/// left to mesh.
TissueSettings readTissueSettings(const std::string& file, const TissueMap& map);

/// One tissue that stands for several.
struct TissueGroup
{
  Label label = 0; ///< the smallest of its members
  std::string name;
  std::vector<Label> members; ///< ascending
  /// The members by contiguity: those of one piece are connected by common voxel faces, from tissue to tissue. Ordered
  /// by the smallest member of each piece.
  std::vector<std::vector<Label>> pieces;
};

/// What selectTissues() did to the tissues of a map.
struct TissueSelection
{
  std::vector<TissueGroup> groups;         ///< ordered by label
  std::map<Label, std::size_t> voxelsLeft; ///< number of voxels of each tissue that was left out
  TissueTable tableOfInput;                ///< names and colours before the selection
};

/// Joins the members of each group, and turns the tissues left out into background. Updates map.table and `settings`: a
/// group has the smallest edge lengths and volumes of its members, is protected if one member is, and is null
/// displacement if all are. Shells are marked in map.table.
TissueSelection selectTissues(TissueMap& map, TissueSettings& settings);

} // namespace surgicalmesher
