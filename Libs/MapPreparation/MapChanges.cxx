// SPDX-License-Identifier: Apache-2.0
#include "MapChanges.h"

#include "DigitalTopology.h"
#include "Grouped.h"
#include "LocalTopology.h"
#include "Parallel.h"
#include "UnionFind.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <tuple>
#include <utility>

namespace surgicalmesher
{
namespace
{

using Voxels = std::vector<std::size_t>; // ascending if used as a set

bool holds(const Voxels& set, std::size_t voxel) { return std::binary_search(set.begin(), set.end(), voxel); }

/// Visits the members of a set near places that are given in ascending order.
class Cursor
{
public:
  /// Visits the set's voxels at offsets from `first` to `last` of each place.
  Cursor(const Voxels& set, std::ptrdiff_t first, std::ptrdiff_t last) : m_Set(set), m_First(first), m_Last(last) {}

  /// Calls f(n) for the members m_Set[n] near `place`.
  template <class F>
  void visitAt(std::size_t place, const F& f)
  {
    const auto offset = [&](std::size_t n) { return std::ptrdiff_t(m_Set[n]) - std::ptrdiff_t(place); };
    while (m_Next < m_Set.size() && offset(m_Next) < m_First) ++m_Next;
    for (std::size_t n = m_Next; n < m_Set.size() && offset(n) <= m_Last; ++n) f(n);
  }

private:
  const Voxels& m_Set;
  std::ptrdiff_t m_First, m_Last;
  std::size_t m_Next = 0;
};

/// Cursors for a voxel's neighbours that precede it in memory, one per row.
std::vector<Cursor> earlierNeighbours(const Voxels& set, const std::array<std::ptrdiff_t, 27>& steps,
                                      bool throughFacesOnly)
{
  const auto cursor = [&](int first, int last) { return Cursor(set, steps[first], steps[last]); };
  if (throughFacesOnly) return { cursor(4, 4), cursor(10, 10), cursor(12, 12) };
  return { cursor(0, 2), cursor(3, 5), cursor(6, 8), cursor(9, 11), cursor(12, 12) };
}

/// The connected components of `set`, each ascending, in the order of their first voxels.
std::vector<Voxels> partsOf(const Voxels& set, const std::array<std::ptrdiff_t, 27>& steps, bool throughFacesOnly)
{
  std::vector<Cursor> earlier = earlierNeighbours(set, steps, throughFacesOnly);
  UnionFind joined(set.size());
  for (std::size_t n = 0; n < set.size(); ++n)
    for (Cursor& row : earlier)
      row.visitAt(set[n], [&](std::size_t other) { joined.unite(std::uint32_t(other), std::uint32_t(n)); });
  std::vector<Voxels> parts;
  std::vector<std::uint32_t> partOf(set.size()); // set only at each part's first voxel
  for (std::uint32_t n = 0; n < set.size(); ++n)
  {
    const std::uint32_t first = joined.find(n);
    if (first == n)
    {
      partOf[n] = std::uint32_t(parts.size());
      parts.emplace_back();
    }
    parts[partOf[first]].push_back(set[n]);
  }
  return parts;
}

/// Finds the region of a voxel.
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
    const Voxels voxels = changed();
    Grouped<std::size_t> losses, gains;
    runInParallel({ [&] { losses = byLabel(voxels, m_Before); }, [&] { gains = byLabel(voxels, m_After); } });
    std::vector<std::vector<MapChange>> found(losses.groups() + gains.groups());
    const auto pieces = [&](std::size_t n)
    {
      const bool isLoss = n < losses.groups();
      const std::size_t label = isLoss ? n : n - losses.groups();
      const Grouped<std::size_t>& groups = isLoss ? losses : gains;
      for (const Voxels& piece : partsOf({ groups.begin(label), groups.end(label) }, m_Steps, isLoss))
        found[n].push_back(isLoss ? lost(Label(label), piece) : gained(Label(label), piece));
    };
    const std::vector<std::size_t> order = largestFirst(losses, gains);
    parallelForEach(order.size(), [&](std::size_t n) { pieces(order[n]); });
    std::vector<MapChange> changes;
    for (const std::vector<MapChange>& each : found) changes.insert(changes.end(), each.begin(), each.end());
    std::stable_sort(changes.begin(), changes.end(),
                     [](const MapChange& a, const MapChange& b)
                     { return std::tie(a.label, a.kind) < std::tie(b.label, b.kind); });
    return changes;
  }

private:
  /// The voxels that differ, ascending.
  Voxels changed() const
  {
    const std::size_t slice = std::size_t(m_Before.grid.size[0]) * m_Before.grid.size[1];
    std::vector<Voxels> slices(m_Before.grid.size[2]);
    parallelForEach(slices.size(),
                    [&](std::size_t k)
                    {
                      const Label *const before = m_Before.labels.data(), *const after = m_After.labels.data();
                      const std::size_t end = (k + 1) * slice;
                      for (std::size_t v = k * slice; v < end; ++v)
                      {
                        v = std::size_t(std::mismatch(before + v, before + end, after + v).first - before);
                        if (v < end) slices[k].push_back(v);
                      }
                    });
    Voxels result;
    for (const Voxels& voxels : slices) result.insert(result.end(), voxels.begin(), voxels.end());
    return result;
  }

