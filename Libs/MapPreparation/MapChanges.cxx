// SPDX-License-Identifier: Apache-2.0
#include "MapChanges.h"

#include "DigitalTopology.h"
#include "Parallel.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <tuple>
#include <utility>

namespace surgicalmesher
{
namespace
{

using Voxels = std::vector<std::size_t>; // ascending where it serves as a set

constexpr int centre = 13;

bool holds(const Voxels& set, std::size_t voxel) { return std::binary_search(set.begin(), set.end(), voxel); }

bool isFace(int neighbour)
{
  return std::find(sixNeighbours.begin(), sixNeighbours.end(), neighbour) != sixNeighbours.end();
}

/// Whether a part goes on to each neighbour of a voxel.
std::array<bool, 27> joins(bool throughFacesOnly)
{
  std::array<bool, 27> result;
  for (int n = 0; n < 27; ++n) result[n] = n != centre && (!throughFacesOnly || isFace(n));
  return result;
}

/// Takes a set of voxels apart.
class PartFinder
{
public:
  PartFinder(const Voxels& set, const std::array<std::ptrdiff_t, 27>& steps, bool throughFacesOnly)
    : m_Set(set), m_Steps(steps), m_IsJoined(joins(throughFacesOnly)), m_IsTaken(set.size(), false)
  {
  }

  std::vector<Voxels> find()
  {
    std::vector<Voxels> parts;
    for (std::size_t n = 0; n < m_Set.size(); ++n)
      if (!m_IsTaken[n]) parts.push_back(partFrom(n));
    return parts;
  }

private:
  Voxels partFrom(std::size_t first)
  {
    take(first);
    Voxels part;
    while (!m_Open.empty())
    {
      part.push_back(m_Set[m_Open.back()]);
      m_Open.pop_back();
      for (int row = 0; row < 27; row += 3) takeJoined(part.back(), row);
    }
    std::sort(part.begin(), part.end());
    return part;
  }

  void take(std::size_t n)
  {
    m_IsTaken[n] = true;
    m_Open.push_back(n);
  }

  /// Of the three neighbours in a row, which are next to each other in the set.
  void takeJoined(std::size_t voxel, int row)
  {
    if (!m_IsJoined[row] && !m_IsJoined[row + 1] && !m_IsJoined[row + 2]) return;
    const std::ptrdiff_t first = std::ptrdiff_t(voxel) + m_Steps[row];
    auto at = std::lower_bound(m_Set.begin(), m_Set.end(), std::size_t(std::max<std::ptrdiff_t>(first, 0)));
    for (; at != m_Set.end() && std::ptrdiff_t(*at) <= first + 2; ++at)
    {
      const auto n = std::size_t(at - m_Set.begin());
      if (m_IsJoined[row + std::ptrdiff_t(*at) - first] && !m_IsTaken[n]) take(n);
    }
  }

  const Voxels& m_Set;
  const std::array<std::ptrdiff_t, 27>& m_Steps;
  const std::array<bool, 27> m_IsJoined;
  std::vector<bool> m_IsTaken;
  std::vector<std::size_t> m_Open; ///< numbers in the set, whose neighbours have not been looked at
};

/// The parts that `set` falls into, each ascending, in the order of their first voxels.
std::vector<Voxels> partsOf(const Voxels& set, const std::array<std::ptrdiff_t, 27>& steps, bool throughFacesOnly)
{
  return PartFinder(set, steps, throughFacesOnly).find();
}

/// Regions of a map by voxel.
class RegionLookup
{
public:
  explicit RegionLookup(const TissueMap& map) : m_Regions(connectedRegions(map)), m_RowSize(map.grid.size[0]) {}

  std::uint32_t at(std::size_t voxel) const
  {
    const std::size_t row = voxel / m_RowSize;
    const auto begin = m_Regions.runs.begin() + m_Regions.rowBegins[row];
    const auto end = m_Regions.runs.begin() + m_Regions.rowBegins[row + 1];
    const auto startsLater = [](std::size_t i, const Run& run) { return i < run.begin; };
    return std::prev(std::upper_bound(begin, end, voxel % m_RowSize, startsLater))->region;
  }

private:
  Regions m_Regions;
  std::size_t m_RowSize;
};

class PieceFinder
{
public:
  PieceFinder(const PaddedMap& before, const PaddedMap& after)
    : m_Before(before), m_After(after), m_Steps(neighbourSteps(before.grid)), m_RegionsAfter(after)
  {
  }

