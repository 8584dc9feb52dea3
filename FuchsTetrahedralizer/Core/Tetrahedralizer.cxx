// SPDX-License-Identifier: Apache-2.0
#include "Tetrahedralizer.h"

#include "CurveInsertion.h"
#include "FaceAdjacency.h"
#include "InteriorRefill.h"
#include "MeshChecks.h"
#include "SurfaceTetrahedralization.h"
#include "TetrahedraImprovement.h"

#include <algorithm>

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

std::vector<CurveChain> insertedCurves(TetMesh& mesh, const SizingFunction& length, const CurveNetwork& curves,
                                       const TetrahedraImprovementOptions& improvement)
{
  if (curves.arcs.empty()) return {};
  CurveInsertionOptions options;
  options.targetAngle = improvement.targetAngle;
  options.surfaceTolerance = improvement.surfaceTolerance;
  options.featureAngle = improvement.featureAngle;
  return insertCurves(mesh, curves, length, options);
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
  improveInFrame(mesh, lengths, improvement, subProgress(progress, 0.25, 0.8));
  report(progress, 0.8, "curves");
  std::vector<CurveChain> curves = insertedCurves(mesh, length, options.curves, improvement);
  report(progress, 0.85, "sub-meshes");
  std::vector<std::int32_t> ids;
  FiniteElementMesh result =
    finiteElementMesh(withoutOutside(mesh, &ids), length, std::move(input.tissues), options.constitutive);
  for (CurveChain& curve : curves)
    for (std::int32_t& id : curve.points) id = std::int32_t(std::lower_bound(ids.begin(), ids.end(), id) - ids.begin());
  result.content.curves = std::move(curves);
  report(progress, 0.95, "checks");
  requireSound(result.content.mesh, "final check");
  return result;
}

} // namespace surgicalmesher
