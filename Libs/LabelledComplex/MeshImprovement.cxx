#include "MeshImprovement.h"

#include "FaceNeighbours.h"
#include "Improvement.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace surgicalmesher
{

namespace
{

constexpr std::size_t blockSize = 40000; // tetrahedra

/// Splits cost regular sizes and drift costs fidelity: both only in the end, where an angle is still bad. Then in one block:
/// borders are locked, and what is still bad lies at them.
struct Step
{
  double rmsLimit, slack; ///< see GuardedOperations
  int relaxations, polishes;
  int trials, passes;
  double splitEdge; ///< 0: no splits
  bool whole;
};
constexpr Step steps[] = {
  { 0.3, 1, 1, 3, 8, 2, 0, false }, { 0.5, 1, 1, 3, 12, 2, 0, false }, { 0.8, 1, 0, 3, 16, 2, 0, false },
  { 1, 1, 0, 0, 20, 3, 0, true },   { 1, 2, 0, 0, 20, 3, 0.6, true },  { 1, 2, 0, 0, 20, 3, 0.4, true },
};

ImprovementOptions improvementOf(const Step& step, double targetAngle)
{
  ImprovementOptions o;
  o.targetAngle = targetAngle;
  o.trials = step.trials;
  o.passes = step.passes;
  o.split = step.splitEdge > 0;
  o.splitEdge = step.splitEdge;
  return o;
}

/// Points on every interface triangle, about half a target length apart: where the surface is now.
void placeEvidence(AmbientMesh& ambient, double tolerance)
{
  const TetraMesh& mesh = ambient.mesh;
  const auto neighbours = faceNeighbours(mesh);
  for (std::int32_t t = 0; t < std::int32_t(mesh.tetrahedra.size()); ++t)
    for (std::int32_t i = 0; i < 4; ++i)
    {
      const std::int32_t n = neighbours.across[t][i];
      if (n < 0 || mesh.labels[n] >= mesh.labels[t]) continue;
      std::array<Vec3, 3> p;
      double length = 0;
      for (int k = 0; k < 3; ++k)
      {
        const std::int32_t v = mesh.tetrahedra[t][(i + 1 + k) & 3];
        p[k] = mesh.points[v];
        length += ambient.lengths[v] / 3;
      }
      for (int k = 0; k < 3; ++k)
        ambient.evidence.push_back({ (4 * p[k] + p[(k + 1) % 3] + p[(k + 2) % 3]) / 6, float(tolerance * length), t, i });
    }
}

} // namespace

void improveMesh(TetraMesh& mesh, const ScaleFunction& scale, const MeshImprovementOptions& options, const Progress& progress)
{
  AmbientMesh ambient;
  ambient.mesh = mesh;
  for (const Vec3& p : mesh.points) ambient.lengths.push_back(scale(p));
  placeEvidence(ambient, options.surfaceTolerance);
  const std::size_t sweeps = std::size(steps);
  for (std::size_t i = 0; i < sweeps; ++i)
  {
    const Step& step = steps[i];
    sweepBlocks(
      ambient, int(i), step.whole ? ambient.mesh.tetrahedra.size() : blockSize,
      [&](TetComplex& block)
      {
        GuardedOperations operations(block, scale, step.rmsLimit, step.slack);
        for (int k = 0; k < step.relaxations; ++k) relaxBlock(operations);
        for (int k = 0; k < step.polishes; ++k) polishBlock(operations);
        improveBlock(operations, improvementOf(step, options.targetAngle));
      },
      [&](double fraction, const std::string&) { report(progress, (double(i) + fraction) / double(sweeps), "improvement"); });
  }
  mesh = std::move(ambient.mesh);
}

} // namespace surgicalmesher
