#include "MapPreparation.h"

#include "DigitalTopology.h"
#include "Errors.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <sstream>
#include <tuple>
#include <utility>

namespace surgicalmesher
{
namespace
{

// Corners of a block: bit 0 of the number is i, bit 1 j, bit 2 k. Voxels of a 3x3x3 neighbourhood: i + 3 j + 9 k, centre 13.

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

/// Face-connected parts of `label` among the 18 voxels around the centre, of which only those that touch the centre by a
/// face count. One means that the centre can join or leave the label without changing how its surroundings hang together.
int partsAround(const Neighbourhood& n, Label label)
{
  constexpr std::array<int, 6> faces{ 4, 10, 12, 14, 16, 22 };
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
  return (n[4] == label) + (n[10] == label) + (n[12] == label) + (n[14] == label) + (n[16] == label) + (n[22] == label);
}

/// A copy of the map with a margin of one voxel of background, so that every voxel of the map has 26 neighbours.
TissueMap padded(const TissueMap& map)
{
  TissueMap result;
  result.grid = map.grid;
  for (int& size : result.grid.size) size += 2;
  result.labels.assign(result.grid.voxelCount(), 0);
  for (int k = 0; k < map.grid.size[2]; ++k)
  {
    for (int j = 0; j < map.grid.size[1]; ++j)
    {
      const Label* row = map.labels.data() + map.grid.index(0, j, k);
      std::copy(row, row + map.grid.size[0], result.labels.data() + result.grid.index(1, j + 1, k + 1));
    }
  }
  return result;
}

/// Offsets from a voxel of a padded map to others near it.
struct Offsets
{
  std::array<std::ptrdiff_t, 8> corners; ///< from the lowest corner of a block
  std::array<std::ptrdiff_t, 27> around;

