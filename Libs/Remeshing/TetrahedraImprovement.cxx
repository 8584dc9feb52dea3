// SPDX-License-Identifier: Apache-2.0
#include "TetrahedraImprovement.h"

#include "InterfaceSamples.h"
#include "MeshQuality.h"
#include "Remesher.h"
#include "Schedule.h"
#include "VolumeBalance.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace surgicalmesher
{

namespace
{

constexpr double balancingGain = 0.7; // polishing also brings vertices nearer to their samples, which adds volume

/// Returns the smallest target length at the points of tissues, mm.
double smallestLength(const BackgroundMesh& background)
{
  double smallest = std::numeric_limits<double>::max();
  for (std::size_t t = 0; t < background.mesh.tetrahedra.size(); ++t)
    if (background.mesh.labels[t] != 0)
      for (const std::int32_t id : background.mesh.tetrahedra[t])
        smallest = std::min(smallest, double(background.lengths[id]));
  return smallest;
}

/// A tissue smaller than the lengths asked for moves by a share of its own size, the cube root of its volume: by a
/// share of theirs it could double its volume.
void boundTolerances(BackgroundMesh& background, const std::map<Label, double>& volumes, double surfaceTolerance)
{
  const std::vector<Label>& labels = background.mesh.labels;
  for (BackgroundMesh::Sample& sample : background.samples)
  {
    const std::int32_t beyond = background.neighbours[sample.tetrahedron][sample.face];
    for (const Label label : { labels[sample.tetrahedron], labels[beyond] })
      if (label != 0)
        sample.tolerance = std::min(sample.tolerance, float(surfaceTolerance * std::cbrt(volumes.at(label))));
  }
}

} // namespace

void improveTetrahedra(TetMesh& mesh, const SizingFunction& length, const TetrahedraImprovementOptions& options,
                       const Progress& progress)
{
  BackgroundMesh background;
  background.mesh = mesh;
  for (const Vec3& p : mesh.points) background.lengths.push_back(float(length(p)));
  addInterfaceSamples(background, options.surfaceTolerance);
  const double smallest = smallestLength(background);
  const std::map<Label, double> volumes = tissueVolumes(mesh);
  if (!options.isImproved) boundTolerances(background, volumes, options.surfaceTolerance);
  std::vector<TetrahedralSweep> sweeps = options.isImproved ? sweepsForImprovedMesh(options.targetAngle, smallest)
                                                            : sweepsForRawMesh(options.targetAngle, smallest);
  if (options.isImproved)
    sweeps.back().sweep.stages.push_back(restoringStage(options.targetAngle, { volumes, 0.1 * smallest }));
  RemesherOptions remeshing;
  remeshing.featureAngle = options.featureAngle;
  Remesher remesher(std::move(background), length, remeshing, progress, sweeps.size());
  VolumeBalance balance(volumes, options.surfaceTolerance * smallest);
  for (const auto& [sweep, balanced] : sweeps)
  {
    if (balanced) balance.apply(remesher.background(), balancingGain);
    remesher.run(sweep);
  }
  mesh = std::move(remesher.background().mesh);
}

} // namespace surgicalmesher
