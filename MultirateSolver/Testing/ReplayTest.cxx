// SPDX-License-Identifier: Apache-2.0
#include "Replay.h"
#include "DividedBox.h"
#include "Errors.h"
#include "Grasp.h"
#include "WholeSolution.h"

#include <gtest/gtest.h>

using namespace surgicalmesher;
using namespace surgicalmesher::test;

namespace
{

const Vec3 kFirstTip{ 6, 6, 6 }, kSecondTip{ 26, 6, 6 }; ///< points inside the two children

ToolPath tool(const Vec3& from, const Vec3& motion, double end = 0.4)
{
  return { { 0, 0.1, end }, { from, from + motion, from + motion } };
}

ReplayOptions options(ChildLaw law)
{
  ReplayOptions result;
  result.law = law;
  result.childRate = 100;
  result.parentRate = 50;
  result.toolRadius = 4.5; // of points 4 mm apart, moved a little by the weight
  result.toolStiffness = 0.02;
  result.tolerance = 1e-10;
  return result;
}

std::int32_t pointAt(const CoupledMesh& mesh, const Vec3& place)
{
  for (std::size_t p = 0; p < mesh.whole.mesh.points.size(); ++p)
    if (norm(mesh.whole.mesh.points[p] - place) < 1e-9) return std::int32_t(p);
  return -1;
}

/// What the tool at `tip` does to the whole: a spring at each of its points in the child, from where they were at rest.
void addSprings(const CoupledMesh& mesh, const WholeSolution& atRest, const Vec3& tip, const Vec3& motion,
                const ReplayOptions& options, std::vector<PointSpring>& springs)
{
  std::vector<std::int32_t> held;
  for (std::size_t p = 0; p < mesh.whole.mesh.points.size(); ++p)
    if (norm(mesh.whole.mesh.points[p] + atRest.at(p) - tip) <= options.toolRadius) held.push_back(std::int32_t(p));
  for (const std::int32_t p : held)
    springs.push_back({ p, options.toolStiffness / double(held.size()), motion + atRest.at(std::size_t(p)) });
}

struct Pull
{
  Vec3 tip, motion;
};

/// How far linear children, drawn at so, end from where they are in the whole mesh.
double errorOfChildren(const DividedBox& box, const std::vector<Pull>& pulls, double end = 0.4)
{
  const CoupledMesh mesh = coupledMesh(box.parent, box.child, {});
  const ReplayOptions setting = options(ChildLaw::Linear);
  WholeSolution whole(mesh, setting.weight, 0);
  whole.solve({});
  std::vector<ToolPath> tools;
  std::vector<PointSpring> springs;
  for (const auto& [tip, motion] : pulls)
  {
    tools.push_back(tool(tip, motion, end));
    addSprings(mesh, whole, tip, motion, setting, springs);
  }
  whole.solve(springs);
  return whole.errorOf(replay(mesh, tools, setting).displacements);
}

std::string refusalOf(const std::vector<ToolPath>& tools, const ReplayOptions& options, int children = 1)
{
  const DividedBox box = dividedBox(children);
  try
  {
    replay(coupledMesh(box.parent, box.child, {}), tools, options);
  }
  catch (const Error& error)
  {
    return error.what();
  }
  return "";
}

} // namespace

TEST(Replay, ALinearChildMovesAsInTheWholeMesh)
{
  const DividedBox box = dividedBox(1);
  const CoupledMesh mesh = coupledMesh(box.parent, box.child, {});
  ASSERT_GE(pointAt(mesh, kFirstTip), 0);
  const ReplayOptions setting = options(ChildLaw::Linear);
  const Vec3 motion{ 2, 1, -1 };
  const ReplayResult result = replay(mesh, { tool(kFirstTip, motion) }, setting);
  WholeSolution whole(mesh, setting.weight, 0);
  whole.solve({});
  std::vector<PointSpring> springs;
  addSprings(mesh, whole, kFirstTip, motion, setting, springs);
  ASSERT_EQ(springs.size(), 7u);
  whole.solve(springs);
  EXPECT_LT(whole.errorOf(result.displacements), 1e-8);
  Vec3 force{ 0, 0, 0 };
  for (const PointSpring& spring : springs)
    force += spring.stiffness * (spring.pull - whole.at(std::size_t(spring.point)));
  EXPECT_LT(norm(result.steps.back().force - force), 1e-8 * norm(force));
  EXPECT_EQ(result.steps.size(), 41u);
  EXPECT_LT(norm(result.steps.front().force), 1e-12); // taken hold of at rest
}

