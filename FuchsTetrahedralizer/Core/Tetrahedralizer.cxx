// SPDX-License-Identifier: Apache-2.0
#include "Tetrahedralizer.h"

#include "FaceAdjacency.h"
#include "InteriorRefill.h"
#include "MeshChecks.h"
#include "SurfaceTetrahedralization.h"
#include "TetrahedraImprovement.h"

namespace surgicalmesher
{

namespace
{

TetrahedraImprovementOptions improvementOptions(const TetrahedralizerInput& input,
                                                const TetrahedralizerOptions& options)
{
  TetrahedraImprovementOptions result;
  result.isImproved = input.background.has_value();
  if (!result.isImproved) result.featureAngle = options.featureAngle;
  else if (input.background->targetAngle > 0) result.targetAngle = input.background->targetAngle;
  return result;
}

void improveInFrame(TetMesh& mesh, const TargetLengths& lengths, const TetrahedraImprovementOptions& options,
                    const Progress& progress)
{
  const std::optional<Grid>& frame = lengths.frame;
  for (Vec3& p : mesh.points) p = frame ? inFrameOf(*frame, p) : p;
  improveTetrahedra(
    mesh, [&](const Vec3& p) { return double(float(lengths.inFrame(p))); }, options, progress);
  for (Vec3& p : mesh.points) p = frame ? frame->gridToWorld(p) : p;
}

/// `mesh`, divided into child and parent, with the classes of all its tetrahedra.
FiniteElementMesh finiteElementMesh(TetMesh mesh, const SizingFunction& length, TissueTable tissues,
                                    const ConstitutiveRule& rule)
{
  FiniteElementMesh result;
  result.division = divideIntoSubMeshes(mesh, length);
  MeshFile& content = result.content;
  content.mesh = std::move(mesh);
  content.tissues = std::move(tissues);
  content.subMesh = result.division.ofTetrahedron;
  content.constitutive = constitutiveModels(content.mesh, content.subMesh, content.tissues);
  tagByDistance(content.mesh, rule, content.constitutive);
  content.subMeshInterface.assign(content.mesh.points.size(), 0);
  for (const std::int32_t id : result.division.interfacePoints) content.subMeshInterface[id] = 1;
  for (const Vec3& p : content.mesh.points) content.targetEdgeLength.push_back(length(p));
  return result;
}

} // namespace

TargetLengths lengthsOf(const SizingFunction& inWorld) { return { inWorld, inWorld, {} }; }

TargetLengths lengthsOf(const ScaleField& scale) { return { scale, inFrameOf(scale.grid, scale), scale.grid }; }

FiniteElementMesh tetrahedralizeTissues(TetrahedralizerInput input, const TargetLengths& lengths,
                                        const TetrahedralizerOptions& options, const Progress& progress)
{
  const SizingFunction& length = lengths.inWorld;
  const TetrahedraImprovementOptions improvement = improvementOptions(input, options);
  report(progress, 0, "tetrahedra");
  TetMesh mesh = input.background ? withLatticeInside(input.background->mesh, length, input.name, options.placement)
                                  : fillWithTetrahedra(input.surface, length, input.name, options.placement);
  input.background.reset(); // its memory is needed
  improveInFrame(mesh, lengths, improvement, subProgress(progress, 0.25, 0.85));
  report(progress, 0.85, "sub-meshes");
  FiniteElementMesh result =
    finiteElementMesh(withoutOutside(mesh), length, std::move(input.tissues), options.constitutive);
  report(progress, 0.95, "checks");
  requireSound(result.content.mesh, "final check");
  return result;
}

} // namespace surgicalmesher
