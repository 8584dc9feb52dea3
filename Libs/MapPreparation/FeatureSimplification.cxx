// SPDX-License-Identifier: Apache-2.0
#include "FeatureSimplification.h"

#include "BoundaryFaces.h"
#include "Parallel.h"
#include "RegionRemoval.h"
#include "VoxelBall.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace surgicalmesher
{
namespace
{

/// A voxel whose label fills less than this share of the ball around it may change. A flat boundary leaves a voxel 1/2,
/// the surface of a strand of the ball's diameter 0.4, that of such a ball 5/16. Higher, small tissues suffer; lower,
/// strands as thick as s stay.
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

  /// mm; 0 where nothing is to change.
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

/// Cubes of voxels in which something may have to be looked at again.
class DirtyCubes
{
  static constexpr int side = 4;

public:
  explicit DirtyCubes(const Grid& grid) : m_Grid(grid)
  {
    for (int axis = 0; axis < 3; ++axis) m_Count[axis] = (grid.size[axis] + side - 1) / side;
    m_Changes.assign(std::size_t(m_Count[0]) * m_Count[1] * m_Count[2], 0);
  }

  /// Marks the cubes that hold a voxel with another label beside it, `margin` voxels at the grid's border left out.
  void markBoundary(const TissueMap& map, int margin)
  {
    const auto& size = m_Grid.size;
    parallelForEach(std::size_t(m_Count[2]),
                    [&](std::size_t slab)
                    {
                      const int from = std::max(margin, int(slab) * side);
                      const int to = std::min(size[2] - margin, (int(slab) + 1) * side);
                      const auto mark = [&](std::size_t voxel)
                      {
                        const std::array<int, 3> c = m_Grid.voxelAt(voxel);
                        m_Changes[(slab * m_Count[1] + c[1] / side) * m_Count[0] + c[0] / side] = 1;
                      };
                      for (int k = from; k < to; ++k)
                        for (int j = margin; j < size[1] - margin; ++j)
                          forEachBoundaryVoxel(map, j, k, margin, size[0] - margin, mark);
                    });
  }

  /// Marks the cubes that hold a voxel within `reach` steps along each axis of a box in which so many voxels change.
  void mark(const std::array<int, 3>& first, const std::array<int, 3>& last, int reach, std::size_t changes)
  {
    std::array<int, 3> from, to;
    for (int axis = 0; axis < 3; ++axis)
    {
      from[axis] = std::max(0, first[axis] - reach) / side;
      to[axis] = std::min(m_Grid.size[axis] - 1, last[axis] + reach) / side;
    }
    for (int k = from[2]; k <= to[2]; ++k)
      for (int j = from[1]; j <= to[1]; ++j)
        for (int i = from[0]; i <= to[0]; ++i)
          m_Changes[(std::size_t(k) * m_Count[1] + j) * m_Count[0] + i] += std::uint32_t(changes);
  }

  struct Dirty
  {
    std::size_t cube;
    std::uint32_t changes; ///< no fewer than there are within reach of its voxels
  };

  /// The dirty cubes, ascending; all are clean afterwards.
  std::vector<Dirty> take()
  {
    std::vector<Dirty> cubes;
    for (std::size_t cube = 0; cube < m_Changes.size(); ++cube)
      if (m_Changes[cube] > 0) cubes.push_back({ cube, std::exchange(m_Changes[cube], 0) });
    return cubes;
  }

  static constexpr int voxels = side * side * side; ///< of a cube

  /// Of all cubes.
  std::size_t count() const { return m_Changes.size(); }

  /// Calls visit(voxel, its number in the cube) for every voxel of a cube with another label beside it, `margin` voxels
  /// at the grid's border left out.
  template <typename Visit>
  void visitBoundary(const TissueMap& map, std::size_t cube, int margin, const Visit& visit) const
  {
    const std::array<int, 3> c{ int(cube % m_Count[0]), int(cube / m_Count[0] % m_Count[1]),
                                int(cube / m_Count[0] / m_Count[1]) };
    std::array<int, 3> from, to;
    for (int axis = 0; axis < 3; ++axis)
    {
      from[axis] = std::max(margin, c[axis] * side);
      to[axis] = std::min(m_Grid.size[axis] - margin, (c[axis] + 1) * side);
    }
    for (int k = from[2]; k < to[2]; ++k)
      for (int j = from[1]; j < to[1]; ++j)
      {
        const std::size_t first = m_Grid.index(c[0] * side, j, k);
        const int row = (k % side * side + j % side) * side;
        forEachBoundaryVoxel(map, j, k, from[0], to[0], [&](std::size_t v) { visit(v, row + int(v - first)); });
      }
  }

private:
  const Grid& m_Grid;
  std::array<int, 3> m_Count;
  std::vector<std::uint32_t> m_Changes; ///< by cube; none in clean ones
};

/// What is remembered of the voxels of a cube.
struct CubeMemory
{
  static constexpr std::uint8_t unknown = 255, none = 0, mostRoom = 255;

  CubeMemory() { balls.fill(unknown); }

  /// Numbers of their balls: L takes longer to find than a voxel to rule on.
  std::array<std::uint8_t, DirtyCubes::voxels> balls;
  /// A voxel keeps its label until as many voxels around it have changed; 0: not known.
  std::array<std::uint8_t, DirtyCubes::voxels> room{};

  void change(std::uint32_t voxels)
  {
    const auto all = std::uint8_t(std::min(voxels, std::uint32_t(mostRoom)));
    for (std::uint8_t& left : room) left = left > all ? std::uint8_t(left - all) : std::uint8_t(0);
  }
};

/// That of the cubes that have been looked at.
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
  std::vector<std::uint32_t> m_Place; ///< of each cube in m_Cubes
  std::vector<CubeMemory> m_Cubes;
};

/// The two rules.
class Simplifier
{
public:
  Simplifier(PaddedMap& map, const ScaleField& scale, double featureScale, double largest,
             const std::set<Label>& closed)
    : m_Map(map), m_Closed(closed), m_Steps(neighbourSteps(map.grid)), m_Sizes(map, scale, featureScale),
      m_Largest(largest), m_Balls(map.grid, m_Sizes.smallestSpacing(), largest + m_Sizes.smallestSpacing()),
      m_Dirty(map.grid), m_Memory(m_Dirty.count())
  {
  }

  void run()
  {
    removeSmallRegions();
    applyShareRule();
    removeSmallRegions(); // that the share rule cut off
  }

private:
  void removeSmallRegions()
  {
    const Regions regions = connectedRegions(m_Map);
    removeRegions(m_Map, regions, smallRegions(regions), m_Closed);
  }

  /// A region counts as small by the least s in it.
  std::vector<bool> smallRegions(const Regions& regions) const
  {
    const Vec3& s = m_Map.grid.spacing;
    const double voxelVolume = s.x * s.y * s.z;
    std::vector<bool> isSmall = largestRegions(regions);
    std::vector<double> least(regions.list.size(), 0);
    for (std::size_t r = 0; r < isSmall.size(); ++r)
    {
      const auto [label, voxels] = regions.list[r];
      isSmall[r] = (!isSmall[r] || (label == 0 && r != 0)) && !m_Closed.count(label) &&
                   voxels * voxelVolume < m_Largest * m_Largest * m_Largest;
      least[r] = m_Largest;
    }
    forEachRun(regions, m_Map.grid.size[0],
               [&](std::uint32_t region, std::size_t begin, std::size_t end)
               {
                 for (std::size_t v = begin; isSmall[region] && v < end; ++v)
                   least[region] = std::min(least[region], m_Sizes.at(v));
               });
    for (std::size_t r = 0; r < isSmall.size(); ++r)
    {
      isSmall[r] = isSmall[r] && regions.list[r].voxels * voxelVolume < least[r] * least[r] * least[r];
    }
    return isSmall;
  }

  void applyShareRule()
  {
    // A detail narrower than s is gone after s rounds. More would unravel thin sheets from their edges.
    const int rounds = int(std::ceil(m_Largest / m_Sizes.smallestSpacing()));
    m_Dirty.markBoundary(m_Map, m_Map.margin);
    for (int round = 0; round < rounds; ++round)
      for (const Changes& changes : findChanges(m_Dirty.take())) apply(changes);
  }

  using Changes = std::vector<std::pair<std::size_t, Label>>; ///< of a cube

  void apply(const Changes& changes)
  {
    if (changes.empty()) return;
    std::array<int, 3> first = m_Map.grid.voxelAt(changes[0].first), last = first;
    for (const auto& [voxel, label] : changes)
    {
      m_Map.labels[voxel] = label;
      const std::array<int, 3> at = m_Map.grid.voxelAt(voxel);
      for (int axis = 0; axis < 3; ++axis)
      {
        first[axis] = std::min(first[axis], at[axis]);
        last[axis] = std::max(last[axis], at[axis]);
      }
    }
    m_Dirty.mark(first, last, m_Map.margin - 1, changes.size());
  }

  /// Per cube, what the share rule asks of the map as it is.
  std::vector<Changes> findChanges(const std::vector<DirtyCubes::Dirty>& cubes)
  {
    std::vector<Changes> changes(cubes.size());
    for (const DirtyCubes::Dirty& dirty : cubes) m_Memory.add(dirty.cube);
    parallelFor(cubes.size(),
                [&](std::size_t c)
                {
                  CubeMemory& memory = m_Memory[cubes[c].cube];
                  memory.change(cubes[c].changes);
                  m_Dirty.visitBoundary(m_Map, cubes[c].cube, m_Map.margin,
                                        [&](std::size_t voxel, int n) { look(voxel, n, memory, changes[c]); });
                });
    return changes;
  }

  /// At a voxel, number n of its cube.
  void look(std::size_t voxel, int n, CubeMemory& memory, Changes& changes) const
  {
    std::uint8_t &ball = memory.balls[n], &room = memory.room[n];
    if (room > 0) return;
    if (ball == CubeMemory::unknown) ball = ballOf(voxel);
    if (ball == CubeMemory::none) return;
    const Label label = ruling(voxel, m_Balls[ball], room);
    if (label != m_Map.labels[voxel]) changes.emplace_back(voxel, label);
  }

  std::uint8_t ballOf(std::size_t voxel) const
  {
    const double size = m_Sizes.at(voxel);
    // A ball through voxel centres: half a voxel wider on each side than what lies within it.
    return size == 0 ? CubeMemory::none : std::uint8_t(m_Balls.indexOf(size + m_Sizes.smallestSpacing()));
  }

  /// The label that a voxel should have by the share rule; `room`: see CubeMemory, set where its own fills enough.
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

  /// Labels across the faces of a voxel that may gain it; returns how many.
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
  const std::set<Label>& m_Closed;
  std::array<std::ptrdiff_t, 27> m_Steps;
  FeatureSizes m_Sizes;
  double m_Largest; ///< s anywhere, mm
  Balls m_Balls;
  DirtyCubes m_Dirty;
  Memory m_Memory;
};

/// Tissues of which less than half is left.
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

/// s anywhere, mm.
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
  PaddedMap simplified;
  for (double done = 0;; done += (0.9 - done) / 2)
  {
    report(progress, done, "Simplifying features");
    simplified = map;
    Simplifier(simplified, scale, options.featureScale, largest, closed).run();
    const std::set<Label> tooSmall = halved(voxels, simplified);
    if (tooSmall.empty()) break;
    keptWhole.insert(tooSmall.begin(), tooSmall.end());
    closed.insert(tooSmall.begin(), tooSmall.end());
  }
  report(progress, 1, "Simplifying features");
  map.labels.swap(simplified.labels);
  return keptWhole;
}

bool isBelowScale(const PaddedMap& map, const ScaleField& scale, double featureScale, std::size_t voxel)
{
  return FeatureSizes(map, scale, featureScale).at(voxel) == 0;
}

} // namespace surgicalmesher
