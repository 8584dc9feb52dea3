// SPDX-License-Identifier: Apache-2.0
#include "FeatureSimplification.h"

#include "BoundaryFaces.h"
#include "DirtyCubes.h"
#include "Parallel.h"
#include "RegionRemoval.h"
#include "VoxelBall.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <tuple>
#include <utility>
#include <vector>

namespace surgicalmesher
{
namespace
{

/// A voxel whose label fills less than this share of the ball around it may change. The share is 1/2 at a flat
/// boundary, 0.4 at the surface of a strand of the ball's diameter, and 5/16 at the surface of a ball of that diameter.
/// A larger value damages small tissues; a smaller one keeps strands of thickness s.
constexpr double requiredShare = 0.38;

constexpr double largestSize = 16; ///< in smallest voxel spacings

/// s(x) at the voxels of a map.
class FeatureSizes
{
public:
  FeatureSizes(const PaddedMap& map, const ScaleField& scale, double featureScale)
    : m_Map(map), m_Scale(scale), m_Factor(featureScale), m_Smallest(map.grid.smallestSpacing())
  {
  }

  /// s in mm; 0 where the voxel must not change.
  double at(std::size_t voxel) const
  {
    const double size = m_Factor * m_Scale(m_Map.worldAt(voxel));
    return size < m_Smallest ? 0 : std::min(size, largestSize * m_Smallest);
  }

  double smallestSpacing() const { return m_Smallest; }

private:
  const PaddedMap& m_Map;
  const ScaleField& m_Scale;
  double m_Factor, m_Smallest;
};

/// Balls by their diameter, mm.
class Balls
{
public:
  Balls(const Grid& grid, double smallestSpacing, double largestDiameter) : m_Unit(smallestSpacing / 4)
  {
    for (int index = 0; index <= indexOf(largestDiameter); ++index) m_Balls.emplace_back(grid, index * m_Unit / 2);
  }

  const VoxelBall& operator[](int index) const { return m_Balls[index]; }
  int indexOf(double diameter) const { return int(std::lround(diameter / m_Unit)); } ///< at most 4 * largestSize + 4

private:
  double m_Unit;
  std::vector<VoxelBall> m_Balls;
};

/// Cached data of the voxels of a cube.
struct CubeMemory
{
  static constexpr std::uint8_t unknown = 255, none = 0, mostRoom = 255;

  CubeMemory() { balls.fill(unknown); }

  /// Indices of their balls; cached because evaluating L takes longer than applying the share rule.
  std::array<std::uint8_t, DirtyCubes::voxels> balls;
  /// Number of voxels around a voxel that must change before its label can; 0: unknown.
  std::array<std::uint8_t, DirtyCubes::voxels> room{};

  void change(std::uint32_t voxels)
  {
    const auto all = std::uint8_t(std::min(voxels, std::uint32_t(mostRoom)));
    for (std::uint8_t& left : room) left = left > all ? std::uint8_t(left - all) : std::uint8_t(0);
  }
};

/// The CubeMemory of all cubes that have been examined.
class Memory
{
public:
  explicit Memory(std::size_t cubes) : m_Place(cubes, absent) {}

  void add(std::size_t cube)
  {
    if (m_Place[cube] != absent) return;
    m_Place[cube] = std::uint32_t(m_Cubes.size());
    m_Cubes.emplace_back();
  }

  CubeMemory& operator[](std::size_t cube) { return m_Cubes[m_Place[cube]]; }

private:
  static constexpr std::uint32_t absent = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> m_Place; ///< index in m_Cubes, by cube
  std::vector<CubeMemory> m_Cubes;
};

/// A change of one voxel to another label.
struct Change
{
  std::size_t voxel;
  std::size_t cube; ///< that contains the voxel
  Label before, after;

  bool operator<(const Change& other) const
  {
    return std::tie(cube, voxel, after) < std::tie(other.cube, other.voxel, other.after);
  }
};

using Changes = std::vector<Change>; ///< ascending, of different voxels

/// The changes made by the rules, step by step.
struct Course
{
  Changes small;               ///< by the first removal of small regions
  std::vector<Changes> rounds; ///< by the share rule
  Changes cutOff;              ///< by the last removal of regions, which the share rule cut off
};

/// Applies the two rules.
class Simplifier
{
public:
  Simplifier(PaddedMap& map, const ScaleField& scale, double featureScale, double largest)
    : m_Map(map), m_Steps(neighbourSteps(map.grid)), m_Sizes(map, scale, featureScale), m_Largest(largest),
      m_Balls(map.grid, m_Sizes.smallestSpacing(), largest + m_Sizes.smallestSpacing()), m_Dirty(map.grid),
      m_Memory(m_Dirty.count())
  {
  }