  explicit Offsets(const Grid& grid)
  {
    const std::ptrdiff_t j = grid.size[0], k = j * grid.size[1];
    for (int c = 0; c < 8; ++c) corners[c] = (c & 1) + (c >> 1 & 1) * j + (c >> 2) * k;
    for (int n = 0; n < 27; ++n) around[n] = (n % 3 - 1) + (n / 3 % 3 - 1) * j + (n / 9 - 1) * k;
  }
};

template <std::size_t N>
std::array<Label, N> gather(const TissueMap& map, std::size_t voxel, const std::array<std::ptrdiff_t, N>& offsets)
{
  std::array<Label, N> result;
  for (std::size_t n = 0; n < N; ++n) result[n] = map.labels[voxel + offsets[n]];
  return result;
}

/// Lowest corners of the critical blocks of a padded map, ascending. Uniform blocks cost one comparison.
std::vector<std::size_t> findCriticalBlocks(const TissueMap& map)
{
  const auto& size = map.grid.size;
  const Offsets offsets(map.grid);
  std::vector<std::size_t> result;
  std::vector<Label> differs(size[0]);
  for (int k = 0; k + 1 < size[2]; ++k)
  {
    for (int j = 0; j + 1 < size[1]; ++j)
    {
      const std::size_t begin = map.grid.index(0, j, k);
      const Label* a = map.labels.data() + begin;
      const Label *b = a + offsets.corners[2], *c = a + offsets.corners[4], *d = a + offsets.corners[6];
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

/// Removes small components from a padded map.
class IslandRemover
{
public:
  IslandRemover(TissueMap& map, double minimumVolume)
    : m_Map(map), m_Offsets(map.grid), m_MinimumVolume(minimumVolume)
  {
    const Vec3& s = map.grid.spacing;
    m_FaceAreas = { s.x * s.y, s.x * s.z, s.y * s.z };
    m_VoxelVolume = s.x * s.y * s.z;
  }

  struct Islands
  {
    std::map<Label, std::size_t> components; ///< by tissue
    std::vector<std::size_t> voxels;         ///< ascending
    std::vector<Label> labels;               ///< that the voxels had
  };

  Islands run()
  {
    Islands islands = find();
    m_Open.assign(m_Map.labels.size(), false);
    for (const std::size_t v : islands.voxels) m_Open[v] = true;
    std::vector<std::size_t> open = islands.voxels;
    while (!open.empty()) open = peel(open);
    return islands;
  }

private:
  Islands find() const
  {
    const Regions regions = connectedRegions(m_Map);
    std::map<Label, std::size_t> largest;
    for (std::size_t r = 1; r < regions.list.size(); ++r)
    {
      const auto [entry, isNew] = largest.emplace(regions.list[r].label, r);
      if (!isNew && regions.list[entry->second].voxels < regions.list[r].voxels) entry->second = r;
    }
    std::vector<bool> isIsland(regions.list.size(), false);
    Islands islands;
    for (std::size_t r = 1; r < regions.list.size(); ++r)
    {
      const auto [label, voxels] = regions.list[r];
      isIsland[r] = label != 0 && voxels * m_VoxelVolume < m_MinimumVolume && largest[label] != r;
      if (isIsland[r]) ++islands.components[label];
    }
    collect(regions, isIsland, islands);
    return islands;
  }

  void collect(const Regions& regions, const std::vector<bool>& isIsland, Islands& islands) const
  {
    const std::size_t size = m_Map.grid.size[0];
    for (std::size_t row = 0; row + 1 < regions.rowBegins.size(); ++row)
    {
      for (std::size_t r = regions.rowBegins[row]; r < regions.rowBegins[row + 1]; ++r)
      {
        if (!isIsland[regions.runs[r].region]) continue;
        const std::size_t end = r + 1 < regions.rowBegins[row + 1] ? regions.runs[r + 1].begin : size;
        for (std::size_t i = regions.runs[r].begin; i < end; ++i) islands.voxels.push_back(row * size + i);
      }
    }
    for (const std::size_t v : islands.voxels) islands.labels.push_back(m_Map.labels[v]);
  }

  /// Gives every open voxel that touches settled ones to the label it shares most surface with; returns the others.
  std::vector<std::size_t> peel(const std::vector<std::size_t>& open)
  {
    std::vector<std::size_t> rest, settled;
    std::vector<Label> labels;
    for (const std::size_t v : open)
    {
      Label label;
      if (adopter(v, label))
      {
        settled.push_back(v);
        labels.push_back(label);
      }
      else
      {
        rest.push_back(v);
      }
    }
    for (std::size_t s = 0; s < settled.size(); ++s)
    {
      m_Map.labels[settled[s]] = labels[s];
      m_Open[settled[s]] = false;
    }
    return rest;
  }

  /// The label with most face contact to voxel `v`, then with most of the 26 neighbours, then the lowest.
  bool adopter(std::size_t v, Label& result) const
  {
    double bestArea = 0;
    int bestCount = 0;
    for (const int face : { 4, 10, 12, 14, 16, 22 })
    {
      const std::size_t neighbour = v + m_Offsets.around[face];
      if (m_Open[neighbour]) continue;
      const Label label = m_Map.labels[neighbour];
      const auto [area, count] = contact(v, label);
      if (area < bestArea || (area == bestArea && (count < bestCount || (count == bestCount && label > result)))) continue;
      bestArea = area;
      bestCount = count;
      result = label;
    }
    return bestArea > 0;
  }

  /// Shared surface in mm^2, and number of the 26 neighbours.
  std::pair<double, int> contact(std::size_t v, Label label) const
  {
    std::pair<double, int> result{ 0, 0 };
    for (int n = 0; n < 27; ++n)
    {
      const std::size_t neighbour = v + m_Offsets.around[n];
      if (n == centre || m_Open[neighbour] || m_Map.labels[neighbour] != label) continue;
      ++result.second;
      if (n == 4 || n == 22) result.first += m_FaceAreas[0];
      if (n == 10 || n == 16) result.first += m_FaceAreas[1];
      if (n == 12 || n == 14) result.first += m_FaceAreas[2];
    }
    return result;
  }

  TissueMap& m_Map;
  Offsets m_Offsets;
  double m_MinimumVolume, m_VoxelVolume;
  std::array<double, 3> m_FaceAreas; ///< across k, j, i
  std::vector<bool> m_Open;
};

/// Empties a queue of critical blocks of a padded map, one voxel at a time.
///
/// Each change is the cheapest among the voxels and labels of the block at hand: it leaves few critical blocks around the
/// voxel, labels that hang together as they did, and little interface. A voxel becomes dearer with every change, so the
/// search cannot circle for ever, and where no change helps it wanders until one does.
class ContactResolver
{
public:
  explicit ContactResolver(TissueMap& map)
    : m_Map(map), m_Offsets(map.grid), m_States(map.labels.size(), 0), m_Voxels(std::numeric_limits<Label>::max() + 1, 0)
  {
    for (const Label label : map.labels) ++m_Voxels[label];
  }

  void enqueue(std::size_t block)
  {
    if (m_States[block] & queued) return;
    m_States[block] |= queued;
    m_Queue.push_back(block);
  }

  void updateAfter(const IslandRemover::Islands& removed)
  {
    for (std::size_t v = 0; v < removed.voxels.size(); ++v)
    {
      recordChange(removed.labels[v], m_Map.labels[removed.voxels[v]]);
      enqueueAround(removed.voxels[v]);
    }
  }

  void run()
  {
    // Pure noise takes about one change per critical block: a hundred mean that there is no way out.
    std::size_t changesLeft = 1000 + 100 * m_Queue.size();
    for (std::size_t head = 0; head < m_Queue.size(); ++head)
    {
      const std::size_t block = m_Queue[head];
      m_States[block] &= ~queued;
      if (!isCritical(gather(m_Map, block, m_Offsets.corners))) continue;
      const Change change = bestChange(block);
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

  /// Queues the critical ones of the eight blocks around a voxel.
  void enqueueAround(std::size_t voxel)
  {
    for (const std::ptrdiff_t c : m_Offsets.corners)
    {
      if (isCritical(gather(m_Map, voxel - c, m_Offsets.corners))) enqueue(voxel - c);
    }
  }

  void recordChange(Label from, Label to)
  {
    --m_Voxels[from];
    ++m_Voxels[to];
  }

  /// The cheapest change of one voxel of the block to another label of the block. Neither the margin nor the last voxel
  /// of a label is touched; cost stays at its maximum if nothing else is left.
  Change bestChange(std::size_t block) const
  {
    Change best;
    const Block labels = gather(m_Map, block, m_Offsets.corners);
    for (int c = 0; c < 8; ++c)
    {
      const std::size_t voxel = block + m_Offsets.corners[c];
      if (inMargin(voxel) || (labels[c] != 0 && m_Voxels[labels[c]] == 1)) continue;
      const Neighbourhood around = gather(m_Map, voxel, m_Offsets.around);
      const int price = changesOf(voxel) - criticalBlocks(around);
      for (int l = 0; l < 8; ++l)
      {
        if (labels[l] == labels[c] || std::find(labels.begin(), labels.begin() + l, labels[l]) != labels.begin() + l) continue;
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

  std::array<int, 3> position(std::size_t voxel) const
  {
    const auto& size = m_Map.grid.size;
    return { int(voxel % size[0]), int(voxel / size[0] % size[1]), int(voxel / size[0] / size[1]) };
  }

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
  Offsets m_Offsets;
  std::vector<std::uint8_t> m_States;
  std::vector<std::size_t> m_Voxels; ///< of each label
  std::vector<std::size_t> m_Queue;
};

void copyInside(const TissueMap& from, TissueMap& map)
{
  for (int k = 0; k < map.grid.size[2]; ++k)
  {
    for (int j = 0; j < map.grid.size[1]; ++j)
    {
      const Label* row = from.labels.data() + from.grid.index(1, j + 1, k + 1);
      std::copy(row, row + map.grid.size[0], map.labels.data() + map.grid.index(0, j, k));
    }
  }
}

/// Books every voxel that differs: as an island's if it was in an island of the given map, else as a contact's.
void countChanges(const TissueMap& map, const TissueMap& prepared, const IslandRemover::Islands& islands,
                  PreparationReport& report)
{
  for (const auto& [label, components] : islands.components) report.changes[label].islandsRemoved = components;
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
        if (std::binary_search(islands.voxels.begin(), islands.voxels.end(), row + i))
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

std::size_t countCriticalBlocks(const TissueMap& map)
{
  return findCriticalBlocks(padded(map)).size();
}

PreparationReport prepareMap(TissueMap& map, const PreparationOptions& options, const Progress& progress)
{
  report(progress, 0, "Removing islands");
  TissueMap work = padded(map);
  IslandRemover remover(work, options.minimumIslandVolume);
  const IslandRemover::Islands islands = remover.run();

  report(progress, 0.3, "Resolving contacts");
  PreparationReport result;
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
    const IslandRemover::Islands cutOff = remover.run();
    if (cutOff.voxels.empty()) break;
    resolver.updateAfter(cutOff);
    resolver.run();
  }
  countChanges(map, work, islands, result);
  report(progress, 1, "Resolving contacts");
  copyInside(work, map);
  return result;
}

} // namespace surgicalmesher