  /// Groups voxels by their labels in `map`.
  static Grouped<std::size_t> byLabel(const Voxels& voxels, const TissueMap& map)
  {
    return Grouped<std::size_t>(std::size_t(std::numeric_limits<Label>::max()) + 1,
                                [&](auto&& visit)
                                {
                                  for (const std::size_t v : voxels) visit(map.labels[v], v);
                                });
  }

  /// The non-empty groups, largest first, those of `b` numbered after those of `a`: large groups at the end would leave
  /// threads idle.
  static std::vector<std::size_t> largestFirst(const Grouped<std::size_t>& a, const Grouped<std::size_t>& b)
  {
    const auto size = [&](std::size_t n) { return n < a.groups() ? a.size(n) : b.size(n - a.groups()); };
    std::vector<std::size_t> order;
    for (std::size_t n = 0; n < a.groups() + b.groups(); ++n)
      if (size(n) > 0) order.push_back(n);
    std::stable_sort(order.begin(), order.end(), [&](std::size_t m, std::size_t n) { return size(m) > size(n); });
    return order;
  }

  /// Voxels within a step of a piece, across edges and corners too, that `belongs` accepts.
  template <typename Predicate>
  Voxels around(const Voxels& piece, const Predicate& belongs) const
  {
    Voxels result;
    for (std::size_t begin = 0, end; begin < piece.size(); begin = end)
    {
      for (end = begin + 1; end < piece.size() && piece[end] == piece[end - 1] + 1;) ++end; // a run along i
      for (int row = 0; row < 27; row += 3)
        for (std::size_t v = piece[begin] + m_Steps[row]; v <= piece[end - 1] + m_Steps[row + 2]; ++v)
          if (belongs(v)) result.push_back(v);
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

  /// Returns the first voxel of each connected component of the voxels around a piece that `belongs` accepts.
  /// `throughFacesOnly` applies to the connections within components and to their contact with the piece. Most pieces
  /// are single voxels, which have a fast path.
  template <typename Predicate>
  Voxels partsBeside(const Voxels& piece, const Predicate& belongs, bool throughFacesOnly) const
  {
    if (piece.size() == 1) return partsBesideVoxel(piece[0], belongs, throughFacesOnly);
    Voxels firsts;
    for (const Voxels& part : partsOf(around(piece, belongs), m_Steps, throughFacesOnly))
      if (!throughFacesOnly || touchesByFace(part, piece)) firsts.push_back(part.front());
    return firsts;
  }

  template <typename Predicate>
  Voxels partsBesideVoxel(std::size_t voxel, const Predicate& belongs, bool throughFacesOnly) const
  {
    VoxelMask faces = 0, left = 0;
    for (const int face : sixNeighbours) faces |= VoxelMask(1) << face;
    for (int n = 0; n < 27; ++n) left |= VoxelMask(belongs(voxel + m_Steps[n])) << n;
    Voxels firsts;
    for (int n = 0; n < 27; ++n)
    {
      if ((left >> n & 1) == 0) continue;
      const VoxelMask part = firstPart(left, throughFacesOnly);
      if (!throughFacesOnly || (part & faces) != 0) firsts.push_back(voxel + m_Steps[n]);
      left &= ~part;
    }
    return firsts;
  }

  /// `parts`: the result of partsBeside() for the remaining voxels of the tissue.
  ChangeKind kindOfLoss(const Voxels& parts) const
  {
    if (parts.empty()) return ChangeKind::Island;
    if (parts.size() == 1) return ChangeKind::End;
    const std::uint32_t region = m_RegionsAfter.at(parts[0]);
    const auto isInRegion = [&](std::size_t voxel) { return m_RegionsAfter.at(voxel) == region; };
    return std::all_of(parts.begin(), parts.end(), isInRegion) ? ChangeKind::Handle : ChangeKind::Neck;
  }

  MapChange lost(Label label, const Voxels& piece) const
  {
    const auto remains = [&](std::size_t v) { return m_Before.labels[v] == label && m_After.labels[v] == label; };
    return { label, kindOfLoss(partsBeside(piece, remains, true)), piece.size(), placeOf(piece) };
  }

  MapChange gained(Label label, const Voxels& piece) const
  {
    const auto remains = [&](std::size_t v) { return m_Before.labels[v] != label && m_After.labels[v] != label; };
    const std::size_t parts = partsBeside(piece, remains, false).size();
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
