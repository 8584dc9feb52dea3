// SPDX-License-Identifier: Apache-2.0
#include "MapPreparation.h"

#include "Errors.h"
#include "PaddedMap.h"
#include "RegionRemoval.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <sstream>
#include <tuple>
#include <utility>

namespace surgicalmesher
{
namespace
{

// Corners of a block: bit 0 of the number is i, bit 1 j, bit 2 k.
// Voxels of a 3x3x3 neighbourhood: i + 3 j + 9 k, the centre at 13.

using CornerMask = unsigned; ///< a set of corners, one bit each
using Block = std::array<Label, 8>;
using Neighbourhood = std::array<Label, 27>;

constexpr int centre = 13;

bool faceConnected(CornerMask corners)
{
  CornerMask reached = corners & (~corners + 1);
  for (int step = 0; step < 7; ++step)
  {
    for (int c = 0; c < 8; ++c)
    {
      if (reached >> c & 1) reached |= (1u << (c ^ 1) | 1u << (c ^ 2) | 1u << (c ^ 4)) & corners;
    }
  }
  return reached == corners;
}

/// For each set of corners, whether a label may hold exactly these.
std::array<bool, 256> makeAllowedSets()
{
  std::array<bool, 256> allowed{};
  for (CornerMask m = 0; m < 256; ++m) allowed[m] = faceConnected(m) && faceConnected(~m & 255);
  return allowed;
}

const std::array<bool, 256> allowedSets = makeAllowedSets();

CornerMask cornersOf(Label label, const Block& block)
{
  CornerMask corners = 0;
  for (int c = 0; c < 8; ++c) corners |= CornerMask(block[c] == label) << c;
  return corners;
}

bool isCritical(const Block& block)
{
  CornerMask seen = 0;
  for (int c = 0; c < 8; ++c)
  {
    if (seen >> c & 1) continue;
    const CornerMask corners = cornersOf(block[c], block);
    if (!allowedSets[corners]) return true;
    seen |= corners;
    if (seen == 255) return false;
  }
  return false;
}

/// How many of the eight blocks around the centre are critical.
int criticalBlocks(const Neighbourhood& n)
{
  constexpr std::array<int, 8> lowCorners{ 0, 1, 3, 4, 9, 10, 12, 13 };
  int count = 0;
  for (const int l : lowCorners)
  {
    count += isCritical({ n[l], n[l + 1], n[l + 3], n[l + 4], n[l + 9], n[l + 10], n[l + 12], n[l + 13] });
  }
  return count;
}

/// Face-connected parts of `label` among the 18 voxels around the centre, of which only those that touch the centre by
/// a face count. One means that the centre can join or leave the label without its surroundings falling apart or
/// meeting.
int partsAround(const Neighbourhood& n, Label label)
{
  const auto& faces = sixNeighbours;
  std::array<int, 27> part;
  for (int v = 0; v < 27; ++v) part[v] = v != centre && n[v] == label ? v : -1;
  int parts = 0;
  for (const int f : faces) parts += part[f] >= 0;
  // An edge voxel joins the two face voxels beside it.
  for (int a = 0; a < 6; ++a)
  {
    for (int b = a + 1; b < 6; ++b)
    {
      const int edge = faces[a] + faces[b] - centre;
      if (faces[a] + faces[b] == 2 * centre || part[faces[a]] < 0 || part[faces[b]] < 0 || part[edge] < 0) continue;
      const int from = part[faces[b]], to = part[faces[a]];
      if (from == to) continue;
      --parts;
      for (const int f : faces)
      {
        if (part[f] == from) part[f] = to;
      }
    }
  }
  return parts;
}

int faceContacts(const Neighbourhood& n, Label label)
{
  int contacts = 0;
  for (const int face : sixNeighbours) contacts += n[face] == label;
  return contacts;
}

/// Steps from the lowest corner of a block to its corners.
std::array<std::ptrdiff_t, 8> cornerSteps(const Grid& grid)
{
  const std::ptrdiff_t j = grid.size[0], k = j * grid.size[1];
  return { 0, 1, j, j + 1, k, k + 1, k + j, k + j + 1 };
}

template <std::size_t N>
std::array<Label, N> gather(const TissueMap& map, std::size_t voxel, const std::array<std::ptrdiff_t, N>& steps)
{
  std::array<Label, N> result;
  for (std::size_t n = 0; n < N; ++n) result[n] = map.labels[voxel + steps[n]];
  return result;
}

/// Lowest corners of the critical blocks of a padded map, ascending. Uniform blocks cost one comparison.
std::vector<std::size_t> findCriticalBlocks(const TissueMap& map)
{
  const auto& size = map.grid.size;
  const auto corners = cornerSteps(map.grid);
  std::vector<std::size_t> result;
  std::vector<Label> differs(size[0]);
  for (int k = 0; k + 1 < size[2]; ++k)
  {
    for (int j = 0; j + 1 < size[1]; ++j)
    {
      const std::size_t begin = map.grid.index(0, j, k);
      const Label* a = map.labels.data() + begin;
      const Label *b = a + corners[2], *c = a + corners[4], *d = a + corners[6];
      for (int i = 0; i < size[0]; ++i) differs[i] = (a[i] ^ b[i]) | (a[i] ^ c[i]) | (a[i] ^ d[i]);
      for (int i = 0; i + 1 < size[0]; ++i)
      {
        if ((differs[i] | differs[i + 1] | (a[i] ^ a[i + 1])) == 0) continue;
        if (isCritical({ a[i], a[i + 1], b[i], b[i + 1], c[i], c[i + 1], d[i], d[i + 1] })) result.push_back(begin + i);
      }
    }
  }
  return result;
}

double volumeFor(Label label, const std::map<Label, double>& exceptions, double general)
{
  const auto exception = exceptions.find(label);
  return exception == exceptions.end() ? general : exception->second;
}

/// Of each region of background, the volume under which it is to go.
std::vector<double> cavityVolumes(const TissueMap& map, const Regions& regions, const PreparationOptions& options)
{
  const double general = options.minimumCavityVolume;
  std::vector<double> volumes(regions.list.size(), options.cavityVolumes.empty() ? general : HUGE_VAL);
  if (options.cavityVolumes.empty()) return volumes;
  const auto steps = neighbourSteps(map.grid);
  const std::size_t size = map.grid.size[0];
  for (std::size_t row = 0; row + 1 < regions.rowBegins.size(); ++row)
  {
    for (std::size_t r = regions.rowBegins[row]; r < regions.rowBegins[row + 1]; ++r)
    {
      const auto [begin, region] = regions.runs[r];
      if (region == 0 || regions.list[region].label != 0) continue;
      const std::size_t end = r + 1 < regions.rowBegins[row + 1] ? regions.runs[r + 1].begin : size;
      for (std::size_t v = row * size + begin; v < row * size + end; ++v)
      {
        for (const int face : sixNeighbours)
        {
          const Label label = map.labels[v + steps[face]];
          if (label == 0) continue;
          volumes[region] = std::min(volumes[region], volumeFor(label, options.cavityVolumes, general));
        }
      }
    }
  }
  return volumes;
}

/// Regions of a padded map that are under the volume asked for.
std::vector<bool> findIslands(const TissueMap& map, const Regions& regions, const PreparationOptions& options)
{
  const Vec3& s = map.grid.spacing;
  const double voxelVolume = s.x * s.y * s.z;
  const std::vector<double> cavities = cavityVolumes(map, regions, options);
  std::vector<bool> isIsland = largestRegions(regions);
  for (std::size_t r = 0; r < regions.list.size(); ++r)
  {
    const auto [label, voxels] = regions.list[r];
    const bool isLargest = isIsland[r] && label != 0;
    const double minimum =
      label == 0 ? cavities[r] : volumeFor(label, options.islandVolumes, options.minimumIslandVolume);
    isIsland[r] = r != 0 && !isLargest && voxels * voxelVolume < minimum;
  }
  return isIsland;
}

/// Leaves out the regions that hold a fixed voxel.
void excludeFixed(std::vector<bool>& chosen, const Regions& regions, const Grid& grid,
                  const std::vector<bool>& fixedVoxels)
{
  const std::size_t size = grid.size[0];
  for (std::size_t row = 0; row + 1 < regions.rowBegins.size(); ++row)
  {
    for (std::size_t r = regions.rowBegins[row]; r < regions.rowBegins[row + 1]; ++r)
    {
      const auto [begin, region] = regions.runs[r];
      if (!chosen[region]) continue;
      const std::size_t end = r + 1 < regions.rowBegins[row + 1] ? regions.runs[r + 1].begin : size;
      for (std::size_t v = row * size + begin; v < row * size + end; ++v)
      {
        if (fixedVoxels[v]) chosen[region] = false;
      }
    }
  }
}

/// Flags of a map's voxels for its copy with a margin of one, whose voxels all are flagged.
std::vector<bool> paddedFlags(const std::vector<bool>& flags, const Grid& grid)
{
  const std::size_t sizeI = grid.size[0] + 2, sizeJ = grid.size[1] + 2;
  std::vector<bool> result(sizeI * sizeJ * (grid.size[2] + 2), true);
  std::size_t n = 0;
  for (int k = 1; k <= grid.size[2]; ++k)
  {
    for (int j = 1; j <= grid.size[1]; ++j)
    {
      for (int i = 1; i <= grid.size[0]; ++i) result[(k * sizeJ + j) * sizeI + i] = flags[n++];
    }
  }
  return result;
}

/// Empties a queue of critical blocks of a padded map, one voxel at a time.
///
/// Each change is the cheapest among the voxels and labels of the block at hand: it leaves few critical blocks around
/// the voxel, labels that hang together as they did, and little interface. A voxel becomes dearer with every change, so
/// the search cannot circle for ever, and where no change helps it wanders until one does. Within limits a search that
/// has become dear is given up instead: the block goes back to what it was.
class ContactResolver
{
public:
  explicit ContactResolver(TissueMap& map)
    : m_Map(map), m_Corners(cornerSteps(map.grid)), m_Around(neighbourSteps(map.grid)), m_States(map.labels.size(), 0),
      m_Voxels(labelCount, 0)
  {
    for (const Label label : map.labels) ++m_Voxels[label];
  }

