#include "MeshImprovement.h"

#include "Coarsening.h"
#include "FaceAdjacency.h"
#include "Improvement.h"
#include "MeshQuality.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace surgicalmesher
{

namespace
{

/// What one sweep over the blocks does, in this order. The angle that vertices may fall to while they move rises with what
/// has been reached, and the angle aimed at with it: sizes suffer less than from one step straight to the end. Then only
/// what is still bad may stray farther from the surface, in one block, as borders are locked and what is still bad lies at
/// them. Splits cost regular sizes, and come late. In the end the surface goes back to where it was as far as the angles
/// allow.
struct Step
{
  double rmsLimit, toleranceFactor; ///< see GuardedOperations
  double collapseAngle;   ///< degrees, least that the collapse of a short edge leaves; 0: no collapses
  int relaxations;
  double relaxationAngle; ///< see RelaxationOptions::goodAngle
  int polishes;
  double polishAngle, polishFit; ///< see PolishOptions
  double aim;                    ///< degrees; the target angle at most
  int trials, passes;
  double splitEdge; ///< 0: no splits
  bool whole;
};
constexpr double most = 90;
constexpr Step steps[] = {
  { 0.3, 1.0, 15, 3, 15, 2, 29.5, 1, 20, 8, 2, 0, false },   { 0.3, 1.0, 20, 1, 20, 2, 29.5, 1, 25, 8, 2, 0, false },
  { 0.4, 1.0, 20, 1, 25, 3, 29.5, 1, most, 8, 2, 0, false }, { 0.4, 1.0, 20, 1, 25, 4, 29.5, 1, most, 8, 2, 0, false },
  { 0.3, 1.0, 0, 1, 25, 4, 29.5, 1, most, 8, 2, 0, false },  { 0.5, 1.0, 0, 1, 25, 4, 29.5, 1, most, 12, 2, 0, false },
  { 0.8, 1.5, 0, 0, 0, 5, 29.5, 1, most, 16, 2, 0, false },  { 1.0, 2.0, 0, 0, 0, 0, 0, 1, most, 20, 3, 0, true },
  { 1.0, 3.0, 0, 0, 0, 0, 0, 1, most, 20, 3, 0, true },      { 1.0, 4.0, 0, 0, 0, 0, 0, 1, most, 20, 3, 0, true },
  { 1.0, 4.0, 0, 0, 0, 0, 0, 1, most, 20, 3, 0.6, true },    { 1.0, 4.0, 0, 0, 0, 0, 0, 1, most, 30, 4, 0.4, true },
  { 0.4, 1.0, 0, 0, 0, 2, 28.4, 3, 0, 0, 0, 0, false },
};

/// `keptAngle`, degrees: what relaxation must not fall below whatever the step allows.
void work(GuardedOperations& operations, const Step& step, double targetAngle, double keptAngle)
{
  if (step.collapseAngle > 0)
  {
    CoarseningOptions coarsening;
    coarsening.minimumAngle = step.collapseAngle;
    coarsenBlock(operations, std::numeric_limits<double>::max(), coarsening);
  }
  RelaxationOptions relaxation;
  relaxation.goodAngle = std::max(step.relaxationAngle, keptAngle);
  PolishOptions polishing;
  polishing.goodAngle = step.polishAngle;
  polishing.fit = step.polishFit;
  for (int i = 0; i < step.relaxations; ++i) relaxBlock(operations, relaxation);
  for (int i = 0; i < step.polishes; ++i) polishBlock(operations, polishing);
  if (step.passes == 0) return;
  ImprovementOptions improvement;
  improvement.targetAngle = std::min(step.aim, targetAngle);
  improvement.trials = step.trials;
  improvement.passes = step.passes;
  improvement.split = step.splitEdge > 0;
  improvement.splitEdge = step.splitEdge;
  if (step.splitEdge > 0) improvement.together = 20; // where many are bad, it costs more than all the rest
  improveBlock(operations, improvement);
}

/// Whether hardly any angle is so bad that many collapses and flips all over the mesh would be worth their while.
bool isGood(const TetMesh& mesh)
{
  constexpr std::size_t few = 10000; // one in so many
  return countBelow(mesh, 20) <= mesh.tetrahedra.size() / few;
}

/// The angle to work for. Of a good mesh that still has many below `wanted`, the surface stage has found no room for better
/// ones.
double attainable(const TetMesh& mesh, bool good, double wanted)
{
  constexpr std::size_t many = 2000;
  const std::size_t below = good ? countBelow(mesh, wanted) : 0;
  return below > many && below > mesh.tetrahedra.size() / 200 ? std::min(wanted, modestAngle) : wanted;
}

/// Whether a step has anything to do for a mesh that has had the steps before, and that was good from the beginning or not. Of
/// a good one a few tetrahedra are mended where they are, without moving everything else once more.
bool isWorthwhile(const Step& step, const TetMesh& mesh, double target, bool good)
{
  if (step.collapseAngle > 0) return !good;
  if (step.rmsLimit < 0.5) return true;
  const std::size_t few = good && !step.whole ? mesh.tetrahedra.size() / 400 : 0;
  return countBelow(mesh, target) > few;
}

/// The triangle cut into n^2 congruent ones.
std::vector<std::array<Vec3, 3>> subdivided(const std::array<Vec3, 3>& p, int n)
{
  std::vector<std::array<Vec3, 3>> result;
  const Vec3 u = (p[1] - p[0]) / n, v = (p[2] - p[0]) / n;
  for (int i = 0; i < n; ++i)
    for (int j = 0; i + j < n; ++j)
    {
      const Vec3 q = p[0] + i * u + j * v;
      result.push_back({ q, q + u, q + v });
      if (i + j + 1 < n) result.push_back({ q + u + v, q + v, q + u });
    }
  return result;
}

/// Points on every interface triangle, about half a target length apart: where the surface is now.
void placeSamples(BackgroundMesh& ambient, double tolerance)
{
  const TetMesh& mesh = ambient.mesh;
  const auto neighbours = faceAdjacency(mesh);
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
      const double longest = std::max({ norm(p[1] - p[0]), norm(p[2] - p[1]), norm(p[0] - p[2]) });
      const int parts = std::clamp(int(longest / (2 * length)) + 1, 1, 16);
      for (const auto& q : subdivided(p, parts))
        for (int k = 0; k < 3; ++k)
          ambient.samples.push_back(
            { (4 * q[k] + q[(k + 1) % 3] + q[(k + 2) % 3]) / 6, float(tolerance * length), t, i });
    }
}

} // namespace

