// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Critical blocks of a map (see MapPreparation.h), and how they go.

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

/// Lowest corners of the critical blocks, ascending.
std::vector<std::size_t> findCriticalBlocks(const PaddedMap& map);

/// Empties a queue of critical blocks, one voxel at a time.
///
/// Each change is the cheapest among the voxels and labels of the block at hand: it leaves few critical blocks around
/// the voxel, labels that hang together as they did, and little interface. A voxel becomes dearer with every change, so
/// the search cannot circle for ever, and where no change helps it wanders until one does. Within limits a search that
/// has become dear is given up instead: the block goes back to what it was.
class ContactResolver
{
public:
  explicit ContactResolver(PaddedMap& map);

  /// `original` is well-composed, and the same as the map in all fixed voxels; closed labels gain nothing.
  ContactResolver(PaddedMap& map, const PaddedMap& original, std::function<bool(std::size_t)> isFixed,
                  const std::set<Label>& closedLabels);

  /// Those of the margin and of restored blocks are.
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
  std::vector<std::size_t> m_Voxels; ///< of each label
  std::vector<std::size_t> m_Queue;
  const PaddedMap* m_Original = nullptr;
  std::function<bool(std::size_t)> m_IsFixed; ///< asked only where there is an original
  std::unordered_set<std::size_t> m_Restored;
  std::set<Label> m_Closed;
};

} // namespace surgicalmesher
