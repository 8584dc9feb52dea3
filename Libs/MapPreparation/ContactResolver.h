// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Critical blocks of a map (see MapPreparation.h), and their resolution.

#include "PaddedMap.h"
#include "RegionRemoval.h"

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <set>
#include <unordered_set>
#include <vector>

namespace surgicalmesher
{

/// Returns the memory indices of the lowest corners of all critical blocks, ascending.
std::vector<std::size_t> findCriticalBlocks(const PaddedMap& map);

/// Resolves a queue of critical blocks by changing one voxel at a time.
///
/// Each change is the cheapest one among the voxels and labels of a block: it leaves few critical blocks around the
/// voxel, keeps labels connected as they were, and adds little interface. Every change raises the cost of its voxel, so
/// the search cannot cycle forever; where no change helps, it wanders until one does. With an original, a search that
/// has become too expensive is abandoned instead: the block goes back to its original labels.
class ContactResolver
{
public:
  explicit ContactResolver(PaddedMap& map);

  /// `original` must be well-composed and equal to the map in all fixed voxels; closed labels gain no voxel.
  ContactResolver(PaddedMap& map, const PaddedMap& original, std::function<bool(std::size_t)> isFixed,
                  const std::set<Label>& closedLabels);

  /// Whether a voxel must keep its label, as all voxels of the margin and of restored blocks must.
  bool isFixed(std::size_t voxel) const
  {
    return m_Map.isInMargin(voxel) || (m_Original && (m_IsFixed(voxel) || m_Restored.count(voxel) > 0));
  }

  void enqueue(std::size_t block);
  void updateAfter(const RemovedVoxels& removed);

  /// Throws EngineError, with the place in mm, for a contact that cannot be resolved.
  void run();

private:
  struct Change
  {
    int cost = std::numeric_limits<int>::max();
    std::uint32_t noise = 0; ///< decides between equal costs
    std::size_t voxel = 0;
    Label label = 0;
  };

  void enqueueAround(std::size_t voxel);
  void recordChange(Label from, Label to);
  void restore(std::size_t block);
  Change bestChange(std::size_t block) const;
  void apply(const Change& change);
  int changesOf(std::size_t voxel) const;
  std::uint32_t noise(std::size_t voxel, Label label) const;
  [[noreturn]] void throwUnresolved(std::size_t block) const;

  PaddedMap& m_Map;
  std::array<std::ptrdiff_t, 8> m_Corners;
  std::array<std::ptrdiff_t, 27> m_Around;
  std::vector<std::uint8_t> m_States;
  std::vector<std::size_t> m_Voxels; ///< number of voxels of each label
  std::vector<std::size_t> m_Queue;
  const PaddedMap* m_Original = nullptr;
  std::function<bool(std::size_t)> m_IsFixed; ///< called only if there is an original
  std::unordered_set<std::size_t> m_Restored;
  std::set<Label> m_Closed;
};

} // namespace surgicalmesher