  /// Simplifies the map without changing the labels in `closed`. After takeBack(), it can run again with further closed
  /// labels; then only the surroundings of these labels, and of places that change differently, are examined again.
  void run(const std::set<Label>& closed)
  {
    const Course last = std::exchange(m_Course, {});
    const std::set<Label> wereClosed = std::exchange(m_Closed, closed);
    m_Course.small = removeSmallRegions();
    m_Memory = Memory(m_Dirty.count());
    m_Dirty.take();
    m_IsOpen.assign(m_Dirty.count(), last.rounds.empty());
    if (last.rounds.empty()) m_Dirty.markBoundary(m_Map, m_Map.margin);
    else openAround(wereClosed, differences(last.small, m_Course.small));
    applyShareRule(last.rounds);
    m_Course.cutOff = removeSmallRegions();
  }

  void takeBack()
  {
    const auto undo = [&](const Changes& changes)
    {
      for (const Change& c : changes) m_Map.labels[c.voxel] = c.before;
    };
    undo(m_Course.cutOff);
    std::for_each(m_Course.rounds.rbegin(), m_Course.rounds.rend(), undo);
    undo(m_Course.small);
  }

private:
  Changes removeSmallRegions()
  {
    const Regions regions = connectedRegions(m_Map);
    const RemovedVoxels removed = removeRegions(m_Map, regions, smallRegions(regions), m_Closed);
    Changes changes;
    for (std::size_t n = 0; n < removed.voxels.size(); ++n)
    {
      const std::size_t v = removed.voxels[n];
      changes.push_back({ v, m_Dirty.cubeOf(v), removed.labels[n], m_Map.labels[v] });
    }
    std::sort(changes.begin(), changes.end());
    return changes;
  }

  /// Whether each region is small, compared with the least s in it. The search in a region stops as soon as the region
  /// is too large.
  std::vector<bool> smallRegions(const Regions& regions) const
  {
    const Vec3& s = m_Map.grid.spacing;
    const double voxelVolume = s.x * s.y * s.z;
    const auto isUnder = [&](std::size_t region, double size)
    { return regions.list[region].voxels * voxelVolume < size * size * size; };
    std::vector<bool> isSmall = largestRegions(regions);
    for (std::size_t r = 0; r < isSmall.size(); ++r)
    {
      const Label label = regions.list[r].label;
      isSmall[r] = (!isSmall[r] || (label == 0 && r != 0)) && !m_Closed.count(label) && isUnder(r, m_Largest);
    }
    forEachRun(regions, m_Map.grid.size[0],
               [&](std::uint32_t region, std::size_t begin, std::size_t end)
               {
                 for (std::size_t v = begin; isSmall[region] && v < end; ++v)
                   isSmall[region] = isUnder(region, m_Sizes.at(v));
               });
    return isSmall;
  }

  /// `last`: the rounds of the last run, which are repeated in the cubes that are not open; empty if all are open.
  void applyShareRule(const std::vector<Changes>& last)
  {
    // A detail narrower than s is gone after s rounds, in voxels. More rounds would erode thin sheets from their edges.
    const int rounds = int(std::ceil(m_Largest / m_Sizes.smallestSpacing()));
    for (int round = 0; round < rounds; ++round)
      m_Course.rounds.push_back(last.empty() ? applyRound() : applyRoundAgain(last[round]));
  }

  Changes applyRound()
  {
    Changes changes = findChanges(m_Dirty.take());
    apply(changes);
    return changes;
  }

  /// Repeats the changes of `last` in the cubes that are not open, and applies the rule in the others.
  Changes applyRoundAgain(const Changes& last)
  {
    std::vector<DirtyCubes::Dirty> dirty = m_Dirty.take();
    dirty.erase(std::remove_if(dirty.begin(), dirty.end(), [&](const auto& d) { return !m_IsOpen[d.cube]; }),
                dirty.end());
    const Changes found = findChanges(dirty);
    Changes kept, left, all;
    std::partition_copy(last.begin(), last.end(), std::back_inserter(left), std::back_inserter(kept),
                        [&](const Change& c) { return m_IsOpen[c.cube]; });
    std::merge(kept.begin(), kept.end(), found.begin(), found.end(), std::back_inserter(all));
    apply(all);
    open(differences(left, found));
    return all;
  }

