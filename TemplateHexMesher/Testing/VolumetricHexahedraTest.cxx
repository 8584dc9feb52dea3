// SPDX-License-Identifier: Apache-2.0
#include "VolumetricHexahedra.h"
#include "ElementQuality.h"
#include "Errors.h"
#include "HarmonicField.h"
#include "SlabEnvelope.h"
#include "SurfaceDistance.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>

using namespace surgicalmesher;
using namespace surgicalmesher::test;

namespace
{

HexOptions coarse()
{
  HexOptions options;
  options.divisions = { 20, 4, 16 };
  return options;
}

} // namespace

TEST(HarmonicField, WeightsAreThePapersCotangents)
{
  const Tetrahedra mesh{ (Points(3, 4) << 0, 2, 0.3, 0.1, 0, 0, 1.5, 0.4, 0, 0, 0, 1).finished(), { { 0, 1, 2, 3 } } };
  const auto weights = harmonicWeights(mesh);
  const auto p = [&](int i) { return Eigen::Vector3d(mesh.points.col(i)); };
  // The edge 01, opposite to 23: theta is the angle at 23 between the sides 230 and 231.
  const Eigen::Vector3d along = p(3) - p(2), n0 = along.cross(p(0) - p(2)), n1 = along.cross(p(1) - p(2));
  const double cotangent = n0.dot(n1) / n0.cross(n1).norm();
  EXPECT_NEAR(weights.coeff(0, 1), -along.norm() * cotangent / 6, 1e-12);
  EXPECT_NEAR((weights * Eigen::Vector4d::Ones()).norm(), 0, 1e-12);
}

TEST(HarmonicField, OrthogonalisedIsOrthogonalAndKeepsTheRest)
{
  const Points g = (Points(3, 1) << 1, 2, 3).finished(), other = (Points(3, 1) << 0, 2, 1).finished();
  const Points result = orthogonalised(g, other);
  EXPECT_NEAR(result.col(0).dot(other.col(0)), 0, 1e-12);
  EXPECT_NEAR((g - result).col(0).cross(other.col(0)).norm(), 0, 1e-12);
}

TEST(LayerDepths, AreEvenWhereThinAndLimitedWhereThick)
{
  HexOptions options;
  options.divisions = { 1, 6, 1 };
  EXPECT_NEAR(layerDepths(5, options)[1], 1. / 6, 1e-12);
  EXPECT_NEAR(layerDepths(20, options)[1], 2. / 20, 1e-12);
  EXPECT_NEAR(layerDepths(20, options)[5], 18. / 20, 1e-12);
  for (double thickness = 0.5; thickness < 30; thickness += 0.5)
  {
    const std::vector<double> depths = layerDepths(thickness, options);
    EXPECT_EQ(depths.front(), 0);
    EXPECT_EQ(depths.back(), 1);
    for (std::size_t l = 1; l < depths.size(); ++l) EXPECT_GT(depths[l], depths[l - 1]) << thickness;
  }
}

TEST(VolumetricHexahedra, FillASlabWithValidElementsOnItsSurface)
{
  const SlabParameterisation slab = parameterise(slabEnvelope(false), 5, "slab");
  const LayeredMesh mesh = layeredHexahedra(slab, coarse());
  EXPECT_EQ(mesh.mesh.elements.size(), 20u * 4 * 16);
  const QualitySummary quality = summaryOf(mesh.mesh, elementQuality(mesh.mesh), ElementShape::Hexahedron);
  EXPECT_EQ(quality.invalid, 0u);
  EXPECT_GT(quality.mean, 0.9);
  EXPECT_LT(distanceBetween(outerSurface(mesh.mesh), TargetSurface(slab.envelope.surface)).mean, 0.1);
}

TEST(VolumetricHexahedra, FollowAHole)
{
  const SlabParameterisation slab = parameterise(slabEnvelope(true), 5, "slab");
  const LayeredMesh mesh = layeredHexahedra(slab, coarse());
  EXPECT_LT(mesh.mesh.elements.size(), 20u * 4 * 16);
  EXPECT_GT(summaryOf(mesh.mesh, elementQuality(mesh.mesh), ElementShape::Hexahedron).minimum, 0.2);
  const TriangleSurface surface = outerSurface(mesh.mesh);
  EXPECT_LT(distanceBetween(surface, TargetSurface(slab.envelope.surface)).mean, 0.25);
  EXPECT_LT(distanceBetween(slab.envelope.surface, TargetSurface(surface)).mean, 0.3);
}

TEST(VolumetricHexahedra, AnOpenEnvelopeAndAMissingSideAreRefused)
{
  Envelope open = slabEnvelope(false);
  open.surface.triangles.pop_back();
  open.sides.pop_back();
  EXPECT_THROW(parameterise(open, 5, "slab"), InputError);
  Envelope unpainted = slabEnvelope(false);
  std::replace(unpainted.sides.begin(), unpainted.sides.end(), Side::Top, Side::Hole);
  EXPECT_THROW(withSides(unpainted.surface, unpainted.surface, unpainted.sides, "sides"), InputError);
}
