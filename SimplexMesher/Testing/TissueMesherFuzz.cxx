// SPDX-License-Identifier: Apache-2.0
// Meshes small random maps at random scales and checks every result. usage: TissueMesherFuzz [MAPS [FIRST_SEED]]
// Map n depends on its seed, FIRST_SEED + n, alone. Exit status 1 if one is meshed wrongly.

#include "MapPreparation.h"
#include "MeshedMapChecks.h"
#include "RandomMaps.h"
#include "ScaleMaps.h"

#include <cstdlib>
#include <iostream>
#include <random>

using namespace surgicalmesher;

namespace
{

/// Up to 12 voxels along each axis, 2 to 6 labels: noise, boxes, or balls, each with some noise or none.
TissueMap randomMap(std::mt19937& random)
{
  const auto size = [&] { return 1 + int(random() % 12); };
  const int labels = 2 + int(random() % 5), kind = int(random() % 3);
  TissueMap map = test::paintedMap({ size(), size(), size() }, [](int, int, int) { return 0; });
  const Grid& grid = map.grid;
  if (kind == 0)
  {
    const auto filling = random() % 4, lowest = random() % 2;
    for (Label& label : map.labels) label = Label(random() % 4 < filling ? 1 : lowest + random() % labels);
  }
  else if (kind == 1) map = test::randomWellComposedMap(random, grid.size, labels, 100);
  else
  {
    for (int ball = 0; ball < 6; ++ball)
    {
      const auto inside = [&](int axis) { return double(random() % grid.size[axis]); };
      const Vec3 centre{ inside(0), inside(1), inside(2) };
      const double radius = 1 + random() % 5;
      const auto label = Label(random() % (labels + 1));
      for (int k = 0; k < grid.size[2]; ++k)
      {
        for (int j = 0; j < grid.size[1]; ++j)
        {
          for (int i = 0; i < grid.size[0]; ++i)
          {
            if (norm(Vec3{ double(i), double(j), double(k) } - centre) <= radius)
              map.labels[grid.index(i, j, k)] = label;
          }
        }
      }
    }
  }
  const auto rarity = 1 + random() % 60;
  for (Label& label : map.labels)
  {
    if (rarity < 40 && random() % (3 * rarity) == 0) label = Label(random() % (labels + 1));
  }
  if (random() % 3 == 0) map.grid.spacing = { 0.98, 0.98, 2.5 };
  return map;
}

/// What is wrong with the mesh of the map of this seed, or nothing.
std::string run(unsigned seed)
{
  std::mt19937 random(seed);
  TissueMap map = randomMap(random);
  if (presentLabels(map).empty()) return "";
  prepareMap(map, {});
  const double length = 0.8 + random() % 100 * 0.08;
  const bool graded = random() % 2;
  const Vec3 target = map.grid.gridToWorld({ double(random() % 12), double(random() % 12), double(random() % 12) });
  const ScaleField scale =
    graded ? test::radialScale(map.grid, target, 0.8, std::max(length, 0.8), 2, 5) : uniformScale(length);
  TissueMesherOptions options;
  if (random() % 4 == 0) options.maximumDistance = 0.3 + random() % 10 * 0.1;
  try
  {
    const MeshedMap mesh = meshTissues(map, scale, options);
    const std::string fault = test::faultOf(mesh, map);
    const double allowed = std::max(options.maximumDistance, mesh.evolution.front().maximumDistance) * (1 + 1e-5);
    const double farthest = mesh.evolution.back().maximumDistance;
    return fault.empty() && options.maximumDistance > 0 && farthest > allowed
             ? "a sample is " + std::to_string(farthest) + " mm away, asked for " + std::to_string(allowed)
             : fault;
  }
  catch (const std::exception& error)
  {
    return error.what();
  }
}

} // namespace

int main(int argc, char** argv)
{
  const int maps = argc > 1 ? std::atoi(argv[1]) : 60;
  const unsigned first = argc > 2 ? unsigned(std::atoi(argv[2])) : 1;
  int faults = 0;
  for (unsigned seed = first; seed < first + unsigned(maps); ++seed)
  {
    const std::string fault = run(seed);
    if (fault.empty()) continue;
    ++faults;
    std::cerr << "seed " << seed << ": " << fault << std::endl;
  }
  std::cout << maps << " maps, " << faults << " meshed wrongly" << std::endl;
  return faults == 0 ? 0 : 1;
}
