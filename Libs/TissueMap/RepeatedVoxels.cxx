// SPDX-License-Identifier: Apache-2.0
#include "RepeatedVoxels.h"

#include <algorithm>
#include <numeric>

namespace surgicalmesher
{

namespace
{

/// The distances along one axis between the places where neighbouring voxels differ, of those added so far.
class ChangeSteps
{
public:
  explicit ChangeSteps(int size) : m_IsChange(std::size_t(size), false) {}

  /// Adds a place: voxel number `at` differs from the one before it.
  void add(int at)
  {
    if (m_IsChange[at]) return;
    m_IsChange[at] = true;
    ++m_Count;
    if (m_First < 0) m_First = at;
    m_Divisor = std::gcd(m_Divisor, at - m_First);
  }

  int count() const { return m_Count; }
  int first() const { return m_First; }
  int divisor() const { return m_Divisor; } ///< greatest common divisor of the distances; 0: no distance

private:
  std::vector<bool> m_IsChange;
  int m_Count = 0, m_First = -1, m_Divisor = 0;
};

/// The changes along `axis`; stops early when the divisor is 1.
ChangeSteps changesAlong(const TissueMap& map, int axis)
{
  const auto& size = map.grid.size;
  const std::size_t before = axis == 1 ? std::size_t(size[0]) : std::size_t(size[0]) * size[1];
  ChangeSteps steps(size[axis]);
  for (int k = axis == 2; k < size[2]; ++k)
    for (int j = axis == 1; j < size[1]; ++j)
    {
      const Label* const row = map.labels.data() + map.grid.index(0, j, k);
      for (int i = 1; axis == 0 && i < size[0]; ++i)
        if (row[i] != row[i - 1]) steps.add(i);
      if (axis > 0 && !std::equal(row, row + size[0], row - before)) steps.add(axis == 1 ? j : k);
      if (steps.divisor() == 1) return steps;
    }
  return steps;
}

/// Whether all voxels before `first` or from `last` on, along the axes, are background.
bool isBackgroundBeyond(const TissueMap& map, const std::array<int, 3>& first, const std::array<int, 3>& last)
{
  const auto& size = map.grid.size;
  const auto isWithin = [&](int at, int axis) { return at >= first[axis] && at < last[axis]; };
  for (int k = 0; k < size[2]; ++k)
    for (int j = 0; j < size[1]; ++j)
    {
      const Label* const row = map.labels.data() + map.grid.index(0, j, k);
      const auto isBackground = [](Label label) { return label == 0; };
      const bool isCut = isWithin(j, 1) && isWithin(k, 2);
      if (!std::all_of(row, row + (isCut ? first[0] : size[0]), isBackground)) return false;
      if (isCut && !std::all_of(row + last[0], row + size[0], isBackground)) return false;
    }
  return true;
}

std::array<int, 3> wholeBlocks(const VoxelRepeats& repeats)
{
  std::array<int, 3> count;
  for (int a = 0; a < 3; ++a) count[a] = (repeats.grid.size[a] - repeats.first[a]) / repeats.times;
  return count;
}

} // namespace

VoxelRepeats findRepeats(const TissueMap& map, double shortestLength)
{
  constexpr int leastChanges = 12; // along each axis; by chance, one map in 2^33 would have an even divisor on all axes
  const VoxelRepeats none{ map.grid };
  VoxelRepeats repeats = none;
  int times = 0;
  for (const int axis : { 2, 1, 0 }) // the axes that compare whole rows first
  {
    const ChangeSteps steps = changesAlong(map, axis);
    times = std::gcd(times, steps.divisor());
    if (steps.count() < leastChanges || times == 1) return none;
    repeats.first[axis] = steps.first();
  }
  if (times < 2 || shortestLength < times * shortestLatticeLength(map.grid)) return none;
  repeats.times = times;
  std::array<int, 3> end;
  for (int a = 0; a < 3; ++a)
  {
    repeats.first[a] %= times;
    end[a] = repeats.first[a] + wholeBlocks(repeats)[a] * times;
  }
  return isBackgroundBeyond(map, repeats.first, end) ? repeats : none;
}

TissueMap withoutRepeats(const TissueMap& map, const VoxelRepeats& repeats)
{
  TissueMap result = everyNth(map, repeats.times, repeats.first, wholeBlocks(repeats));
  const auto& first = repeats.first;
  const double half = 0.5 * (repeats.times - 1); // voxels from the first one to the middle of a block
  const Vec3 voxel = map.grid.spacing;
  result.grid.origin =
    map.grid.gridToWorld({ (first[0] + half) * voxel.x, (first[1] + half) * voxel.y, (first[2] + half) * voxel.z });
  return result;
}

TissueMap withRepeats(const TissueMap& map, const VoxelRepeats& repeats)
{
  const Grid& grid = repeats.grid;
  TissueMap result;
  result.table = map.table;
  result.grid = grid;
  result.labels.assign(grid.voxelCount(), 0);
  const auto& size = map.grid.size;
  for (int k = 0; k < size[2] * repeats.times; ++k)
    for (int j = 0; j < size[1] * repeats.times; ++j)
    {
      const Label* from = map.labels.data() + map.grid.index(0, j / repeats.times, k / repeats.times);
      Label* to = result.labels.data() + grid.index(repeats.first[0], repeats.first[1] + j, repeats.first[2] + k);
      for (int i = 0; i < size[0]; ++i, to += repeats.times) std::fill_n(to, repeats.times, from[i]);
    }
  return result;
}

} // namespace surgicalmesher
