// SPDX-License-Identifier: Apache-2.0
#include "StiffnessConditioning.h"

#include "ConjugateGradients.h"

#include <algorithm>
#include <cmath>

namespace surgicalmesher
{
namespace
{

constexpr double kPoissonsRatio = 0.4;
constexpr double kTolerance = 1e-8;
constexpr double kModesTolerance = 1e-22; // small enough for twenty modes to converge
constexpr int kModes = 20;

// ---- loads ----------------------------------------------------------------------------------------------------------

/// Returns a load of a quarter of the weight of each tetrahedron, at density 1, at each of its corners.
NodalVector ownWeight(const TetMesh& mesh, const std::vector<std::int32_t>& number, std::int32_t count)
{
  NodalVector load(count);
  for (const auto& ids : mesh.tetrahedra)
  {
    const auto& p = mesh.points;
    const double volume = orient(p[ids[0]], p[ids[1]], p[ids[2]], p[ids[3]]) / 6;
    for (const std::int32_t id : ids)
    {
      if (number[id] >= 0) load[number[id]].z -= volume / 4;
    }
  }
  return load;
}

/// Returns forces that excite every mode: numbers in [-1, 1) from a linear congruential generator (Knuth's MMIX).
NodalVector scatteredForces(std::int32_t count)
{
  std::uint64_t state = 1;
  const auto next = [&]
  {
    state = state * 6364136223846793005ULL + 1442695040888963407ULL;
    return double(state >> 11) / double(std::uint64_t(1) << 52) - 1;
  };
  NodalVector load(count);
  for (Vec3& force : load)
  {
    for (int axis = 0; axis < 3; ++axis) force[axis] = next();
  }
  return load;
}

// ---- modes ----------------------------------------------------------------------------------------------------------

/// Returns the effective share of the nodes that take part in a mode: the inverse of the number of nodes times the sum
/// of the squares of their parts (participation ratio, Bell, Dean, Discussions of the Faraday Society 50, 1970).
double participation(const NodalVector& shape)
{
  double sum = 0;
  for (const Vec3& v : shape) sum += squaredNorm(v) * squaredNorm(v);
  return 1 / (sum * double(shape.size()));
}

LocalMode localMode(const TetMesh& mesh, const std::vector<std::int32_t>& number, const ScaledMode& mode)
{
  LocalMode result;
  result.eigenvalue = mode.eigenvalue;
  result.nodeShare = participation(mode.shape);
  double most = -1;
  std::size_t strongest = 0;
  for (std::size_t id = 0; id < number.size(); ++id)
  {
    if (number[id] < 0) continue;
    const double part = squaredNorm(mode.shape[number[id]]);
    result.place += part * mesh.points[id];
    if (part > most) most = part, strongest = id;
  }
  const auto uses = [&](const std::array<std::int32_t, 4>& ids)
  { return std::find(ids.begin(), ids.end(), std::int32_t(strongest)) != ids.end(); };
  const auto found = std::find_if(mesh.tetrahedra.begin(), mesh.tetrahedra.end(), uses);
  result.label = mesh.labels[found - mesh.tetrahedra.begin()];
  return result;
}

} // namespace

StiffnessConditioning stiffnessConditioning(const TetMesh& mesh)
{
  StiffnessConditioning result;
  std::int32_t free = 0;
  const std::vector<std::int32_t> number = numberFreePoints(mesh, free);
  result.unknowns = 3 * static_cast<std::size_t>(free);
  if (free == 0) return result;
  const BlockMatrix matrix = stiffnessMatrix(mesh, number, free, kPoissonsRatio);
  const NodalVector forces = scatteredForces(free);
  const Solution weighed = solve(matrix, ownWeight(mesh, number, free), kTolerance);
  const Solution scattered = solve(matrix, forces, kModesTolerance);
  result.iterations = weighed.iterations;
  result.iterationsPerCubeRoot = weighed.iterations / std::cbrt(double(result.unknowns));
  result.converged = weighed.converged && scattered.converged;
  if (!result.converged) return result;
  const LanczosMatrix &a = weighed.lanczos, &b = scattered.lanczos;
  result.smallestEigenvalue = std::min(a.smallest(), b.smallest());
  result.largestEigenvalue = std::max(a.largest(), b.largest());
  result.condition = result.largestEigenvalue / result.smallestEigenvalue;
  for (const ScaledMode& mode : lowestModes(matrix, forces, scattered, kModesTolerance, kModes))
  {
    const LocalMode local = localMode(mesh, number, mode);
    if (local.nodeShare < kLocalShare) result.localModes.push_back(local);
  }
  return result;
}

} // namespace surgicalmesher
