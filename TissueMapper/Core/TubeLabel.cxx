// SPDX-License-Identifier: Apache-2.0
#include "TubeLabel.h"

#include "Sampling.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <queue>
#include <set>

namespace surgicalmesher
{

namespace
{

using Voxel = std::array<int, 3>;

constexpr std::array<std::array<int, 3>, 6> faceSteps{
  { { 1, 0, 0 }, { -1, 0, 0 }, { 0, 1, 0 }, { 0, -1, 0 }, { 0, 0, 1 }, { 0, 0, -1 } }
};

Voxel stepped(const Voxel& voxel, const std::array<int, 3>& step)
{
  return { voxel[0] + step[0], voxel[1] + step[1], voxel[2] + step[2] };
}

/// Which of the 27 voxels around a voxel belong to the tube, by index (dk + 1) * 9 + (dj + 1) * 3 + di + 1; 13 is the
/// middle.
using Neighbourhood = std::array<bool, 27>;

Neighbourhood neighbourhoodOf(const std::set<Voxel>& tube, const Voxel& voxel)
{
  Neighbourhood around{};
  for (int n = 0; n < 27; ++n) around[n] = tube.count(stepped(voxel, { n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1 })) > 0;
  return around;
}

int distanceSum(int a, int b)
{
  return std::abs(a % 3 - b % 3) + std::abs(a / 3 % 3 - b / 3 % 3) + std::abs(a / 9 - b / 9);
}

bool areCorners(int a, int b)
{
  return std::abs(a % 3 - b % 3) <= 1 && std::abs(a / 3 % 3 - b / 3 % 3) <= 1 && std::abs(a / 9 - b / 9) <= 1;
}

/// Counts the connected components of the members, under an adjacency, that contain a voxel adjacent to the middle.
template <typename Adjacent, typename Member>
int piecesAtMiddle(Member isMember, Adjacent areAdjacent)
{
  std::array<bool, 27> seen{};
  int pieces = 0;
  for (int start = 0; start < 27; ++start)
  {
    if (!isMember(start) || seen[start] || !areAdjacent(start, 13)) continue;
    ++pieces;
    std::vector<int> stack{ start };
    seen[start] = true;
    while (!stack.empty())
    {
      const int a = stack.back();
      stack.pop_back();
      for (int b = 0; b < 27; ++b)
      {
        if (!isMember(b) || seen[b] || !areAdjacent(a, b)) continue;
        seen[b] = true;
        stack.push_back(b);
      }
    }
  }
  return pieces;
}

/// Whether the middle is a simple point: adding it changes neither the topology of the tube under face adjacency nor
/// that of the rest under corner adjacency. Equivalent to one component of the tube among the 18 neighbours across
/// faces and edges, and one component of the rest.
bool isSimple(const Neighbourhood& around)
{
  const auto inTube = [&](int n) { return n != 13 && around[n] && distanceSum(n, 13) <= 2; };
  const auto inRest = [&](int n) { return n != 13 && !around[n]; };
  return piecesAtMiddle(inTube, [](int a, int b) { return distanceSum(a, b) == 1; }) == 1 &&
         piecesAtMiddle(inRest, [](int a, int b) { return a != b && areCorners(a, b); }) == 1;
}

/// Whether two voxels of the tube, or of the rest, meet only along an edge or at a corner in a block of 2 x 2 x 2
/// voxels with index i + 2 j + 4 k.
bool isPinched(const std::array<bool, 8>& block)
{
  for (int n = 0; n < 8; ++n)
  {
    for (const int edge : { 3, 5, 6 }) // each value: the two axes along which voxels that share an edge differ
    {
      const int first = edge & -edge;
      const bool a = block[n];
      if (block[n ^ edge] == a && block[n ^ first] != a && block[n ^ edge ^ first] != a) return true;
    }
    if (block[n ^ 7] == block[n] && std::count(block.begin(), block.end(), block[n]) == 2) return true;
  }
  return false;
}

/// Whether adding the middle pinches one of the eight blocks that contain it.
bool touchesItself(Neighbourhood around)
{
  around[13] = true;
  for (int corner = 0; corner < 8; ++corner)
  {
    const int start = (corner & 1) + (corner >> 1 & 1) * 3 + (corner >> 2) * 9;
    std::array<bool, 8> block;
    for (int n = 0; n < 8; ++n) block[n] = around[start + (n & 1) + 3 * (n >> 1 & 1) + 9 * (n >> 2)];
    if (isPinched(block)) return true;
  }
  return false;
}

/// Voxels of all pinched blocks.
std::set<Voxel> pinchedBlocks(const std::set<Voxel>& tube)
{
  std::set<Voxel> pinched;
  for (const Voxel& voxel : tube)
  {
    for (int corner = 0; corner < 8; ++corner)
    {
      const Voxel start = stepped(voxel, { (corner & 1) - 1, (corner >> 1 & 1) - 1, (corner >> 2) - 1 });
      std::array<Voxel, 8> voxels;
      std::array<bool, 8> block;
      for (int n = 0; n < 8; ++n)
      {
        voxels[n] = stepped(start, { n & 1, n >> 1 & 1, n >> 2 });
        block[n] = tube.count(voxels[n]) > 0;
      }
      if (isPinched(block)) pinched.insert(voxels.begin(), voxels.end());
    }
  }
  return pinched;
}

/// Returns the voxels in the order in which the path runs through them, each sharing a face with the next.
std::vector<Voxel> voxelsAlong(const Grid& grid, const std::vector<Vec3>& points)
{
  std::vector<Voxel> chain;
  for (const Vec3& point : points)
  {
    const Vec3 index = toIndex(grid, point);
    const Voxel next = nearestVoxel(grid, point);
    if (chain.empty())
    {
      chain.push_back(next);
      continue;
    }
    while (chain.back() != next) // step first along the axis that is farthest behind
    {
      Voxel here = chain.back();
      int axis = 0;
      double most = -1;
      for (int a = 0; a < 3; ++a)
      {
        const double behind = here[a] == next[a] ? -1 : std::abs(index[a] - here[a]);
        if (behind <= most) continue;
        most = behind;
        axis = a;
      }
      here[axis] += here[axis] < next[axis] ? 1 : -1;
      chain.push_back(here);
    }
  }
  return chain;
}

/// Returns a shortest face-connected chain of voxels within `all`, from `first` to `last`.
std::vector<Voxel> shortestChain(const std::set<Voxel>& all, const Voxel& first, const Voxel& last)
{
  std::map<Voxel, Voxel> towards;
  std::queue<Voxel> front;
  front.push(last);
  towards[last] = last;
  while (!front.empty() && !towards.count(first))
  {
    const Voxel voxel = front.front();
    front.pop();
    for (const auto& step : faceSteps)
    {
      const Voxel next = stepped(voxel, step);
      if (!all.count(next) || towards.count(next)) continue;
      towards[next] = voxel;
      front.push(next);
    }
  }
  std::vector<Voxel> chain{ first };
  while (chain.back() != last) chain.push_back(towards.at(chain.back()));
  return chain;
}

/// Returns a chain from end to end that touches itself nowhere: where it would, it takes the short cut and omits the
/// turn.
std::set<Voxel> simpleChain(const Grid& grid, const std::vector<Vec3>& points)
{
  const std::vector<Voxel> along = voxelsAlong(grid, points);
  std::set<Voxel> all(along.begin(), along.end());
  while (true)
  {
    const std::vector<Voxel> chain = shortestChain(all, along.front(), along.back());
    std::set<Voxel> tube(chain.begin(), chain.end());
    const std::size_t before = all.size();
    for (const Voxel& voxel : pinchedBlocks(tube))
    {
      if (grid.contains(voxel[0], voxel[1], voxel[2])) all.insert(voxel);
    }
    if (all.size() == before) return tube;
  }
}

/// Returns the voxels in the tube, each with its distance from the axis divided by the radius, nearest first.
std::vector<std::pair<double, Voxel>> voxelsWithin(const Grid& grid, const std::vector<Vec3>& points,
                                                   const std::vector<double>& radii)
{
  std::map<Voxel, double> shareOf;
  for (std::size_t n = 0; n < points.size(); ++n)
  {
    std::array<int, 3> low, high;
    for (int axis = 0; axis < 3; ++axis)
    {
      low[axis] = int(std::ceil((points[n][axis] - radii[n]) / grid.spacing[axis]));
      high[axis] = int(std::floor((points[n][axis] + radii[n]) / grid.spacing[axis]));
    }
    for (int k = low[2]; k <= high[2]; ++k)
      for (int j = low[1]; j <= high[1]; ++j)
        for (int i = low[0]; i <= high[0]; ++i)
        {
          const Voxel voxel{ i, j, k };
          const double share = norm(voxelCentre(grid, voxel) - points[n]) / radii[n];
          if (share > 1) continue;
          const auto entry = shareOf.emplace(voxel, share).first;
          entry->second = std::min(entry->second, share);
        }
  }
  std::vector<std::pair<double, Voxel>> voxels;
  for (const auto& entry : shareOf) voxels.push_back({ entry.second, entry.first });
  std::sort(voxels.begin(), voxels.end());
  return voxels;
}

/// Samples the part of the tube on the grid (grid frame), with points close enough together for the shortest voxel
/// edge.
void sampleOnGrid(const Grid& grid, const TubePath& tube, std::vector<Vec3>& points, std::vector<double>& radii)
{
  const double fine = 0.2 * std::min({ grid.spacing.x, grid.spacing.y, grid.spacing.z });
  for (std::size_t n = 0; n < tube.points.size(); ++n)
  {
    const std::size_t before = n == 0 ? 0 : n - 1;
    const Vec3 edge = tube.points[n] - tube.points[before];
    const int parts = n == 0 ? 1 : std::max(1, int(std::ceil(norm(edge) / fine)));
    for (int m = 1; m <= parts; ++m)
    {
      const double t = double(m) / parts;
      const Vec3 p = grid.worldToGrid(tube.points[before] + t * edge);
      if (!isInVolume(grid, p)) continue;
      points.push_back(p);
      radii.push_back((1 - t) * tube.radii[before] + t * tube.radii[n]);
    }
  }
}

} // namespace

std::vector<std::size_t> tubeVoxels(const Grid& grid, const TubePath& tube)
{
  std::vector<Vec3> points;
  std::vector<double> radii;
  sampleOnGrid(grid, tube, points, radii);
  if (points.empty()) return {};
  std::set<Voxel> voxels = simpleChain(grid, points);
  std::vector<std::pair<double, Voxel>> waiting = voxelsWithin(grid, points, radii);
  waiting.erase(std::remove_if(waiting.begin(), waiting.end(),
                               [&](const auto& entry)
                               {
                                 const Voxel& v = entry.second;
                                 return voxels.count(v) > 0 || !grid.contains(v[0], v[1], v[2]);
                               }),
                waiting.end());
  for (bool isGrowing = true; isGrowing;)
  {
    isGrowing = false;
    std::vector<std::pair<double, Voxel>> left;
    for (const auto& entry : waiting)
    {
      const Neighbourhood around = neighbourhoodOf(voxels, entry.second);
      if (!isSimple(around) || touchesItself(around))
      {
        left.push_back(entry);
        continue;
      }
      voxels.insert(entry.second);
      isGrowing = true;
    }
    waiting.swap(left);
  }
  std::vector<std::size_t> indices;
  for (const Voxel& voxel : voxels) indices.push_back(grid.index(voxel[0], voxel[1], voxel[2]));
  std::sort(indices.begin(), indices.end());
  return indices;
}

} // namespace surgicalmesher