  /// `original` is well-composed, and the same as the map in all fixed voxels.
  ContactResolver(TissueMap& map, const TissueMap& original, std::vector<bool> fixedVoxels,
                  const std::set<Label>& closedLabels)
    : ContactResolver(map)
  {
    m_Original = &original;
    m_Fixed = std::move(fixedVoxels);
    m_Closed = closedLabels;
  }

  const std::vector<bool>& fixedVoxels() const { return m_Fixed; }

  void enqueue(std::size_t block)
  {
    if (m_States[block] & queued) return;
    m_States[block] |= queued;
    m_Queue.push_back(block);
  }

  void updateAfter(const RemovedVoxels& removed)
  {
    for (std::size_t v = 0; v < removed.voxels.size(); ++v)
    {
      recordChange(removed.labels[v], m_Map.labels[removed.voxels[v]]);
      enqueueAround(removed.voxels[v]);
    }
  }

  void run()
  {
    // Far more than pure noise takes.
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

private:
  struct Change
  {
    int cost = std::numeric_limits<int>::max();
    std::uint32_t noise = 0; ///< decides between equal costs
    std::size_t voxel = 0;
    Label label = 0;
  };

  static constexpr std::uint8_t queued = 128; ///< in m_States; the other bits count the changes of the voxel
  static constexpr std::uint8_t maximumCount = 127;
  static constexpr int patience = 16; ///< changes of a voxel, where there is an original to go back to

  /// Queues the critical ones of the eight blocks around a voxel.
  void enqueueAround(std::size_t voxel)
  {
    for (const std::ptrdiff_t c : m_Corners)
    {
      if (isCritical(gather(m_Map, voxel - c, m_Corners))) enqueue(voxel - c);
    }
  }

  void recordChange(Label from, Label to)
  {
    --m_Voxels[from];
    ++m_Voxels[to];
  }

  void restore(std::size_t block)
  {
    for (const std::ptrdiff_t corner : m_Corners)
    {
      const std::size_t voxel = block + corner;
      m_Fixed[voxel] = true;
      if (m_Map.labels[voxel] == m_Original->labels[voxel]) continue;
      recordChange(m_Map.labels[voxel], m_Original->labels[voxel]);
      m_Map.labels[voxel] = m_Original->labels[voxel];
      enqueueAround(voxel);
    }
  }

  bool isFixed(std::size_t voxel) const { return inMargin(voxel) || (m_Original && m_Fixed[voxel]); }

  /// The cheapest change of one voxel of the block to another label of the block. Neither fixed voxels nor the last
  /// voxel of a label are touched; cost stays at its maximum if nothing else is left.
  Change bestChange(std::size_t block) const
  {
    Change best;
    const Block labels = gather(m_Map, block, m_Corners);
    for (int c = 0; c < 8; ++c)
    {
      const std::size_t voxel = block + m_Corners[c];
      if (isFixed(voxel) || (labels[c] != 0 && m_Voxels[labels[c]] == 1)) continue;
      const Neighbourhood around = gather(m_Map, voxel, m_Around);
      const int price = changesOf(voxel) - criticalBlocks(around);
      for (int l = 0; l < 8; ++l)
      {
        if (labels[l] == labels[c] || std::find(labels.begin(), labels.begin() + l, labels[l]) != labels.begin() + l)
          continue;
        if (m_Closed.count(labels[l])) continue;
        const Change change{ price + costOf(around, labels[l]), noise(voxel, labels[l]), voxel, labels[l] };
        if (std::tie(change.cost, change.noise) < std::tie(best.cost, best.noise)) best = change;
      }
    }
    return best;
  }

  /// Critical blocks left if the centre is given to `label`, plus parts split or joined, plus growth of the interface.
  static int costOf(const Neighbourhood& around, Label label)
  {
    const Label old = around[centre];
    const int topology = std::abs(partsAround(around, old) - 1) + std::abs(partsAround(around, label) - 1);
    const int roughness = faceContacts(around, old) - faceContacts(around, label);
    Neighbourhood changed = around;
    changed[centre] = label;
    return criticalBlocks(changed) + topology + roughness;
  }

  void apply(const Change& change)
  {
    recordChange(m_Map.labels[change.voxel], change.label);
    m_Map.labels[change.voxel] = change.label;
    if (changesOf(change.voxel) < maximumCount) ++m_States[change.voxel];
    enqueueAround(change.voxel);
  }

  int changesOf(std::size_t voxel) const { return m_States[voxel] & maximumCount; }

  std::array<int, 3> position(std::size_t voxel) const { return m_Map.grid.voxelAt(voxel); }

  bool inMargin(std::size_t voxel) const
  {
    const auto p = position(voxel);
    for (int axis = 0; axis < 3; ++axis)
    {
      if (p[axis] == 0 || p[axis] + 1 == m_Map.grid.size[axis]) return true;
    }
    return false;
  }

  /// Differs from visit to visit, so that equal choices are not always taken the same way.
  std::uint32_t noise(std::size_t voxel, Label label) const
  {
    std::uint64_t h = (voxel * 65537 + label) * 256 + changesOf(voxel);
    h = (h ^ (h >> 31)) * 0x7fb5d329728ea185ull;
    h = (h ^ (h >> 27)) * 0x81dadef4bc2dd44dull;
    return std::uint32_t(h >> 33);
  }

  [[noreturn]] void throwUnresolved(std::size_t block) const
  {
    // The margin shifts voxels by one, the block's centre lies half a voxel higher.
    const auto p = position(block);
    const Vec3& s = m_Map.grid.spacing;
    const Vec3 place = m_Map.grid.gridToWorld({ (p[0] - 0.5) * s.x, (p[1] - 0.5) * s.y, (p[2] - 0.5) * s.z });
    std::ostringstream message;
    message << "map preparation: the diagonal contact at (" << place.x << ", " << place.y << ", " << place.z
            << ") mm could not be resolved";
    throw EngineError(message.str());
  }

  TissueMap& m_Map;
  std::array<std::ptrdiff_t, 8> m_Corners;
  std::array<std::ptrdiff_t, 27> m_Around;
  std::vector<std::uint8_t> m_States;
  std::vector<std::size_t> m_Voxels; ///< of each label
  std::vector<std::size_t> m_Queue;
  const TissueMap* m_Original = nullptr;
  std::vector<bool> m_Fixed; ///< empty without an original
  std::set<Label> m_Closed;
};

/// Books every voxel that differs: as an island's if it was in an island of the given map, else as a contact's.
void countChanges(const TissueMap& map, const TissueMap& prepared, const std::vector<std::size_t>& islandVoxels,
                  PreparationReport& report)
{
  const auto& size = map.grid.size;
  for (int k = 0; k < size[2]; ++k)
  {
    for (int j = 0; j < size[1]; ++j)
    {
      const Label* before = map.labels.data() + map.grid.index(0, j, k);
      const std::size_t row = prepared.grid.index(1, j + 1, k + 1);
      for (int i = 0; i < size[0]; ++i)
      {
        const Label after = prepared.labels[row + i];
        if (before[i] == after) continue;
        if (std::binary_search(islandVoxels.begin(), islandVoxels.end(), row + i))
        {
          ++report.changes[before[i]].islandVoxels;
          continue;
        }
        ++report.changes[before[i]].voxelsLost;
        ++report.changes[after].voxelsGained;
        ++report.contactVoxelsChanged;
      }
    }
  }
}

} // namespace

std::size_t countCriticalBlocks(const TissueMap& map) { return findCriticalBlocks(padded(map, 1)).size(); }

PreparationReport prepareMap(TissueMap& map, const PreparationOptions& options, const Progress& progress)
{
  report(progress, 0, "Removing islands");
  PreparationReport result;
  TissueMap work = padded(map, 1);
  const auto removeIslands = [&](bool count)
  {
    const Regions regions = connectedRegions(work);
    const std::vector<bool> isIsland = findIslands(work, regions, options);
    for (std::size_t r = 0; count && r < isIsland.size(); ++r)
    {
      if (isIsland[r]) ++result.changes[regions.list[r].label].islandsRemoved;
    }
    return removeRegions(work, regions, isIsland);
  };
  const RemovedVoxels islands = removeIslands(true);

  report(progress, 0.3, "Resolving contacts");
  ContactResolver resolver(work);
  const std::vector<std::size_t> blocks = findCriticalBlocks(work);
  result.criticalBlocksBefore = blocks.size();
  for (const std::size_t block : blocks) resolver.enqueue(block);
  resolver.run();

  // Resolving contacts can cut off new islands, and removing those can make new contacts.
  constexpr int maximumRounds = 20;
  for (int round = 0; round < maximumRounds; ++round)
  {
    report(progress, 0.6 + 0.3 * round / maximumRounds, "Resolving contacts");
    const RemovedVoxels cutOff = removeIslands(false);
    if (cutOff.voxels.empty()) break;
    resolver.updateAfter(cutOff);
    resolver.run();
  }
  countChanges(map, work, islands.voxels, result);
  report(progress, 1, "Resolving contacts");
  copyWithoutMargin(work, 1, map);
  return result;
}

void prepareAgain(TissueMap& map, const TissueMap& prepared, const PreparationOptions& options,
                  const ChangeLimits& limits)
{
  TissueMap work = padded(map, 1);
  const TissueMap original = padded(prepared, 1);
  ContactResolver resolver(work, original, paddedFlags(limits.fixedVoxels, map.grid), limits.closedLabels);
  for (const std::size_t block : findCriticalBlocks(work)) resolver.enqueue(block);
  constexpr int maximumRounds = 20;
  for (int round = 0; round < maximumRounds; ++round)
  {
    resolver.run();
    const Regions regions = connectedRegions(work);
    std::vector<bool> isIsland = findIslands(work, regions, options);
    excludeFixed(isIsland, regions, work.grid, resolver.fixedVoxels());
    const std::vector<Label> before = work.labels;
    const RemovedVoxels cutOff = removeRegions(work, regions, isIsland, limits.closedLabels);
    if (work.labels == before) break;
    resolver.updateAfter(cutOff);
  }
  resolver.run();
  copyWithoutMargin(work, 1, map);
}

} // namespace surgicalmesher
