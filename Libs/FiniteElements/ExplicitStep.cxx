// SPDX-License-Identifier: Apache-2.0
#include "ExplicitStep.h"

#include "ConstitutiveTags.h"
#include "LinearTetrahedron.h"
#include "MeshQuality.h"

#include <vtkMath.h>

#include <cmath>
#include <limits>

namespace surgicalmesher
{
namespace
{

/// Returns the eigenvalues of a symmetric matrix, descending.
std::array<double, 3> eigenvalues(double (&matrix)[3][3])
{
  double vectors[3][3];
  std::array<double, 3> values{};
  double *rows[3] = { matrix[0], matrix[1], matrix[2] }, *columns[3] = { vectors[0], vectors[1], vectors[2] };
  vtkMath::Jacobi(rows, values.data(), columns);
  return values;
}

/// Returns the eigenvalues of the sum of g g^T over the corners.
std::array<double, 3> principalGradients(const LinearTetrahedron& element)
{
  double gram[3][3] = {};
  for (const Vec3& g : element.gradients)
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) gram[i][j] += g[i] * g[j];
  return eigenvalues(gram);
}

/// Returns the largest eigenvalue of D^1/2 B B^T D^1/2. In the frame where the sum of g g^T is diagonal, the six
/// strains decouple into three shear strains, mu (c_i + c_j), and the normal strains, sqrt(c) (lambda 1 1^T + 2 mu I)
/// sqrt(c).
double largestStiffness(const std::array<double, 3>& c, const LameConstants& lame)
{
  double normal[3][3];
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) normal[i][j] = lame.lambda * std::sqrt(c[i] * c[j]) + (i == j ? 2 * lame.mu * c[i] : 0);
  return std::max(lame.mu * (c[0] + c[1]), eigenvalues(normal)[0]);
}

} // namespace

double criticalStep(const std::array<Vec3, 4>& corners, const TissueMaterial& material)
{
  const LameConstants lame = lameConstants(material.youngsModulus, material.poissonsRatio);
  const std::array<double, 3> principal = principalGradients(linearTetrahedron(corners));
  // omega^2 = V largestStiffness / (density V / 4)
  return std::sqrt(material.density / largestStiffness(principal, lame));
}

std::map<Label, ExplicitStep> explicitSteps(const MeshFile& content, const std::map<Label, TissueMaterial>& materials)
{
  constexpr double infinite = std::numeric_limits<double>::infinity();
  const TetMesh& mesh = content.mesh;
  std::map<Label, ExplicitStep> steps;
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t)
  {
    const Label label = mesh.labels[t];
    const std::array<Vec3, 4> p = cornersOf(mesh, t);
    ExplicitStep& step = steps.try_emplace(label, ExplicitStep{ infinite, infinite, -1 }).first->second;
    step.leastHeight = std::min(step.leastHeight, leastHeight(p[0], p[1], p[2], p[3]));
    if (!content.constitutive.empty() && content.constitutive[t] == kNullDisplacement) continue;
    const auto material = materials.find(label);
    const double critical = criticalStep(p, material == materials.end() ? TissueMaterial() : material->second);
    if (critical < step.step) step.step = critical, step.tetrahedron = std::int32_t(t);
  }
  for (auto& [label, step] : steps)
    if (step.tetrahedron < 0) step.step = 0;
  return steps;
}

double smallestStep(const std::map<Label, ExplicitStep>& steps)
{
  double smallest = 0;
  for (const auto& [label, step] : steps)
    if (step.step > 0 && (smallest == 0 || step.step < smallest)) smallest = step.step;
  return smallest;
}

} // namespace surgicalmesher
