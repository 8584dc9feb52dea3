// SPDX-License-Identifier: Apache-2.0
// Curves in meshes of one and of several tissues: chains of edges, near the curve, at little cost to the angles.

#include "CurveInsertion.h"
#include "Distance.h"
#include "Errors.h"
#include "FaceAdjacency.h"
#include "MeshChecks.h"
#include "MeshQuality.h"
#include "Shapes.h"
#include "SurfaceTetrahedralization.h"
#include "TetrahedraImprovement.h"
#include "VoxelMesh.h"
#include "WorstAngle.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

namespace surgicalmesher
{
namespace
{

using namespace test;

TetMesh improvedMesh(const SurfaceComplex& surface, double length)
{
  const auto edgeLength = [&](const Vec3&) { return length; };
  TetMesh mesh = fillWithTetrahedra(surface, edgeLength, "shape");
  improveTetrahedra(mesh, edgeLength);
  return mesh;
}

/// A ball of tissue 1 and radius 10 with a ball of tissue 2 and radius 5 inside.
const TetMesh& nestedBalls()
{
  static const TetMesh mesh = []
  {
    SurfaceComplex surface = sphere({}, 10, 4, 1, 0);
    append(surface, sphere({ 0, 0, 0 }, 5, 3, 2, 1));
    return improvedMesh(surface, 1.4);
  }();
  return mesh;
}
constexpr double ballLength = 1.4;

Curve curveOf(const std::string& name, const std::function<Vec3(double)>& at, int steps)
{
  Curve curve{ name, name, {}, {} };
  for (int n = 0; n <= steps; ++n)
  {
    curve.points.push_back(at(double(n) / steps));
    curve.radii.push_back(0.2 + 0.3 * n / steps);
  }
  return curve;
}

Curve helix()
{
  return curveOf(
    "helix",
    [](double t) {
      return Vec3{ 6.5 * std::cos(9 * t), 6.5 * std::sin(9 * t), 8 * t - 4 };
    },
    200);
}
Curve straight()
{
  return curveOf(
    "straight",
    [](double t) {
      return Vec3{ 17 * t - 8.5, 0.3, 0.4 };
    },
    1);
}
Curve branch()
{
  return curveOf(
    "branch",
    [](double t) {
      return Vec3{ 1 + 4 * t, 0.3 + 6 * t, 0.4 - 3 * t };
    },
    3);
}

/// Half way around the inner ball, on its surface.
Curve alongInterface()
{
  return curveOf(
    "along",
    [](double t) {
      return Vec3{ 5 * std::cos(3 * t), 4 * std::sin(3 * t), 3 * std::sin(3 * t) };
    },
    100);
}

double distanceTo(const Vec3& p, const std::vector<Vec3>& line)
{
  double least = 1e9;
  for (std::size_t n = 1; n < line.size(); ++n) least = std::min(least, distanceToSegment(p, line[n - 1], line[n]));
  return least;
}

double farthest(const std::vector<Vec3>& from, const std::vector<Vec3>& to)
{
  double most = 0;
  for (std::size_t n = 1; n < from.size(); ++n)
    for (int k = 0; k <= 20; ++k)
      most = std::max(most, distanceTo(from[n - 1] + 0.05 * k * (from[n] - from[n - 1]), to));
  return most;
}

std::set<std::array<std::int32_t, 2>> edgesOf(const TetMesh& mesh)
{
  std::set<std::array<std::int32_t, 2>> edges;
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t)
    for (const auto& [i, j] : kEdgeCorners)
      if (mesh.labels[t] != 0)
        edges.insert({ std::min(mesh.tetrahedra[t][i], mesh.tetrahedra[t][j]),
                       std::max(mesh.tetrahedra[t][i], mesh.tetrahedra[t][j]) });
  return edges;
}

void expectInserted(const TetMesh& before, const std::vector<Curve>& curves, double length)
{
  TetMesh mesh = before;
  const SizingFunction edgeLength = [&](const Vec3&) { return length; };
  const std::vector<CurveChain> chains = insertCurves(mesh, curveNetwork(curves, edgeLength), edgeLength);
  requireSound(withoutOutside(mesh), "curves");
  EXPECT_EQ(meshTopology(mesh), meshTopology(before));
  const auto volumes = checkSurface(interfaceOf(before));
  for (const auto& [label, tissue] : checkSurface(interfaceOf(mesh)))
    EXPECT_NEAR(tissue.volume, volumes.at(label).volume, 0.002 * tissue.volume) << "label " << label;
  EXPECT_GE(worstAngle(mesh), worstAngle(before) - 5);
  const auto edges = edgesOf(mesh);
  ASSERT_EQ(chains.size(), curves.size());
  for (std::size_t c = 0; c < chains.size(); ++c)
  {
    SCOPED_TRACE(curves[c].name);
    EXPECT_EQ(chains[c].name, curves[c].name);
    ASSERT_EQ(chains[c].points.size(), chains[c].radii.size());
    std::vector<Vec3> line;
    for (const std::int32_t v : chains[c].points) line.push_back(mesh.points[v]);
    for (std::size_t n = 1; n < line.size(); ++n)
    {
      const auto [low, high] = std::minmax(chains[c].points[n - 1], chains[c].points[n]);
      EXPECT_EQ(edges.count({ low, high }), 1u);
      EXPECT_GT(norm(line[n] - line[n - 1]), 0.15 * length);
    }
    EXPECT_LE(farthest(line, curves[c].points), 0.1 * length);
    EXPECT_LE(farthest(curves[c].points, line), 0.1 * length);
    EXPECT_NEAR(chains[c].radii.front(), curves[c].radii.front(), 0.01);
    EXPECT_NEAR(chains[c].radii.back(), curves[c].radii.back(), 0.01);
  }
}

} // namespace

