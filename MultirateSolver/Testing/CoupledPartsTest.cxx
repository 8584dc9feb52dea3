// SPDX-License-Identifier: Apache-2.0
#include "CoupledParts.h"
#include "ConstitutiveTags.h"
#include "DividedBox.h"
#include "Errors.h"

#include <gtest/gtest.h>

#include <algorithm>

using namespace surgicalmesher;
using namespace surgicalmesher::test;

namespace
{

std::string refusalOf(const MeshFile& parent, const MeshFile& child)
{
  try
  {
    coupledMesh(parent, child, {});
  }
  catch (const InputError& error)
  {
    return error.what();
  }
  return "";
}

} // namespace

TEST(CoupledParts, JoinsTheTwoFilesToOneMesh)
{
  const DividedBox box = dividedBox(2);
  const CoupledMesh mesh = coupledMesh(box.parent, box.child, {});
  EXPECT_EQ(mesh.children, 2);
  EXPECT_EQ(mesh.whole.mesh.points.size(), 10u * 6 * 6);
  EXPECT_EQ(mesh.whole.mesh.tetrahedra.size(), 9u * 5 * 5 * 6);
  EXPECT_EQ(std::count(mesh.part.begin(), mesh.part.end(), 1), 27 * 6); // the larger one comes first
  EXPECT_EQ(std::count(mesh.part.begin(), mesh.part.end(), 2), 18 * 6);
  const auto held = std::count(mesh.whole.unknowns.begin(), mesh.whole.unknowns.end(), -1);
  EXPECT_EQ(held, 10 * 6); // the lowest layer
  EXPECT_EQ(mesh.whole.freePoints, 10 * 6 * 5);
}

TEST(CoupledParts, HoldsNullDisplacementAndNothingElse)
{
  DividedBox box = dividedBox(1);
  box.parent.constitutive.assign(box.parent.mesh.tetrahedra.size(), kLinear);
  box.parent.constitutive[0] = kNullDisplacement;
  const CoupledMesh mesh = coupledMesh(box.parent, box.child, {});
  EXPECT_EQ(std::count(mesh.whole.unknowns.begin(), mesh.whole.unknowns.end(), -1), 4);
}

TEST(CoupledParts, TissuesHaveTheirMaterials)
{
  const DividedBox box = dividedBox(1);
  TissueMaterial stiff;
  stiff.youngsModulus = 1;
  stiff.poissonsRatio = 0;
  EXPECT_DOUBLE_EQ(coupledMesh(box.parent, box.child, { { 1, stiff } }).whole.lame.front().mu, 0.5);
  EXPECT_DOUBLE_EQ(coupledMesh(box.parent, box.child, {}).whole.lame.front().mu, 0.003 / 2.9);
}

TEST(CoupledParts, ChildAndWhatIsAroundItShareTheInterfaceInOneOrder)
{
  const DividedBox box = dividedBox(1);
  const CoupledMesh mesh = coupledMesh(box.parent, box.child, {});
  const Part child = partOf(mesh, { false, true }), around = partOf(mesh, { true, false });
  const Interface interface = interfaceOf(child, around);
  ASSERT_EQ(interface.first.size(), 3u * (4 * 4 * 4 - 2 * 2 * 2));
  ASSERT_EQ(interface.second.size(), interface.first.size());
  for (std::size_t k = 0; k < interface.first.size(); k += 3)
  {
    const auto pointOf = [](const Part& part, std::int32_t unknown)
    {
      const auto& unknowns = part.body.unknowns;
      return part.points[std::size_t(std::find(unknowns.begin(), unknowns.end(), unknown / 3) - unknowns.begin())];
    };
    EXPECT_EQ(pointOf(child, interface.first[k]), pointOf(around, interface.second[k]));
  }
}

TEST(CoupledParts, RefusesWhatAreNoPartsOfOneMesh)
{
  const DividedBox box = dividedBox(1);
  DividedBox other = box;
  other.child.volumePointId.clear();
  EXPECT_NE(refusalOf(other.parent, other.child).find("child's points have no VolumePointId"), std::string::npos);
  other = box;
  for (std::int32_t& id : other.child.volumePointId) id += 100000;
  EXPECT_NE(refusalOf(other.parent, other.child).find("share no point"), std::string::npos);
  other = box;
  other.child.volumePointId[1] = other.child.volumePointId[0];
  EXPECT_NE(refusalOf(other.parent, other.child).find("stands twice in the child"), std::string::npos);
  other = box;
  for (Vec3& point : other.child.mesh.points) point.x += 1;
  EXPECT_NE(refusalOf(other.parent, other.child).find("expected the two parts of one mesh"), std::string::npos);
}
