// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Preparation of the tissue map. The surface is faithful to the prepared map.
///
/// A map is *well-composed* when no tissue, background included, touches itself only along a voxel edge or corner: 6-,
/// 18- and 26-connectivity then agree on every tissue, and every tissue's boundary is a 2-manifold (L. J. Latecki, "3D
/// well-composed pictures", Graphical Models and Image Processing 59, 1997). The test is local: in every 2x2x2 block,
/// the voxels of each label are face-connected within the block, and so are the remaining voxels. A block that fails
/// is *critical*.

#include "PaddedMap.h"
#include "Progress.h"

#include <cstddef>
#include <functional>
#include <map>
#include <set>

namespace surgicalmesher
{

struct PreparationOptions
{
  /// mm^3; face-connected components of a tissue smaller than this go to the labels around them. The largest component
  /// of a tissue always stays, however small.
  double minimumIslandVolume = 0;
  std::map<Label, double> islandVolumes; ///< exceptions by tissue; 0 keeps all
  double minimumCavityVolume = 0;        ///< mm^3; the same for enclosed background
  std::map<Label, double> cavityVolumes; ///< exceptions by surrounding tissue; of several, the smallest counts
};

struct TissueChanges
{
  std::size_t islandsRemoved = 0; ///< components of the given map; cavities, for background
  std::size_t islandVoxels = 0;   ///< voxels in them that belong to another label now
  std::size_t voxelsLost = 0;     ///< to other labels, while resolving contacts
  std::size_t voxelsGained = 0;   ///< from other labels, while resolving contacts
};

struct PreparationReport
{
  std::map<Label, TissueChanges> changes; ///< only tissues with a change; background is label 0
  std::size_t criticalBlocksBefore = 0;   ///< after island removal, before any contact was resolved
  std::size_t contactVoxelsChanged = 0;   ///< all voxels that differ, without the islandVoxels
};

/// Number of critical 2x2x2 blocks of the map, padded by one layer of background.
std::size_t countCriticalBlocks(const TissueMap& map);

/// Removes islands and cavities, then resolves every contact; afterwards countCriticalBlocks() is 0, and every tissue
/// that was present still is. Without islands to remove only voxels near critical blocks change. Deterministic. Throws
/// EngineError if a contact cannot be resolved, with its place in mm; the map is then as it was.
PreparationReport prepareMap(TissueMap& map, const PreparationOptions& options, const Progress& progress = {});

/// Does the same without changing `map`: returns the prepared map with a margin (at least one voxel; without influence
/// on the labels), for callers that continue with padded maps.
PaddedMap preparedMap(const TissueMap& map, int margin, const PreparationOptions& options, PreparationReport& report,
                      const Progress& progress = {});

/// Restrictions on the changes of a prepared map.
struct ChangeLimits
{
  std::function<bool(std::size_t)> isFixed; ///< whether a voxel of the padded map keeps its label
  std::set<Label> closedLabels;             ///< gain no voxel
};

/// Prepares a changed copy of a prepared map again: removes the islands that the change cut off, and resolves the
/// contacts that it made, within limits that the change itself must have respected. Always succeeds, as voxels can go
/// back to their labels in `prepared`; islands that hold a fixed or restored voxel stay.
void prepareAgain(PaddedMap& map, const PaddedMap& prepared, const PreparationOptions& options,
                  const ChangeLimits& limits);

} // namespace surgicalmesher
