#include "MeshImprovement.h"

#include "FaceNeighbours.h"
#include "Improvement.h"

#include <algorithm>
#include <cmath>

namespace surgicalmesher
{

namespace
{

constexpr std::size_t blockSize = 40000; // tetrahedra

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
  for (int i = 0; i < options.sweeps; ++i)
  {
    const bool last = i + 1 == options.sweeps;
    ImprovementOptions improvement;
    // Splits cost regular sizes and drift costs fidelity: both only in the end, where an angle is still bad.
    improvement.targetAngle = last ? 0.9 * options.targetAngle : options.targetAngle;
    improvement.split = last;
    improvement.splitEdge = 0.8;
    improvement.trials = last ? 20 : 12;
    sweepBlocks(
      ambient, i, blockSize,
      [&](TetComplex& block)
      {
        GuardedOperations operations(block, scale, last ? 0.8 : 0.3);
        if (!last) relaxBlock(operations);
        improveBlock(operations, improvement);
      },
      [&](double fraction, const std::string&) { report(progress, (i + fraction) / options.sweeps, "improvement"); });
  }
  mesh = std::move(ambient.mesh);
}

} // namespace surgicalmesher
