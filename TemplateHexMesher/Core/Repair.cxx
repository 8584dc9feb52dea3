// SPDX-License-Identifier: Apache-2.0
#include "Repair.h"

#include "FitEnergy.h"
#include "Validity.h"

namespace surgicalmesher
{
namespace
{

constexpr EnergyWeights kWeights{ 0.3, 10, 0.25, 0.2 };
constexpr double kPlaceWeight = 0.3; ///< of a node's squared distance to its place, mm^-2
constexpr int kSteps = 50;           ///< of a round
constexpr double kEnough = 0.02;     ///< scaled Jacobian at which an element is left

} // namespace

Points repaired(const ElementMesh& mesh, int rounds)
{
  Points points = mesh.points;
  if (validityOf(mesh.elements, points).invalid == 0) return points;
  FitEnergy energy(mesh);
  energy.weights = kWeights;
  for (Eigen::Index i = 0; i < points.cols(); ++i)
  {
    Pull pull;
    pull.nodes[0] = std::int32_t(i);
    pull.weights[0] = 1;
    pull.goal = mesh.points.col(i);
    pull.all = kPlaceWeight;
    energy.pulls.push_back(pull);
  }
  for (int round = 0; round < rounds && validityOf(mesh.elements, points).minimum < kEnough; ++round)
  {
    minimise(energy, points, kSteps);
    energy.reference = points;
    energy.weights.hinge *= 1.5;
  }
  return validityOf(mesh.elements, points).invalid == 0 ? points : mesh.points;
}

} // namespace surgicalmesher
