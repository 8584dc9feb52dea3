// SPDX-License-Identifier: Apache-2.0
#include "ContactResolver.h"

#include "Errors.h"
#include "LocalTopology.h"
#include "Parallel.h"
#include "Place.h"

#include <algorithm>
#include <cstdlib>
#include <tuple>
#include <utility>

namespace surgicalmesher
{
namespace
{

constexpr int centre = 13;

int faceContacts(const Neighbourhood& n, Label label)
{
  int contacts = 0;
  for (const int face : sixNeighbours) contacts += n[face] == label;
  return contacts;
}

/// Memory offsets from the lowest corner of a block to its corners.
std::array<std::ptrdiff_t, 8> cornerSteps(const Grid& grid)
{
  const std::ptrdiff_t j = grid.size[0], k = j * grid.size[1];
  return { 0, 1, j, j + 1, k, k + 1, k + j, k + j + 1 };
}

/// Cost of taking the centre away from its label, whichever label receives it: parts of the label that split or join,
/// plus the interface that this adds, minus the critical blocks before the change.
int costOfLoss(const Neighbourhood& around)
{
  const Label old = around[centre];
  return std::abs(partsAround(around, old) - 1) + faceContacts(around, old) - criticalBlocks(around);
}

/// Cost of giving the centre to `label`: critical blocks after the change, plus parts of the label that split or join,
/// minus the interface that this removes.
int costOfGain(const Neighbourhood& around, Label label)
{
  Neighbourhood changed = around;
  changed[centre] = label;
  return criticalBlocks(changed) + std::abs(partsAround(around, label) - 1) - faceContacts(around, label);
}

/// Appends the lowest corners of the critical blocks between slices k and k + 1.
void findInSlice(const PaddedMap& map, int k, std::vector<std::size_t>& result)
{
  const auto& size = map.grid.size;
  const auto corners = cornerSteps(map.grid);
  std::vector<Label> differs(size[0]);
  for (int j = 0; j + 1 < size[1]; ++j)
  {
    const std::size_t begin = map.grid.index(0, j, k);
    const Label* a = map.labels.data() + begin;
    const Label *b = a + corners[2], *c = a + corners[4], *d = a + corners[6];
    // A uniform block then takes a single comparison.
    for (int i = 0; i < size[0]; ++i) differs[i] = (a[i] ^ b[i]) | (a[i] ^ c[i]) | (a[i] ^ d[i]);
    for (int i = 0; i + 1 < size[0]; ++i)
    {
      if ((differs[i] | differs[i + 1] | (a[i] ^ a[i + 1])) == 0) continue;
      if (isCritical({ a[i], a[i + 1], b[i], b[i + 1], c[i], c[i + 1], d[i], d[i + 1] })) result.push_back(begin + i);
    }
  }
}

constexpr std::uint8_t queued = 128; ///< in m_States; the other bits count the changes of the voxel
constexpr std::uint8_t maximumCount = 127;
constexpr int patience = 16; ///< changes of a voxel before its block is restored, if there is an original

} // namespace

std::vector<std::size_t> findCriticalBlocks(const PaddedMap& map)
{
  std::vector<std::vector<std::size_t>> slices(std::max(0, map.grid.size[2] - 1));
  parallelForEach(slices.size(), [&](std::size_t k) { findInSlice(map, int(k), slices[k]); });
  std::vector<std::size_t> result;
  for (const std::vector<std::size_t>& slice : slices) result.insert(result.end(), slice.begin(), slice.end());
  return result;
}

ContactResolver::ContactResolver(PaddedMap& map)
  : m_Map(map), m_Corners(cornerSteps(map.grid)), m_Around(neighbourSteps(map.grid)), m_States(map.labels.size(), 0),
    m_Voxels(labelCount, 0)
{
  for (const auto& [label, voxels] : countVoxels(map)) m_Voxels[label] = voxels;
}

ContactResolver::ContactResolver(PaddedMap& map, const PaddedMap& original, std::function<bool(std::size_t)> isFixed,
                                 const std::set<Label>& closedLabels)
  : ContactResolver(map)
{
  m_Original = &original;
  m_IsFixed = std::move(isFixed);
  m_Closed = closedLabels;
}

void ContactResolver::enqueue(std::size_t block)
{
  if (m_States[block] & queued) return;
  m_States[block] |= queued;
  m_Queue.push_back(block);
}

void ContactResolver::updateAfter(const RemovedVoxels& removed)
{
  for (std::size_t v = 0; v < removed.voxels.size(); ++v)
  {
    recordChange(removed.labels[v], m_Map.labels[removed.voxels[v]]);
    enqueueAround(removed.voxels[v]);
  }
}

void ContactResolver::run()
{
  // Far more changes than a map of pure noise needs.
  std::size_t changesLeft = 1000 + 100 * m_Queue.size();
  for (std::size_t head = 0; head < m_Queue.size(); ++head)
  {
    const std::size_t block = m_Queue[head];
    m_States[block] &= ~queued;
    if (!isCritical(gather(m_Map, block, m_Corners))) continue;
    const Change change = bestChange(block);
    if (m_Original && (change.cost == std::numeric_limits<int>::max() || changesOf(change.voxel) >= patience))
    {
      restore(block);
      continue;
    }
    if (changesLeft-- == 0 || change.cost == std::numeric_limits<int>::max()) throwUnresolved(block);
    apply(change);
  }
  m_Queue.clear();
}

/// Queues the critical ones of the eight blocks around a voxel.
void ContactResolver::enqueueAround(std::size_t voxel)
{
  for (const std::ptrdiff_t c : m_Corners)
  {
    if (isCritical(gather(m_Map, voxel - c, m_Corners))) enqueue(voxel - c);
  }
}

void ContactResolver::recordChange(Label from, Label to)
{
  --m_Voxels[from];
  ++m_Voxels[to];
}

void ContactResolver::restore(std::size_t block)
{
  for (const std::ptrdiff_t corner : m_Corners)
  {
    const std::size_t voxel = block + corner;
    m_Restored.insert(voxel);
    if (m_Map.labels[voxel] == m_Original->labels[voxel]) continue;
    recordChange(m_Map.labels[voxel], m_Original->labels[voxel]);
    m_Map.labels[voxel] = m_Original->labels[voxel];
    enqueueAround(voxel);
  }
}

/// The cheapest change of one voxel of the block to another label of the block. Fixed voxels and the last voxel of a
/// tissue are not changed; if no other voxel is left, the cost is the maximum of its type.
ContactResolver::Change ContactResolver::bestChange(std::size_t block) const
{
  Change best;
  const Block labels = gather(m_Map, block, m_Corners);
  for (int c = 0; c < 8; ++c)
  {
    const std::size_t voxel = block + m_Corners[c];
    if (isFixed(voxel) || (labels[c] != 0 && m_Voxels[labels[c]] == 1)) continue;
    const Neighbourhood around = gather(m_Map, voxel, m_Around);
    const int price = changesOf(voxel) + costOfLoss(around);
    for (int l = 0; l < 8; ++l)
    {
      if (labels[l] == labels[c] || std::find(labels.begin(), labels.begin() + l, labels[l]) != labels.begin() + l)
        continue;
      if (m_Closed.count(labels[l])) continue;
      const Change change{ price + costOfGain(around, labels[l]), noise(voxel, labels[l]), voxel, labels[l] };
      if (std::tie(change.cost, change.noise) < std::tie(best.cost, best.noise)) best = change;
    }
  }
  return best;
}

void ContactResolver::apply(const Change& change)
{
  recordChange(m_Map.labels[change.voxel], change.label);
  m_Map.labels[change.voxel] = change.label;
  if (changesOf(change.voxel) < maximumCount) ++m_States[change.voxel];
  enqueueAround(change.voxel);
}

int ContactResolver::changesOf(std::size_t voxel) const { return m_States[voxel] & maximumCount; }

/// A hash that changes with every change of the voxel, so that ties are not always decided in the same way. The voxel
/// is numbered as with a margin of one, so that the result does not depend on the margin.
std::uint32_t ContactResolver::noise(std::size_t voxel, Label label) const
{
  const auto [i, j, k] = m_Map.mapVoxelAt(voxel);
  const auto size = [&](int axis) -> std::size_t { return m_Map.grid.size[axis] - 2 * m_Map.margin + 2; };
  const std::size_t number = (std::size_t(k + 1) * size(1) + j + 1) * size(0) + i + 1;
  std::uint64_t h = (number * 65537 + label) * 256 + changesOf(voxel);
  h = (h ^ (h >> 31)) * 0x7fb5d329728ea185ull;
  h = (h ^ (h >> 27)) * 0x81dadef4bc2dd44dull;
  return std::uint32_t(h >> 33);
}

void ContactResolver::throwUnresolved(std::size_t block) const
{
  const Vec3 centre = 0.5 * (m_Map.worldAt(block) + m_Map.worldAt(block + m_Corners[7]));
  throw EngineError("map preparation: the diagonal contact at " + place(centre) + " could not be resolved");
}

} // namespace surgicalmesher
