// SPDX-License-Identifier: Apache-2.0
// Takes small random maps the whole way of both stages, and checks what comes out. usage: SmallMapsFuzz [MAPS
// [FIRST_SEED]]
// Random are labels, frame, size, spacing, scale, and the options that change the map, the scale or the mesh. Map n
// depends on its seed, FIRST_SEED + n, alone. Exit status 1 if one is meshed wrongly; a crash, or two minutes on one
// map, end the program. Build with SurgicalMesher_SANITIZE for what only the sanitizers see. Larger maps:
// TissueMesherFuzz.

#include "CanonicalGrid.h"
#include "FaceAdjacency.h"
#include "LocalThickness.h"
#include "MeshQuality.h"
#include "MeshedMapChecks.h"
#include "RandomMaps.h"
#include "ScaleMaps.h"
#include "ScaledPreparation.h"
#include "SimplexMesh.h"
#include "SubMeshes.h"
#include "TetrahedraImprovement.h"
#include "TissueFidelity.h"
#include "TissueScale.h"
#include "TissueSurfaces.h"

#include <vtkSMPTools.h>

#include <cstdlib>
#include <iostream>
#include <random>

#ifndef _WIN32
#include <unistd.h>
#endif

using namespace surgicalmesher;

namespace
{

class Draw
{
public:
  explicit Draw(unsigned seed) : m_Random(seed) {}

