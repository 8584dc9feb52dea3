// SPDX-License-Identifier: Apache-2.0
#include "Tetrahedralizer.h"

#include "CurveInsertion.h"
#include "FaceAdjacency.h"
#include "InteriorRefill.h"
#include "MeshChecks.h"
#include "MeshQuality.h"
#include "SurfaceTetrahedralization.h"
#include "TetQuality.h"
#include "TetrahedraImprovement.h"

#include <algorithm>
#include <set>

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

/// Returns the worst quality (squared sine) of the tissues' tetrahedra.
double worstOf(const TetMesh& mesh)
{
  double worst = 1;
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t)
    if (mesh.labels[t] != 0) worst = std::min(worst, worstSine2(mesh, t));
  return worst;
}

/// Returns the labels of tissue tetrahedra worse than `least`, and of all tetrahedra around their vertices.
std::set<Label> labelsAroundBad(const TetMesh& mesh, double least)
{
  std::vector<char> touchesBad(mesh.points.size(), 0);
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t)
    if (mesh.labels[t] != 0 && worstSine2(mesh, t) < least)
      for (const std::int32_t id : mesh.tetrahedra[t]) touchesBad[id] = 1;
  std::set<Label> labels;
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t)
    for (const std::int32_t id : mesh.tetrahedra[t])
      if (touchesBad[id]) labels.insert(mesh.labels[t]);
  return labels;
}

/// Returns the background tetrahedra with the lattice inside `tissues`, improved.
TetMesh withImprovedLattice(const TetrahedralizerInput& input, const std::set<Label>& tissues,
                            const TargetLengths& lengths, const TetrahedralizerOptions& options,
                            const Progress& progress)
{
  TetMesh mesh = withLatticeInside(input.background->mesh, tissues, lengths.inWorld, input.name, options.placement);
  improveInFrame(mesh, lengths, improvementOptions(input, options), progress);
  return mesh;
}

/// The lattice can leave bad angles that cannot be repaired; affected tissues then keep their background tetrahedra.
TetMesh fromBackground(const TetrahedralizerInput& input, const TargetLengths& lengths,
                       const TetrahedralizerOptions& options, const Progress& progress)
{
  constexpr double leastShare = 0.95; // of the target angle: another run is not worth a degree
  constexpr double firstRun = 0.95;   // of the progress: a second run is rare
  const double least = sine2OfDegrees(leastShare * improvementOptions(input, options).targetAngle);
  const std::set<Label> roomy = tissuesWithRoom(input.background->mesh, lengths.inWorld);
  TetMesh mesh = withImprovedLattice(input, roomy, lengths, options, subProgress(progress, 0, firstRun));
  std::set<Label> stillLaid = roomy;
  for (const Label label : labelsAroundBad(mesh, least)) stillLaid.erase(label);
  if (stillLaid == roomy) return mesh;
  TetMesh other = withImprovedLattice(input, stillLaid, lengths, options, subProgress(progress, firstRun, 1));
  if (worstOf(other) > worstOf(mesh)) return other;
  return mesh;
}

/// Returns the lattice inside the surface, improved.
TetMesh fromSurface(const TetrahedralizerInput& input, const TargetLengths& lengths,
                    const TetrahedralizerOptions& options, const Progress& progress)
{
  TetMesh mesh = fillWithTetrahedra(input.surface, lengths.inWorld, input.name, options.placement);
  improveInFrame(mesh, lengths, improvementOptions(input, options), progress);
  return mesh;
}

/// Divides `mesh` into child and parent, and sets the constitutive classes of its tetrahedra.
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
  const auto fill = input.background ? fromBackground : fromSurface;
  TetMesh mesh = fill(input, lengths, options, subProgress(progress, 0.25, 0.8));
  input.background.reset(); // frees memory
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
