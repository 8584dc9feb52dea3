#pragma once
/// Preparation of the tissue map: what the surface will be faithful to.
///
/// A map is *well-composed* when no tissue, background included, touches itself only along a voxel edge or corner:
/// 6-, 18- and 26-connectivity then agree on every tissue, and every tissue's boundary is a 2-manifold.

#include "Progress.h"
#include "TissueMap.h"

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace surgicalmesher
{

struct PreparationOptions
{
  double minimumIslandVolume = 0; ///< mm^3; face-connected components of a tissue smaller than this go to their neighbours
};

struct TissueChanges
{
  std::size_t islandsRemoved = 0;     ///< components
  std::size_t islandVoxels = 0;       ///< voxels in them
  std::size_t voxelsLost = 0;         ///< to other labels, while resolving contacts
  std::size_t voxelsGained = 0;       ///< from other labels, while resolving contacts
};

struct PreparationReport
{
  std::map<Label, TissueChanges> changes; ///< only tissues with a change; background is label 0
  std::size_t criticalBlocksBefore = 0;   ///< 2x2x2 blocks in which a label touches itself only along an edge or a corner
  std::size_t contactVoxelsChanged = 0;
};

/// Number of 2x2x2 blocks (the map padded by one layer of background) that are not well-composed.
std::size_t countCriticalBlocks(const TissueMap& map);

/// Removes islands, then resolves every diagonal contact; afterwards countCriticalBlocks() is 0. Deterministic.
/// Throws EngineError if a contact cannot be resolved, with its place in mm.
PreparationReport prepareMap(TissueMap& map, const PreparationOptions& options, const Progress& progress = {});

} // namespace surgicalmesher
