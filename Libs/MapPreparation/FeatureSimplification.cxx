// SPDX-License-Identifier: Apache-2.0
#include "FeatureSimplification.h"

#include "Parallel.h"
#include "RegionRemoval.h"
#include "VoxelBall.h"

#include <algorithm>
#include <array>
#include <cmath>
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

  const VoxelBall& ofDiameter(double diameter) const { return m_Balls[indexOf(diameter)]; }

private:
  int indexOf(double diameter) const { return int(std::lround(diameter / m_Unit)); }

  double m_Unit;
  std::vector<VoxelBall> m_Balls;
};

/// Cubes of voxels in which something may have to be looked at again.
class DirtyCubes
{
public:
  explicit DirtyCubes(const Grid& grid) : m_Grid(grid)
  {
    for (int axis = 0; axis < 3; ++axis) m_Count[axis] = (grid.size[axis] + side - 1) / side;
    m_Dirty.assign(std::size_t(m_Count[0]) * m_Count[1] * m_Count[2], true);
  }

  /// Marks the cubes that hold a voxel within `reach` steps along each axis.
  void mark(std::size_t voxel, int reach)
  {
    const std::array<int, 3> p = m_Grid.voxelAt(voxel);
    std::array<int, 3> from, to;
    for (int axis = 0; axis < 3; ++axis)
    {
      from[axis] = std::max(0, p[axis] - reach) / side;
      to[axis] = std::min(m_Grid.size[axis] - 1, p[axis] + reach) / side;
    }
    for (int k = from[2]; k <= to[2]; ++k)
    {
      for (int j = from[1]; j <= to[1]; ++j)
      {
        for (int i = from[0]; i <= to[0]; ++i) m_Dirty[(std::size_t(k) * m_Count[1] + j) * m_Count[0] + i] = true;
      }
    }
  }

  /// The dirty cubes, ascending; all are clean afterwards.
  std::vector<std::size_t> take()
  {
    std::vector<std::size_t> cubes;
    for (std::size_t cube = 0; cube < m_Dirty.size(); ++cube)
    {
      if (m_Dirty[cube]) cubes.push_back(cube);
    }
    m_Dirty.assign(m_Dirty.size(), false);
    return cubes;
  }

  /// Calls visit(voxel) for every voxel of a cube, `margin` voxels at the grid's border left out.
  template <typename Visit>
  void visitVoxels(std::size_t cube, int margin, const Visit& visit) const
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
    {
      for (int j = from[1]; j < to[1]; ++j)
      {
        for (int i = from[0]; i < to[0]; ++i) visit(m_Grid.index(i, j, k));
      }
    }
  }

private:
  static constexpr int side = 4;
  const Grid& m_Grid;
  std::array<int, 3> m_Count;
  std::vector<bool> m_Dirty;
};

/// The two rules.
class Simplifier
{
public:
  Simplifier(PaddedMap& map, const ScaleField& scale, double featureScale, double largest,
             const std::set<Label>& closed)
    : m_Map(map), m_Closed(closed), m_Steps(neighbourSteps(map.grid)), m_Sizes(map, scale, featureScale),
      m_Largest(largest), m_Balls(map.grid, m_Sizes.smallestSpacing(), largest + m_Sizes.smallestSpacing()),
      m_Dirty(map.grid)
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
    for (int round = 0; round < rounds; ++round)
    {
      for (const auto& changes : findChanges(m_Dirty.take()))
      {
        for (const auto& [voxel, label] : changes)
        {
          m_Map.labels[voxel] = label;
          m_Dirty.mark(voxel, m_Map.margin - 1);
        }
      }
    }
  }

  using Changes = std::vector<std::pair<std::size_t, Label>>;

  /// Per cube, what the share rule asks of the map as it is.
  std::vector<Changes> findChanges(const std::vector<std::size_t>& cubes) const
  {
    std::vector<Changes> changes(cubes.size());
    parallelFor(cubes.size(),
                [&](vtkIdType c)
                {
                  m_Dirty.visitVoxels(cubes[c], m_Map.margin,
                                      [&](std::size_t voxel)
                                      {
                                        const Label label = ruling(voxel);
                                        if (label != m_Map.labels[voxel]) changes[c].emplace_back(voxel, label);
                                      });
                });
    return changes;
  }

  /// The label that a voxel should have by the share rule.
  Label ruling(std::size_t voxel) const
  {
    const Label own = m_Map.labels[voxel];
    std::array<Label, 6> others;
    const int count = othersBeside(voxel, own, others);
    if (count == 0 || m_Closed.count(own)) return own;
    const double size = m_Sizes.at(voxel);
    if (size == 0) return own;

    // A ball through voxel centres: half a voxel wider on each side than what lies within it.
    const VoxelBall& ball = m_Balls.ofDiameter(size + m_Sizes.smallestSpacing());
    const Label* const centre = m_Map.labels.data() + voxel;
    const std::size_t ownShare = ball.count(centre, own);
    if (ownShare >= std::size_t(std::ceil(requiredShare * ball.size()))) return own;
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

std::vector<bool> voxelsBelowScale(const PaddedMap& map, const ScaleField& scale, double featureScale)
{
  const FeatureSizes sizes(map, scale, featureScale);
  std::vector<bool> below(map.labels.size());
  constexpr std::size_t together = 1 << 16; // threads must not share a word of the bits
  parallelForEach((below.size() + together - 1) / together,
                  [&](std::size_t n)
                  {
                    const std::size_t end = std::min(below.size(), (n + 1) * together);
                    for (std::size_t v = n * together; v < end; ++v) below[v] = map.isInMargin(v) || sizes.at(v) == 0;
                  });
  return below;
}

} // namespace surgicalmesher