  std::vector<MapChange> find() const
  {
    const auto losses = changedBy(m_Before), gains = changedBy(m_After);
    std::vector<std::vector<MapChange>> found(losses.size() + gains.size());
    parallelForEach(found.size(),
                    [&](std::size_t n)
                    {
                      const bool isLoss = n < losses.size();
                      const auto& [label, voxels] = isLoss ? losses[n] : gains[n - losses.size()];
                      for (const Voxels& piece : partsOf(voxels, m_Steps, isLoss))
                        found[n].push_back(isLoss ? lost(label, piece) : gained(label, piece));
                    });
    std::vector<MapChange> changes;
    for (const std::vector<MapChange>& each : found) changes.insert(changes.end(), each.begin(), each.end());
    std::stable_sort(changes.begin(), changes.end(),
                     [](const MapChange& a, const MapChange& b)
                     { return std::tie(a.label, a.kind) < std::tie(b.label, b.kind); });
    return changes;
  }

private:
  /// The voxels that differ, by their labels in `map`.
  std::vector<std::pair<Label, Voxels>> changedBy(const TissueMap& map) const
  {
    std::map<Label, Voxels> byLabel;
    for (std::size_t v = 0; v < m_Before.labels.size(); ++v)
    {
      if (m_Before.labels[v] != m_After.labels[v]) byLabel[map.labels[v]].push_back(v);
    }
    return { byLabel.begin(), byLabel.end() };
  }

  /// Voxels beside a piece, across corners too, that `belongs` accepts.
  template <typename Predicate>
  Voxels around(const Voxels& piece, const Predicate& belongs) const
  {
    Voxels result;
    for (const std::size_t voxel : piece)
    {
      for (const std::ptrdiff_t step : m_Steps)
      {
        if (belongs(voxel + step)) result.push_back(voxel + step);
      }
    }
    std::sort(result.begin(), result.end());
    result.erase(std::unique(result.begin(), result.end()), result.end());
    return result;
  }

  bool touchesByFace(const Voxels& part, const Voxels& piece) const
  {
    return std::any_of(part.begin(), part.end(),
                       [&](std::size_t voxel)
                       {
                         return std::any_of(sixNeighbours.begin(), sixNeighbours.end(),
                                            [&](int face) { return holds(piece, voxel + m_Steps[face]); });
                       });
  }

  MapChange lost(Label label, const Voxels& piece) const
  {
    const auto remains = [&](std::size_t v) { return m_Before.labels[v] == label && m_After.labels[v] == label; };
    std::vector<std::uint32_t> regions; // that the piece joined
    for (const Voxels& part : partsOf(around(piece, remains), m_Steps, true))
    {
      if (touchesByFace(part, piece)) regions.push_back(m_RegionsAfter.at(part.front()));
    }
    const bool areOne =
      std::count(regions.begin(), regions.end(), regions.empty() ? 0 : regions[0]) == std::ptrdiff_t(regions.size());
    const ChangeKind kind = regions.empty()       ? ChangeKind::Island
                            : regions.size() == 1 ? ChangeKind::End
                            : areOne              ? ChangeKind::Handle
                                                  : ChangeKind::Neck;
    return { label, kind, piece.size(), placeOf(piece) };
  }

  MapChange gained(Label label, const Voxels& piece) const
  {
    const auto remains = [&](std::size_t v) { return m_Before.labels[v] != label && m_After.labels[v] != label; };
    const std::size_t parts = partsOf(around(piece, remains), m_Steps, false).size();
    const ChangeKind kind = parts == 0 ? ChangeKind::Cavity : parts == 1 ? ChangeKind::Cleft : ChangeKind::Tunnel;
    return { label, kind, piece.size(), placeOf(piece) };
  }

  Vec3 placeOf(const Voxels& piece) const { return m_Before.worldAt(piece[piece.size() / 2]); }

  const PaddedMap& m_Before;
  const PaddedMap& m_After;
  std::array<std::ptrdiff_t, 27> m_Steps;
  RegionLookup m_RegionsAfter;
};

} // namespace

const char* nameOf(ChangeKind kind)
{
  constexpr std::array<const char*, changeKinds> names{ "islands",  "necks",   "handles", "ends",
                                                        "cavities", "tunnels", "clefts" };
  return names[int(kind)];
}

std::vector<MapChange> mapChanges(const PaddedMap& before, const PaddedMap& after)
{
  return PieceFinder(before, after).find();
}

} // namespace surgicalmesher