  static Changes differences(const Changes& a, const Changes& b)
  {
    Changes result;
    std::set_symmetric_difference(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(result));
    return result;
  }

  /// Opens the cubes whose voxels may be affected by the changes, or by voxels of newly closed labels.
  void openAround(const std::set<Label>& wereClosed, const Changes& changed)
  {
    open(changed);
    std::set<Label> labels;
    std::set_difference(m_Closed.begin(), m_Closed.end(), wereClosed.begin(), wereClosed.end(),
                        std::inserter(labels, labels.end()));
    for (const std::size_t v : boundaryOf(labels)) open(v, 1);
  }

  void open(const Changes& changes)
  {
    for (const Change& c : changes) open(c.voxel, m_Map.margin - 1);
  }

  /// Opens the cubes that hold a voxel within `reach` steps, along each axis, of `voxel`.
  void open(std::size_t voxel, int reach)
  {
    const std::array<int, 3> at = m_Map.grid.voxelAt(voxel);
    m_Dirty.forEachNear(at, at, reach, [&](std::size_t cube) { m_IsOpen[cube] = true; });
    m_Dirty.mark(at, at, reach, 1);
  }

  /// The voxels of these labels that have a face neighbour of another label.
  std::vector<std::size_t> boundaryOf(const std::set<Label>& labels) const
  {
    const auto& size = m_Map.grid.size;
    const int margin = m_Map.margin;
    std::vector<std::vector<std::size_t>> slices(std::size_t(size[2] - 2 * margin));
    parallelForEach(slices.size(),
                    [&](std::size_t slice)
                    {
                      const auto keep = [&](std::size_t v)
                      {
                        if (labels.count(m_Map.labels[v])) slices[slice].push_back(v);
                      };
                      for (int j = margin; j < size[1] - margin; ++j)
                        forEachBoundaryVoxel(m_Map, j, margin + int(slice), margin, size[0] - margin, keep);
                    });
    std::vector<std::size_t> result;
    for (const auto& slice : slices) result.insert(result.end(), slice.begin(), slice.end());
    return result;
  }

  void apply(const Changes& changes)
  {
    for (auto first = changes.begin(), end = first; first != changes.end(); first = end)
    {
      end = std::find_if(first, changes.end(), [&](const Change& c) { return c.cube != first->cube; });
      std::array<int, 3> low = m_Map.grid.voxelAt(first->voxel), high = low;
      for (auto c = first; c != end; ++c)
      {
        m_Map.labels[c->voxel] = c->after;
        const std::array<int, 3> at = m_Map.grid.voxelAt(c->voxel);
        for (int axis = 0; axis < 3; ++axis)
        {
          low[axis] = std::min(low[axis], at[axis]);
          high[axis] = std::max(high[axis], at[axis]);
        }
      }
      m_Dirty.mark(low, high, m_Map.margin - 1, std::size_t(end - first));
    }
  }

  /// The changes that the share rule makes to the present map in these cubes.
  Changes findChanges(const std::vector<DirtyCubes::Dirty>& cubes)
  {
    std::vector<Changes> changes(cubes.size());
    for (const DirtyCubes::Dirty& dirty : cubes) m_Memory.add(dirty.cube);
    parallelFor(cubes.size(),
                [&](std::size_t c)
                {
                  const std::size_t cube = cubes[c].cube;
                  CubeMemory& memory = m_Memory[cube];
                  memory.change(cubes[c].changes);
                  const auto visit = [&](std::size_t voxel, int n)
                  {
                    const Label label = ruling(voxel, n, memory);
                    if (label != m_Map.labels[voxel]) changes[c].push_back({ voxel, cube, m_Map.labels[voxel], label });
                  };
                  m_Dirty.visitBoundary(m_Map, cube, m_Map.margin, visit);
                });
    Changes all;
    for (const Changes& of : changes) all.insert(all.end(), of.begin(), of.end());
    return all;
  }

  /// The label that the share rule gives to a voxel, which has number n in its cube.
  Label ruling(std::size_t voxel, int n, CubeMemory& memory) const
  {
    std::uint8_t &ball = memory.balls[n], &room = memory.room[n];
    if (room > 0) return m_Map.labels[voxel];
    if (ball == CubeMemory::unknown) ball = ballOf(voxel);
    return ball == CubeMemory::none ? m_Map.labels[voxel] : ruling(voxel, m_Balls[ball], room);
  }

