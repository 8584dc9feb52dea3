// SPDX-License-Identifier: Apache-2.0
#include "TetrahedraImprovement.h"

#include "InterfaceSamples.h"
#include "MeshQuality.h"
#include "Remesher.h"
#include "Schedule.h"

namespace surgicalmesher
{

void improveTetrahedra(TetMesh& mesh, const SizingFunction& length, const TetrahedraImprovementOptions& options,
                       const Progress& progress)
{
  BackgroundMesh background;
  background.mesh = mesh;
  for (const Vec3& p : mesh.points) background.lengths.push_back(float(length(p)));
  addInterfaceSamples(background, options.surfaceTolerance);
  const std::vector<ConditionalSweep> sweeps =
    options.isImproved ? sweepsForImprovedMesh(options.targetAngle) : sweepsForRawMesh(options.targetAngle);
  RemesherOptions remeshing;
  remeshing.featureAngle = options.featureAngle;
  Remesher remesher(std::move(background), length, remeshing, progress, sweeps.size());
  for (const auto& [sweep, worthwhileShare] : sweeps)
  {
    const TetMesh& now = remesher.background().mesh;
    const double most = worthwhileShare * double(now.tetrahedra.size());
    if (most < 0 || double(countBelow(now, options.targetAngle)) > most) remesher.run(sweep);
    else remesher.skip();
  }
  mesh = std::move(remesher.background().mesh);
}

} // namespace surgicalmesher
