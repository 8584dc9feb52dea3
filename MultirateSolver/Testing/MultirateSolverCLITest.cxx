// SPDX-License-Identifier: Apache-2.0
#include "DividedBox.h"
#include "ExecutableTest.h"

#include <rapidjson/document.h>

using namespace surgicalmesher;
using namespace surgicalmesher::test;

namespace
{

class MultirateSolverCLI : public ExecutableTest
{
protected:
  MultirateSolverCLI() : ExecutableTest(MULTIRATESOLVERCLI) {}

  void SetUp() override
  {
    const DividedBox box = dividedBox(1);
    writeMesh(box.parent, folder.file("parent.vtu"));
    writeMesh(box.child, folder.file("child.vtu"));
    folder.write("tool.csv", "seconds,x,y,z\n0,6,8,8\n0.1,8,8,8\n");
  }
};

} // namespace

TEST_F(MultirateSolverCLI, WritesForcesMotionAndReport)
{
  expectDone("--tool tool.csv --forces f.csv --motion m.pvd --report r.json --displacedParent p.vtu "
             "--returnparameterfile v.txt parent.vtu child.vtu c.vtu");
  EXPECT_EQ(folder.files(),
            (std::vector<std::string>{ "c.vtu", "child.vtu", "f.csv", "m.pvd", "m_0000.vtu", "m_0001.vtu", "m_0002.vtu",
                                       "m_0003.vtu", "p.vtu", "parent.vtu", "r.json", "tool.csv", "v.txt" }));
  const std::string forces = readBytes(folder.file("f.csv"));
  EXPECT_EQ(std::count(forces.begin(), forces.end(), '\n'), 52);
  rapidjson::Document report;
  report.Parse(readBytes(folder.file("r.json")).c_str());
  ASSERT_TRUE(report.IsObject());
  EXPECT_EQ(report["steps"].GetInt(), 51);
  EXPECT_EQ(report["wholeUnknowns"].GetInt(), 3 * 10 * 6 * 5);
  EXPECT_EQ(report["children"][0]["interfaceUnknowns"].GetInt(), 3 * 56);
  EXPECT_NE(readBytes(folder.file("v.txt")).find("medianStep = "), std::string::npos);
  EXPECT_NE(readBytes(folder.file("m.pvd")).find("timestep=\"0.04\" file=\"m_0001.vtu\""), std::string::npos);
}

TEST_F(MultirateSolverCLI, TheSameInputGivesTheSameBytes)
{
  expectDone("--tool tool.csv --forces f.csv parent.vtu child.vtu c.vtu");
  expectDone("--tool tool.csv --forces g.csv parent.vtu child.vtu d.vtu");
  EXPECT_EQ(readBytes(folder.file("c.vtu")), readBytes(folder.file("d.vtu")));
  EXPECT_EQ(readBytes(folder.file("f.csv")), readBytes(folder.file("g.csv")));
}

TEST_F(MultirateSolverCLI, WarnsWhereTheTableOrTheMeshSaysLinear)
{
  folder.write("linear.csv", "tissue,model,youngsModulus,poissonsRatio\n1,linear,3,0.45\n");
  folder.write("other.csv", "tissue,model,youngsModulus,poissonsRatio\n1,neo-Hookean,3,0.45\n");
  DividedBox box = dividedBox(1);
  box.child.constitutive.assign(box.child.mesh.tetrahedra.size(), kLinear);
  writeMesh(box.child, folder.file("linear.vtu"));
  box.child.constitutive.front() = kNonlinear;
  writeMesh(box.child, folder.file("tagged.vtu"));
  const auto isWarnedOf = [&](const std::string& arguments)
  {
    EXPECT_EQ(run("--report r.json " + arguments + " c.vtu").status, 0) << arguments;
    return readBytes(folder.file("r.json")).find("are linear by --materials or Constitutive") != std::string::npos;
  };
  EXPECT_TRUE(isWarnedOf("--law neo-Hookean --materials linear.csv parent.vtu child.vtu"));
  EXPECT_TRUE(isWarnedOf("--law neo-Hookean parent.vtu tagged.vtu"));
  EXPECT_FALSE(isWarnedOf("--law neo-Hookean --materials other.csv parent.vtu child.vtu"));
  EXPECT_FALSE(isWarnedOf("--law neo-Hookean parent.vtu linear.vtu"));
  EXPECT_FALSE(isWarnedOf("--materials linear.csv parent.vtu tagged.vtu"));
}

TEST_F(MultirateSolverCLI, RefusesBadInput)
{
  folder.write("far.csv", "seconds,x,y,z\n0,600,8,8\n1,601,8,8\n");
  folder.write("one.csv", "seconds,x,y,z\n0,6,8,8\n");
  folder.write("nanoseconds.csv", "seconds,x,y,z\n0,6,8,8\n1.7e18,7,8,8\n");
  expectRefused("--tool nanoseconds.csv parent.vtu child.vtu c.vtu", 1,
                "expected at most 1e+07; are their times in seconds?");
  folder.write("materials.csv", "tissue,youngsModulus,poissonsRatio\n9,1,0.4\n");
  expectRefused("--tool far.csv parent.vtu child.vtu c.vtu", 1, "tool 1 at (600, 8, 8) mm");
  expectRefused("--tool one.csv --motion m.pvd parent.vtu child.vtu c.vtu", 1, "one.csv: 1 rows, expected");
  expectRefused("--tool tool.csv --tool tool.csv parent.vtu child.vtu c.vtu", 1, "tool 2");
  expectRefused("--materials materials.csv parent.vtu child.vtu c.vtu", 1, "tissue 9 is not in the mesh");
  expectRefused("--weight 1,2 parent.vtu child.vtu c.vtu", 2, "--weight: expected three numbers");
  expectRefused("--childRate 500 --parentRate 30 parent.vtu child.vtu c.vtu", 2,
                "expected the child's to be a multiple");
  expectRefused("parent.vtu tool.csv c.vtu", 1, "tool.csv");
  expectRefused("parent.vtu child.vtu child.vtu", 2, "child.vtu");
  folder.write("small.vtu", readBytes(folder.file("child.vtu")).substr(0, 400));
  expectRefused("parent.vtu small.vtu c.vtu", 1, "small.vtu");
}

TEST_F(MultirateSolverCLI, RefusesPartsThatAreEachOthers)
{
  DividedBox box = dividedBox(1);
  box.parent.subMesh.assign(box.parent.mesh.tetrahedra.size(), 0);
  box.child.subMesh.assign(box.child.mesh.tetrahedra.size(), 1);
  writeMesh(box.parent, folder.file("outer.vtu"));
  writeMesh(box.child, folder.file("inner.vtu"));
  expectDone("--tool tool.csv outer.vtu inner.vtu c.vtu");
  expectRefused("--tool tool.csv inner.vtu outer.vtu d.vtu", 1, "inner.vtu: all tetrahedra are a child's");
  expectRefused("--tool tool.csv outer.vtu outer.vtu d.vtu", 1, "outer.vtu: all tetrahedra are the parent's");
}

TEST_F(MultirateSolverCLI, LeavesNothingWhenKilled)
{
  folder.write("long.csv", "seconds,x,y,z\n0,6,8,8\n2000,8,8,8\n");
  expectLeavesNothingWhenKilled("--tool long.csv --motion m.pvd parent.vtu child.vtu c.vtu", "stepping");
}