TEST(Replay, ANeoHookeanChildMovesAsInTheWholeMesh)
{
  const DividedBox box = dividedBox(1);
  const CoupledMesh mesh = coupledMesh(box.parent, box.child, {});
  const ReplayOptions setting = options(ChildLaw::NeoHookean);
  const Vec3 motion{ 4, 2, -3 };
  const ReplayResult result = replay(mesh, { tool(kFirstTip, motion) }, setting);
  WholeSolution whole(mesh, setting.weight, 1), linear(mesh, setting.weight, 0);
  whole.solve({});
  linear.solve({});
  std::vector<PointSpring> springs;
  addSprings(mesh, whole, kFirstTip, motion, setting, springs);
  whole.solve(springs);
  linear.solve(springs);
  EXPECT_LT(whole.errorOf(result.displacements), 1e-6);
  EXPECT_GT(linear.errorOf(result.displacements), 1e-3); // or the law would not matter here
}

TEST(Replay, TwoChildrenWithAToolEachMoveAsInTheWholeMesh)
{
  EXPECT_LT(errorOfChildren(dividedBox(2), { { kSecondTip, { -3, 0, 1 } }, { kFirstTip, { 2, 1, -1 } } }), 1e-8);
}

TEST(Replay, AChildWithoutAToolFollowsTheOther)
{
  EXPECT_LT(errorOfChildren(dividedBox(2), { { kFirstTip, { 2, 1, -1 } } }), 1e-8);
}

TEST(Replay, ThreeToolsAtASlenderBodyMoveItAsInTheWholeMesh)
{
  const Vec3 first{ 2, 2, 38 }, second{ 14, 2, 38 }, third{ 2, 14, 38 }, motion{ 3, 0, 0 };
  EXPECT_LT(errorOfChildren(dividedColumn(), { { first, motion }, { second, motion }, { third, motion } }, 2), 1e-6);
}

TEST(Replay, AToolTakesHoldOfPointsWhereTheyAreAtRest)
{
  const DividedBox box = dividedBox(1);
  const CoupledMesh mesh = coupledMesh(box.parent, box.child, {});
  ReplayOptions setting = options(ChildLaw::Linear);
  setting.weight = { 4e-5, 0, 0 };
  setting.toolRadius = 0.01;
  setting.reach = 0.5;
  WholeSolution whole(mesh, setting.weight, 0);
  whole.solve({});
  const Vec3 moved = whole.at(std::size_t(pointAt(mesh, kFirstTip))), tip = kFirstTip + moved, motion{ 0, 0, 1 };
  ASSERT_GT(norm(moved), setting.reach);
  std::vector<PointSpring> springs;
  addSprings(mesh, whole, tip, motion, setting, springs);
  ASSERT_EQ(springs.size(), 1u);
  whole.solve(springs);
  EXPECT_LT(whole.errorOf(replay(mesh, { tool(tip, motion) }, setting).displacements), 1e-8);
}

TEST(Replay, AChildMayGoRightAcrossTheBody)
{
  EXPECT_LT(errorOfChildren(dividedBar(), { { { 22, 2, 6 }, { 0, 2, 1 } } }), 1e-8);
}

TEST(Replay, WithoutAToolTheMeshHangsAtRest)
{
  const DividedBox box = dividedBox(1);
  const CoupledMesh mesh = coupledMesh(box.parent, box.child, {});
  const ReplayOptions setting = options(ChildLaw::NeoHookean);
  WholeSolution whole(mesh, setting.weight, 1);
  whole.solve({});
  EXPECT_LT(whole.errorOf(replay(mesh, {}, setting).displacements), 1e-6);
}