  int below(int count) { return int(m_Random() % unsigned(count)); }
  bool oneIn(int count) { return below(count) == 0; }
  /// In steps of a hundredth of the range.
  double between(double low, double high) { return low + (high - low) * below(101) / 100; }
  std::mt19937& random() { return m_Random; }

private:
  std::mt19937 m_Random;
};

/// Any rotation, and none as often as not.
std::array<Vec3, 3> randomAxes(Draw& draw)
{
  std::array<Vec3, 3> axes{ Vec3{ 1, 0, 0 }, Vec3{ 0, 1, 0 }, Vec3{ 0, 0, 1 } };
  if (draw.oneIn(2)) return axes;
  for (Vec3& axis : axes)
    for (int a = 0; a < 3; ++a) axis[a] += draw.between(-0.9, 0.9);
  axes[0] = axes[0] / norm(axes[0]);
  axes[1] = axes[1] - dot(axes[0], axes[1]) * axes[0];
  if (norm(axes[1]) < 0.1) return { Vec3{ 0, 0, 1 }, Vec3{ 1, 0, 0 }, Vec3{ 0, 1, 0 } };
  axes[1] = axes[1] / norm(axes[1]);
  axes[2] = cross(axes[0], axes[1]);
  return axes;
}

Grid randomGrid(Draw& draw)
{
  Grid grid;
  const int most = draw.oneIn(50) ? 7 : draw.oneIn(10) ? 4 : 3; // small maps find as much in a tenth of the time
  for (int a = 0; a < 3; ++a) grid.size[a] = 1 + draw.below(most);
  const double voxel = draw.oneIn(4) ? draw.between(0.01, 20) : 1;
  grid.spacing = { voxel, voxel, voxel };
  if (draw.oneIn(3))
    for (int a = 0; a < 3; ++a) grid.spacing[a] *= draw.between(0.5, 2.5);
  grid.axes = randomAxes(draw);
  if (draw.oneIn(2)) grid.origin = { draw.between(-500, 500), draw.between(-500, 500), draw.between(-500, 500) };
  return grid;
}

TissueMap randomMap(Draw& draw)
{
  const Grid grid = randomGrid(draw);
  const int tissues = 1 + draw.below(5);
  TissueMap map;
  if (draw.oneIn(3)) map = test::randomWellComposedMap(draw.random(), grid.size, tissues, 12);
  else
  {
    const int noise = 1 + draw.below(4); // one voxel of so many has a label of its own
    int label = 1;
    map = test::paintedMap(grid.size,
                           [&](int, int, int) { return draw.oneIn(noise) ? label = draw.below(tissues + 1) : label; });
  }
  map.grid = grid;
  std::vector<Label> names{ 0 };
  for (int n = 0; n < tissues; ++n) names.push_back(Label(draw.oneIn(3) ? 1 + draw.below(65535) : n + 1));
  for (Label& label : map.labels) label = names[label];
  return map;
}

TissueSettings randomSettings(Draw& draw, const TissueMap& map)
{
  TissueSettings settings;
  const double voxel = map.grid.smallestSpacing();
  bool isAnyLeft = false;
  for (const Label label : presentLabels(map))
  {
    if (draw.oneIn(2)) continue;
    TissueSetting& setting = settings[label];
    const int role = draw.below(8);
    setting.role = role == 0 && !isAnyLeft ? TissueRole::Leave
                   : role == 1             ? TissueRole::Shell
                   : role < 4              ? TissueRole::Group
                                           : TissueRole::Mesh;
    isAnyLeft = isAnyLeft || role == 0;
    if (setting.role == TissueRole::Group) setting.group = "all";
    if (draw.oneIn(3)) setting.minimumEdgeLength = draw.between(0.8, 2) * voxel;
    if (draw.oneIn(3)) setting.maximumEdgeLength = draw.between(2, 4) * voxel;
    if (setting.role == TissueRole::Shell)
      setting.minimumEdgeLength = setting.maximumEdgeLength =
        std::max(setting.minimumEdgeLength, setting.maximumEdgeLength);
    setting.isProtected = draw.oneIn(5);
    if (draw.oneIn(5)) setting.islandVolume = draw.between(0, 6) * voxel * voxel * voxel;
    if (draw.oneIn(5)) setting.cavityVolume = draw.between(0, 6) * voxel * voxel * voxel;
  }
  return settings;
}

ScaleField randomScale(Draw& draw, const Grid& grid)
{
  const double shortest = (draw.oneIn(10) ? draw.between(0.7, 1.5) : draw.between(1.5, 3)) * grid.smallestSpacing();
  if (draw.oneIn(2)) return uniformScale(shortest);
  Vec3 target;
  for (int a = 0; a < 3; ++a) target[a] = draw.between(-3, 8) * grid.spacing[a];
  return test::radialScale(grid, grid.gridToWorld(target), shortest, draw.between(1, 6) * shortest,
                           draw.between(0, 3) * shortest, draw.between(1, 6) * shortest);
}

struct Options
{
  PreparationOptions preparation;
  TissueMesherOptions mesher;
  bool followsThickness = false;
  double gradation = 0.3;
};

Options randomOptions(Draw& draw, const Grid& grid, const TissueSettings& settings)
{
  const double voxel = grid.smallestSpacing();
  Options options;
  if (draw.oneIn(3)) options.preparation.minimumIslandVolume = draw.between(0, 8) * voxel * voxel * voxel;
  if (draw.oneIn(3)) options.preparation.minimumCavityVolume = draw.between(0, 8) * voxel * voxel * voxel;
  if (draw.oneIn(3)) options.mesher.features.featureScale = draw.between(0, 2);
  if (draw.oneIn(4)) options.mesher.maximumDistance = draw.between(0.1, 1.5) * voxel;
  if (draw.oneIn(6)) options.mesher.smoothing = draw.between(0.2, 2);
  if (draw.oneIn(6)) options.mesher.rigidity = draw.between(0.1, 2);
  if (draw.oneIn(4)) options.mesher.smoothing = options.mesher.rigidity = 0;
  options.followsThickness = draw.oneIn(4);
  if (draw.oneIn(4)) options.gradation = draw.between(0, 2);
  for (const auto& [label, setting] : settings)
  {
    if (setting.isProtected) options.mesher.features.protectedLabels.insert(label);
    if (setting.islandVolume >= 0) options.preparation.islandVolumes[label] = setting.islandVolume;
    if (setting.cavityVolume >= 0) options.preparation.cavityVolumes[label] = setting.cavityVolume;
  }
  return options;
}

/// What the surface stage says and writes of a mesh beside the tetrahedra.
std::string faultOfSurface(const MeshedMap& mesh, const TissueMap& map)
{
  SurfaceFile file;
  file.surface = interfaceOf(mesh.background.mesh);
  requireSound(file.surface, "surface");
  for (const auto& [label, part] : tissueSurfaces(file))
    if (part.surface.triangles.empty()) return "tissue " + std::to_string(label) + " has no surface";
  simplexFaces(simplexMeshOf(file.surface));
  for (const auto& [label, fidelity] : assessFidelity(file.surface, map, std::numeric_limits<double>::infinity()))
    if (!std::isfinite(fidelity.meshVolume)) return "tissue " + std::to_string(label) + " has no volume";
  return "";
}

/// What the volume stage makes of a mesh.
std::string faultOfVolume(TetMesh mesh, double targetAngle, const ScaleField& scale)
{
  const auto topology = meshTopology(mesh);
  improveTetrahedra(mesh, scale, { 0.017, targetAngle, true });
  const TetMesh inside = withoutOutside(mesh);
  requireSound(inside, "volume");
  if (!(meshTopology(inside) == topology)) return "a tissue's topology changed in the volume stage";
  const SubMeshes parts = divideIntoSubMeshes(inside, scale);
  const MeshQuality quality = assessQuality(inside, parts.ofTetrahedron, scale);
  return quality.whole.dihedral.minimum > 0 ? "" : "a dihedral angle is not positive";
}

/// What is wrong with the meshes of the map of this seed, or nothing.
std::string run(unsigned seed)
{
  Draw draw(seed);
  TissueMap map = randomMap(draw);
  if (presentLabels(map).empty()) return "";
  TissueSettings settings = randomSettings(draw, map);
  selectTissues(map, settings);
  if (presentLabels(map).empty()) return ""; // what readTissueSettings() refuses
  const ScaleField asked = randomScale(draw, map.grid);
  completeShells(settings, map, asked);
  const Options options = randomOptions(draw, map.grid, settings);
  prepareAtScale(map, followTissues(asked, map, settings, options.gradation), options.preparation,
                 options.mesher.features);
  if (!test::wellComposed(map)) return "the prepared map is not well-composed";
  ScaleField scale = followTissues(asked, map, settings, options.gradation);
  if (options.followsThickness)
    scale = followThickness(scale, map, measureThickness(map, scale).thinVoxels, options.gradation);
  const Grid world = map.grid;
  map.grid = inOwnFrame(world);
  const ScaleField inFrame = inFrameOf(world, scale);
  const MeshedMap mesh = meshTissues(map, inFrame, options.mesher);
  std::string fault = test::faultOf(mesh, map);
  if (fault.empty()) fault = faultOfSurface(mesh, map);
  if (fault.empty()) fault = faultOfVolume(mesh.background.mesh, mesh.targetAngle, inFrame);
  return fault;
}

} // namespace

int main(int argc, char** argv)
{
  const int maps = argc > 1 ? std::atoi(argv[1]) : 100;
  const unsigned first = argc > 2 ? unsigned(std::atoi(argv[2])) : 1;
  vtkSMPTools::Initialize(1); // small maps leave nothing to share out
  int faults = 0;
  for (unsigned seed = first; seed < first + unsigned(maps); ++seed)
  {
#ifndef _WIN32
    alarm(120);
#endif
    std::string fault;
    try
    {
      fault = run(seed);
    }
    catch (const std::exception& error)
    {
      fault = error.what();
    }
    if (seed % 1000 == 0) std::cout << "seed " << seed << std::endl;
    if (fault.empty()) continue;
    ++faults;
    std::cerr << "seed " << seed << ": " << fault << std::endl;
  }
  std::cout << maps << " maps, " << faults << " meshed wrongly" << std::endl;
  return faults == 0 ? 0 : 1;
}