void improveMesh(TetMesh& mesh, const SizingFunction& scale, const MeshImprovementOptions& options,
                 const Progress& progress)
{
  BackgroundMesh ambient;
  ambient.mesh = mesh;
  for (const Vec3& p : mesh.points) ambient.lengths.push_back(scale(p));
  placeSamples(ambient, options.surfaceTolerance);
  const std::size_t sweeps = std::size(steps);
  const bool good = isGood(mesh);
  const double target = attainable(mesh, good, options.targetAngle);
  const double kept = good ? target : 0; // to fall below it and to be mended again would take most of the time
  for (std::size_t i = 0; i < sweeps; ++i)
  {
    const Step& step = steps[i];
    if (!isWorthwhile(step, ambient.mesh, target, good)) continue;
    // The surface stage has put its surface where it belongs: only repairs may take it away.
    const double held = good && step.rmsLimit < 0.5 ? 0.6 : 1;
    sweepBlocks(
      ambient, int(i), step.whole ? oneBlock : fairBlock(ambient.mesh),
      [&](TetComplex& block)
      {
        GuardedOperations operations(block, scale, { held * step.rmsLimit, step.toleranceFactor });
        work(operations, step, target, kept);
      },
      [&](double fraction, const std::string&)
      { report(progress, (double(i) + fraction) / double(sweeps), "improvement"); });
  }
  mesh = std::move(ambient.mesh);
}

} // namespace surgicalmesher