  std::uint8_t ballOf(std::size_t voxel) const
  {
    const double size = m_Sizes.at(voxel);
    // Balls count voxel centres: the diameter is half a voxel larger on each side.
    return size == 0 ? CubeMemory::none : std::uint8_t(m_Balls.indexOf(size + m_Sizes.smallestSpacing()));
  }

  /// The same for a given ball. Sets `room` (see CubeMemory) if the voxel's own label fills enough of the ball.
  Label ruling(std::size_t voxel, const VoxelBall& ball, std::uint8_t& room) const
  {
    const Label own = m_Map.labels[voxel];
    if (m_Closed.count(own)) return own;
    const Label* const centre = m_Map.labels.data() + voxel;
    const auto required = std::size_t(std::ceil(requiredShare * double(ball.size())));
    const std::size_t ownShare = ball.count(centre, own);
    if (ownShare >= required)
    {
      room = std::uint8_t(std::min(ownShare - required + 1, std::size_t(CubeMemory::mostRoom)));
      return own;
    }
    std::array<Label, 6> others;
    const int count = othersBeside(voxel, own, others);
    Label best = own;
    std::size_t bestShare = ownShare;
    for (int o = 0; o < count; ++o)
    {
      const std::size_t share = ball.count(centre, others[o]);
      if (share < bestShare || (share == bestShare && (best == own || best < others[o]))) continue;
      best = others[o];
      bestShare = share;
    }
    return best;
  }

  /// Finds the labels across the faces of a voxel that may gain it; returns their number.
  int othersBeside(std::size_t voxel, Label own, std::array<Label, 6>& others) const
  {
    int count = 0;
    for (const int face : sixNeighbours)
    {
      const Label label = m_Map.labels[voxel + m_Steps[face]];
      if (label == own || std::find(others.begin(), others.begin() + count, label) != others.begin() + count) continue;
      if (!m_Closed.count(label)) others[count++] = label;
    }
    return count;
  }

  PaddedMap& m_Map;
  std::array<std::ptrdiff_t, 27> m_Steps;
  FeatureSizes m_Sizes;
  double m_Largest; ///< the largest s, mm
  Balls m_Balls;
  std::set<Label> m_Closed;
  Course m_Course; ///< of the last run
  DirtyCubes m_Dirty;
  std::vector<char> m_IsOpen; ///< per cube: whether it may change differently than in the last run
  Memory m_Memory;            ///< of the open cubes
};

/// Tissues that have less than half of their voxels left.
std::set<Label> halved(const std::map<Label, std::size_t>& before, const TissueMap& map)
{
  const std::map<Label, std::size_t> after = countVoxels(map);
  std::set<Label> result;
  for (const auto& [label, voxels] : before)
  {
    const auto left = after.find(label);
    if (label != 0 && (left == after.end() || 2 * left->second < voxels)) result.insert(label);
  }
  return result;
}

/// The largest s, mm.
double largestFeature(const Grid& grid, const ScaleField& scale, double featureScale)
{
  const double longest = *std::max_element(scale.lengths.begin(), scale.lengths.end());
  return std::min(featureScale * longest, largestSize * grid.smallestSpacing());
}

} // namespace

int featureMargin(const Grid& grid, const ScaleField& scale, double featureScale)
{
  return 1 + int((largestFeature(grid, scale, featureScale) / grid.smallestSpacing() + 1) / 2);
}

std::set<Label> simplifyFeatures(PaddedMap& map, const ScaleField& scale, const FeatureOptions& options,
                                 const Progress& progress)
{
  const double largest = largestFeature(map.grid, scale, options.featureScale);
  std::set<Label> keptWhole;
  if (!(largest >= map.grid.smallestSpacing())) return keptWhole;

  const std::map<Label, std::size_t> voxels = countVoxels(map);
  std::set<Label> closed = options.protectedLabels;
  Simplifier simplifier(map, scale, options.featureScale, largest);
  for (double done = 0;; done += (0.9 - done) / 2)
  {
    report(progress, done, "Simplifying features");
    simplifier.run(closed);
    const std::set<Label> tooSmall = halved(voxels, map);
    if (tooSmall.empty()) return keptWhole;
    simplifier.takeBack();
    keptWhole.insert(tooSmall.begin(), tooSmall.end());
    closed.insert(tooSmall.begin(), tooSmall.end());
  }
}

bool isBelowScale(const PaddedMap& map, const ScaleField& scale, double featureScale, std::size_t voxel)
{
  return FeatureSizes(map, scale, featureScale).at(voxel) == 0;
}

} // namespace surgicalmesher
