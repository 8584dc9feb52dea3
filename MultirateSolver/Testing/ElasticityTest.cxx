// SPDX-License-Identifier: Apache-2.0
#include "Elasticity.h"
#include "DividedBox.h"

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include <random>

using namespace surgicalmesher;
using namespace surgicalmesher::test;

namespace
{

/// Two voxels of tetrahedra, every point free.
ElasticBody freeBody()
{
  ElasticBody body;
  body.mesh = tetrahedraOf(paintedMap({ 2, 1, 1 }, [](int, int, int) { return 1; }, { 3, 2, 2.5 }), 0);
  for (std::size_t p = 0; p < body.mesh.points.size(); ++p) body.unknowns.push_back(body.freePoints++);
  body.lame.assign(body.mesh.tetrahedra.size(), lameConstants(0.003, 0.45));
  return body;
}

Eigen::VectorXd randomDisplacement(const ElasticBody& body, double size)
{
  std::mt19937 random(7);
  std::uniform_real_distribution<double> draw(-size, size);
  Eigen::VectorXd displacement(body.size());
  for (double& u : displacement) u = draw(random);
  return displacement;
}

Eigen::MatrixXd dense(const SymmetricMatrix& matrix) { return Eigen::MatrixXd(matrix).selfadjointView<Eigen::Lower>(); }

} // namespace

TEST(Elasticity, TheNeoHookeanTangentAtRestIsTheLinearStiffness)
{
  const ElasticBody body = freeBody();
  const Eigen::MatrixXd linear = dense(linearStiffness(body));
  const Eigen::MatrixXd tangent = dense(NeoHookean::tangent(body, Eigen::VectorXd::Zero(body.size())));
  EXPECT_LT((linear - tangent).norm(), 1e-14 * linear.norm());
  EXPECT_GT(linear.norm(), 0);
}

TEST(Elasticity, AUniformStrainHasTheStressOfHookesLaw)
{
  const ElasticBody body = freeBody();
  Eigen::VectorXd stretched(body.size());
  for (std::size_t p = 0; p < body.mesh.points.size(); ++p)
    stretched.segment<3>(3 * Eigen::Index(p)) << 0.01 * body.mesh.points[p].x, 0, 0;
  const auto [lambda, mu] = body.lame.front();
  const double volume = 6 * 2 * 2.5, energy = 0.5 * stretched.dot(dense(linearStiffness(body)) * stretched);
  EXPECT_NEAR(energy, 0.5 * (lambda + 2 * mu) * 1e-4 * volume, 1e-12 * volume);
}

TEST(Elasticity, ForcesAreTheGradientOfTheEnergyAndTheTangentTheirs)
{
  const ElasticBody body = freeBody();
  const Eigen::VectorXd u = randomDisplacement(body, 0.3), direction = randomDisplacement(body, 1);
  const double h = 1e-5;
  const double slope =
    (NeoHookean::energy(body, u + h * direction) - NeoHookean::energy(body, u - h * direction)) / (2 * h);
  EXPECT_NEAR(NeoHookean::forces(body, u).dot(direction), slope, 1e-7 * std::abs(slope));
  const Eigen::VectorXd change =
    (NeoHookean::forces(body, u + h * direction) - NeoHookean::forces(body, u - h * direction)) / (2 * h);
  EXPECT_LT((dense(NeoHookean::tangent(body, u)) * direction - change).norm(), 1e-7 * change.norm());
}

TEST(Elasticity, ARotationCostsNothing)
{
  const ElasticBody body = freeBody();
  Eigen::VectorXd turned(body.size());
  for (std::size_t p = 0; p < body.mesh.points.size(); ++p) // by 90 degrees about z
  {
    const Vec3& x = body.mesh.points[p];
    turned.segment<3>(3 * Eigen::Index(p)) << -x.y - x.x, x.x - x.y, 0;
  }
  EXPECT_NEAR(NeoHookean::energy(body, turned), 0, 1e-15);
  EXPECT_LT(NeoHookean::forces(body, turned).lpNorm<Eigen::Infinity>(), 1e-15);
}

TEST(Elasticity, ATurnedTetrahedronHasNoEnergyButInfinity)
{
  const ElasticBody body = freeBody();
  Eigen::VectorXd flat(body.size());
  for (std::size_t p = 0; p < body.mesh.points.size(); ++p)
    flat.segment<3>(3 * Eigen::Index(p)) << -1.5 * body.mesh.points[p].x, 0, 0;
  EXPECT_TRUE(std::isinf(NeoHookean::energy(body, flat)));
}

TEST(Elasticity, WithoutNegativeEigenvaluesATangentIsSemidefinite)
{
  const ElasticBody body = freeBody();
  Eigen::VectorXd pressed(body.size());
  for (std::size_t p = 0; p < body.mesh.points.size(); ++p)
    pressed.segment<3>(3 * Eigen::Index(p)) << -0.7 * body.mesh.points[p].x, 0, 0;
  const auto smallest = [](const SymmetricMatrix& matrix)
  { return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(dense(matrix)).eigenvalues().minCoeff(); };
  EXPECT_LT(smallest(NeoHookean::tangent(body, pressed)), -1e-4);
  EXPECT_GT(smallest(NeoHookean::tangent(body, pressed, true)), -1e-12);
}

TEST(Elasticity, TheWeightIsTheVolumes)
{
  const ElasticBody body = freeBody();
  const Eigen::VectorXd weight = weightOf(body, { 1, 0, -2 });
  EXPECT_NEAR(weight.sum(), -30, 1e-12);
}