TEST(CurveInsertion, AHelixInsideOneTissue) { expectInserted(nestedBalls(), { helix() }, ballLength); }

TEST(CurveInsertion, AStraightLineThroughBothTissuesThatEndsInside)
{
  expectInserted(nestedBalls(), { straight() }, ballLength);
}

TEST(CurveInsertion, ABranchOnALine)
{
  expectInserted(nestedBalls(), { straight(), branch() }, ballLength);
  TetMesh mesh = nestedBalls();
  const SizingFunction length = [](const Vec3&) { return ballLength; };
  const auto chains = insertCurves(mesh, curveNetwork({ branch(), straight() }, length), length);
  const auto& host = chains[1].points;
  EXPECT_EQ(std::count(host.begin(), host.end(), chains[0].points.front()), 1);
}

/// Curves from one place, in random directions a third of a circle apart, written from either end.
std::vector<Curve> fork(std::mt19937& random)
{
  std::uniform_real_distribution<double> place(-1, 1);
  const Vec3 from{ place(random), place(random), place(random) };
  const double turn = 3 * place(random), tilt = place(random);
  std::vector<Curve> curves;
  for (int n = 0; n < 3; ++n)
  {
    const double angle = turn + n * 2 * std::acos(-1.0) / 3;
    const Vec3 to =
      from + 6 * Vec3{ std::cos(angle), std::sin(angle) * std::cos(tilt), std::sin(angle) * std::sin(tilt) };
    Curve curve{ "fork", "fork.vtp", { from, to }, { 0.3, 0.3 } };
    if (place(random) < 0) std::swap(curve.points[0], curve.points[1]);
    curves.push_back(curve);
  }
  return curves;
}

TEST(CurveInsertion, AForkIsOneNode)
{
  const SizingFunction length = [](const Vec3&) { return ballLength; };
  std::mt19937 random(1);
  for (int round = 0; round < 100; ++round)
  {
    const CurveNetwork network = curveNetwork(fork(random), length);
    EXPECT_EQ(network.nodes.size(), 4u);
    ASSERT_EQ(network.arcs.size(), 3u);
    for (const CurveArc& arc : network.arcs) EXPECT_NEAR(arc.length(), 6, 1e-9);
  }
  expectInserted(nestedBalls(), fork(random), ballLength);
}

TEST(CurveInsertion, ACurveAlongAnInterface) { expectInserted(nestedBalls(), { alongInterface() }, ballLength); }

TEST(CurveInsertion, AClosedCurve)
{
  expectInserted(nestedBalls(),
                 { curveOf(
                   "ring",
                   [](double t) {
                     return Vec3{ 7 * std::cos(2 * std::acos(-1.0) * t), 7 * std::sin(2 * std::acos(-1.0) * t), 0.5 };
                   },
                   60) },
                 ballLength);
}

TEST(CurveInsertion, LeavesTetrahedraFarAwayAlone)
{
  const TetMesh& before = nestedBalls();
  TetMesh after = before;
  const SizingFunction length = [](const Vec3&) { return ballLength; };
  insertCurves(after, curveNetwork({ straight() }, length), length);
  const auto isFar = [](const TetMesh& mesh, std::size_t t)
  {
    const auto& x = mesh.tetrahedra[t];
    return std::all_of(x.begin(), x.end(),
                       [&](std::int32_t v)
                       { return std::hypot(mesh.points[v].y, mesh.points[v].z) > 4.5 * ballLength; });
  };
  std::set<std::array<double, 12>> places[2];
  for (const TetMesh* mesh : { &before, static_cast<const TetMesh*>(&after) })
    for (std::size_t t = 0; t < mesh->tetrahedra.size(); ++t)
    {
      if (!isFar(*mesh, t)) continue;
      std::array<double, 12> place;
      for (int k = 0; k < 12; ++k) place[k] = mesh->points[mesh->tetrahedra[t][k / 3]][k % 3];
      places[mesh == &after].insert(place);
    }
  EXPECT_GT(places[0].size(), 100u);
  EXPECT_EQ(places[0], places[1]);
}

TEST(CurveInsertion, RefusesWhatCannotBeAChain)
{
  const SizingFunction length = [](const Vec3&) { return ballLength; };
  const auto network = [&](const std::vector<Curve>& curves) { return curveNetwork(curves, length); };
  const auto through = [](const std::vector<Vec3>& points) { return Curve{ "curve", "curve.vtp", points, {} }; };
  EXPECT_THROW(network({ through({ { 0, 0, 0 } }) }), InputError);
  EXPECT_THROW(network({ through({ { 1, 1, 1 }, { 1, 1, 1 } }) }), InputError);
  EXPECT_THROW(network({ through({ { -5, 0, 0 }, { 5, 0, 0 }, { 5, 5, 0 }, { 0, 5, 0 }, { 0, -5, 0 } }) }), InputError);
  EXPECT_THROW(network({ straight(), through({ { 0, -5, 0.4 }, { 0, 5, 0.4 } }) }), InputError);
  for (const auto& outside : { through({ { 0, 0, 7 }, { 0, 0, 20 } }), through({ { 30, 0, 0 }, { 40, 0, 0 } }) })
  {
    TetMesh mesh = nestedBalls();
    EXPECT_THROW(insertCurves(mesh, network({ outside }), length), InputError);
    EXPECT_EQ(mesh.tetrahedra, nestedBalls().tetrahedra);
  }
}

} // namespace surgicalmesher