TEST(Replay, TellsTheFramesOfTheParentsRate)
{
  const DividedBox box = dividedBox(1);
  const CoupledMesh mesh = coupledMesh(box.parent, box.child, {});
  std::vector<double> seconds;
  replay(mesh, { tool(kFirstTip, { 1, 0, 0 }) }, options(ChildLaw::Linear),
         [&](double s, const std::vector<Vec3>& displacements)
         {
           seconds.push_back(s);
           EXPECT_EQ(displacements.size(), mesh.whole.mesh.points.size());
         });
  ASSERT_EQ(seconds.size(), 21u);
  EXPECT_NEAR(seconds[1], 0.02, 1e-12);
}

TEST(Replay, BeginsAtTheFirstTimeOfTheRecording)
{
  const DividedBox box = dividedBox(1);
  const CoupledMesh mesh = coupledMesh(box.parent, box.child, {});
  const ToolPath early = tool(kFirstTip, { 1, 0, 0 });
  const auto expected = replay(mesh, { early }, options(ChildLaw::Linear)).steps;
  for (const double begin :
       { -1.0, 10.0, 1764500000.0, 1764500000.123, 1764500000.457 }) // of a clock that counts from 1970
  {
    ToolPath late = early;
    for (double& seconds : late.seconds) seconds += begin;
    const auto found = replay(mesh, { late }, options(ChildLaw::Linear)).steps;
    ASSERT_EQ(found.size(), expected.size());
    EXPECT_EQ(found.front().seconds, begin);
    EXPECT_LT(norm(found.back().force - expected.back().force), 1e-6 * norm(expected.back().force));
  }
}

TEST(Replay, CanBeCancelled)
{
  const DividedBox box = dividedBox(1);
  const CoupledMesh mesh = coupledMesh(box.parent, box.child, {});
  const auto cancel = [](double fraction, const std::string&)
  {
    if (fraction > 0.6) throw std::runtime_error("cancelled");
  };
  EXPECT_THROW(replay(mesh, { tool(kFirstTip, { 1, 0, 0 }) }, options(ChildLaw::Linear), {}, cancel),
               std::runtime_error);
}

TEST(Replay, RefusesToolsAndRatesThatDoNotFit)
{
  const ReplayOptions setting = options(ChildLaw::Linear);
  EXPECT_NE(
    refusalOf({ tool({ 500, 0, 0 }, { 1, 0, 0 }) }, setting).find("tool 1 at (500, 0, 0) mm is not within 5 mm"),
    std::string::npos);
  EXPECT_NE(refusalOf({ tool(kFirstTip, { 1, 0, 0 }), tool(kFirstTip, { 1, 0, 0 }) }, setting).find("tool 2"),
            std::string::npos);
  ReplayOptions uneven = setting;
  uneven.parentRate = 30;
  EXPECT_NE(refusalOf({}, uneven).find("expected the child's to be a multiple of the parent's"), std::string::npos);
}

TEST(Surroundings, RefuseAPieceThatHangsOnNothing)
{
  DividedBox box = dividedBox(1);
  TetMesh& mesh = box.parent.mesh;
  const auto base = std::int32_t(mesh.points.size());
  const Vec3 far{ 200, 200, 200 };
  for (const Vec3& corner : { Vec3{ 0, 0, 0 }, Vec3{ 1, 0, 0 }, Vec3{ 0, 1, 0 }, Vec3{ 0, 0, 1 } })
  {
    mesh.points.push_back(far + corner);
    box.parent.volumePointId.push_back(10000 + std::int32_t(mesh.points.size()));
  }
  mesh.tetrahedra.push_back({ base, base + 1, base + 2, base + 3 });
  mesh.labels.push_back(1);
  EXPECT_THROW(replay(coupledMesh(box.parent, box.child, {}), {}, options(ChildLaw::Linear)), InputError);
}
