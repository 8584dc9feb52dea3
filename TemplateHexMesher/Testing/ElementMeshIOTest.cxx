// SPDX-License-Identifier: Apache-2.0
#include "ElementMeshIO.h"

#include "Errors.h"
#include "ExecutableTest.h"
#include "Slab.h"
#include "SolverMeshText.h"

#include <vtkCellData.h>
#include <vtkPointData.h>
#include <vtkPointSet.h>

using namespace surgicalmesher;
using namespace surgicalmesher::test;

namespace
{

/// A brick, and a wedge on one of its sides.
const char* const deck = "*HEADING\n*NODE, NSET=every\n"
                         "11, 0, 0, 0\n12, 1, 0, 0\n13, 1, 1, 0\n14, 0, 1, 0\n"
                         "21, 0, 0, 1\n22, 1, 0, 1\n23, 1, 1, 1\n24, 0, 1, 1\n"
                         "** a comment\n15, 2., 0.5, 0\n25, 2., 0.5, 1\n"
                         "*ELEMENT, TYPE=C3D8R, ELSET=bricks\n5, 11, 12, 13, 14, 21, 22,\n23, 24\n"
                         "*ELEMENT, TYPE=C3D6, ELSET=wedges\n7, 12, 15, 13, 22, 25, 23\n"
                         "*ELSET, ELSET=all\nbricks, wedges\n*NSET, NSET=base, GENERATE\n11, 15, 1\n"
                         "*MATERIAL, NAME=soft\n*ELASTIC\n0.01, 0.4\n";

const char* const nodeList = "       1  0.000000000000      0.00000000000     0.00000000000    \n"
                             "       2  1.000000000000    \n"
                             "       3  1.000000000000      1.00000000000    \n"
                             "       4  0.000000000000      1.00000000000    \n"
                             "5\t0\t0\t1\n6\t1\t0\t1\n7\t1\t1\t1\n8\t0\t1\t1\n";

std::string refusalOf(const std::string& file)
{
  try
  {
    readElementMesh(file);
  }
  catch (const InputError& error)
  {
    return error.what();
  }
  return "accepted";
}

void expectRefused(const std::string& name, const std::string& content, const std::string& expected)
{
  const TemporaryFolder folder;
  const std::string refusal = refusalOf(folder.write(name, content));
  EXPECT_NE(refusal.find(name), std::string::npos) << refusal;
  EXPECT_NE(refusal.find(expected), std::string::npos) << refusal;
}

void expectSameCells(const ElementMesh& a, const ElementMesh& b)
{
  ASSERT_EQ(a.elements.size(), b.elements.size());
  for (std::size_t e = 0; e < a.elements.size(); ++e)
  {
    EXPECT_EQ(a.elements[e].shape, b.elements[e].shape);
    EXPECT_EQ(a.elements[e].nodes, b.elements[e].nodes);
  }
}

} // namespace

TEST(ElementMeshIO, NamesOfAbaqusSetsAreTheSameInUpperAndLowerCase)
{
  const TemporaryFolder folder;
  const std::string more = "*NSET, NSET=BASE\n25\n*NSET, NSET=held\nBase, 24\n";
  const ElementMeshFile content = readElementMesh(folder.write("a.inp", deck + more));
  EXPECT_EQ(content.data->GetPointData()->GetArray("BASE"), nullptr);
  for (const auto& [set, members] : { std::pair{ "base", 6 }, std::pair{ "held", 7 } }) // 11 to 15 and 25; and 24
  {
    vtkDataArray* isMember = content.data->GetPointData()->GetArray(set);
    ASSERT_NE(isMember, nullptr) << set;
    int count = 0;
    for (vtkIdType p = 0; p < isMember->GetNumberOfTuples(); ++p) count += isMember->GetComponent(p, 0) != 0;
    EXPECT_EQ(count, members) << set;
  }
}

TEST(ElementMeshIO, ReadsAbaqusDecksWithTheirIdsAndSets)
{
  const TemporaryFolder folder;
  const ElementMeshFile content = readElementMesh(folder.write("a.inp", deck));
  ASSERT_EQ(content.mesh.elements.size(), 2u);
  EXPECT_EQ(content.mesh.elements[0].shape, ElementShape::Hexahedron);
  EXPECT_EQ(content.mesh.elements[1].shape, ElementShape::Wedge);
  EXPECT_NEAR(volumeOf(content.mesh.elements[0], content.mesh.points), 1, 1e-12);
  EXPECT_NEAR(volumeOf(content.mesh.elements[1], content.mesh.points), 0.5, 1e-12);
  EXPECT_EQ(outerFaces(content.mesh.elements).size(), 5u + 4u);
  EXPECT_EQ(content.data->GetPointData()->GetArray("NodeId")->GetComponent(9, 0), 25);
  EXPECT_EQ(content.data->GetCellData()->GetArray("ElementId")->GetComponent(1, 0), 7);
  EXPECT_EQ(content.data->GetCellData()->GetArray("wedges")->GetComponent(0, 0), 0);
  EXPECT_EQ(content.data->GetCellData()->GetArray("all")->GetComponent(0, 0), 1);
  EXPECT_EQ(content.data->GetPointData()->GetArray("base")->GetComponent(8, 0), 1);
  EXPECT_EQ(content.data->GetPointData()->GetArray("base")->GetComponent(4, 0), 0);
}

TEST(ElementMeshIO, ReadsAnsysListsInColumnsAndWithTabs)
{
  const TemporaryFolder folder;
  folder.write("a.node", nodeList);
  folder.write("a.elem", "     1     2     3     4     5     6     7     8     1     1     1     0     0     9\n");
  const ElementMeshFile content = readElementMesh(folder.file("a.elem"));
  ASSERT_EQ(content.mesh.elements.size(), 1u);
  EXPECT_NEAR(volumeOf(content.mesh.elements[0], content.mesh.points), 1, 1e-12);
  EXPECT_EQ(content.data->GetCellData()->GetArray("ElementId")->GetComponent(0, 0), 9);
  folder.write("a.elem", "     1     2     3     3     5     6     7     7     1     1     1     0     0     9\n");
  EXPECT_EQ(readElementMesh(folder.file("a.node")).mesh.elements[0].shape, ElementShape::Wedge);
  folder.write("a.elem", "     1     2     3     4     5     5     5     5     1     1     1     0     0     9\n");
  EXPECT_NE(refusalOf(folder.file("a.node")).find("a.elem:1"), std::string::npos);
}

TEST(ElementMeshIO, ChangesNothingButTheCoordinates)
{
  const TemporaryFolder folder;
  const std::string source = folder.write("a.inp", deck);
  const ElementMeshFile content = readElementMesh(source);
  const Points moved = (content.mesh.points * 2).colwise() + Eigen::Vector3d(1, 2, 3);
  for (const char* name : { "b.vtu", "b.inp" })
  {
    writeElementMesh(content, moved, source, folder.file(name));
    const ElementMeshFile again = readElementMesh(folder.file(name));
    EXPECT_LT((again.mesh.points - moved).cwiseAbs().maxCoeff(), 1e-9) << name;
    expectSameCells(content.mesh, again.mesh);
    EXPECT_EQ(again.data->GetCellData()->GetArray("ElementId")->GetComponent(1, 0), 7);
    EXPECT_EQ(again.data->GetCellData()->GetArray("wedges")->GetComponent(1, 0), 1);
  }
  EXPECT_NE(readBytes(folder.file("b.inp")).find("*ELASTIC\n0.01, 0.4"), std::string::npos);
  EXPECT_THROW(requireWritable(content, source, folder.file("b.vtp")), UsageError);
  EXPECT_THROW(requireWritable(content, source, folder.file("b.stl")), UsageError);
}

TEST(ElementMeshIO, KeepsWhatFollowsTheCoordinatesOfAnAnsysNode)
{
  const TemporaryFolder folder;
  const std::string blank(20, ' ');
  const std::string source = folder.write(
    "a.node", "       1" + blank + blank + blank + "        30.5        0\n" + // zeros omitted, then angles
                "2 1 0 0 31.5 0 -2\n3 1 1 0\n4 0 1 0\n5 0 0 1\n6 1 0 1\n7 1 1 1\n8\t0\t1\t1\t32.5\n");
  folder.write("a.elem", "1 2 3 4 5 6 7 8 1 1 1 0 0 9\n");
  const ElementMeshFile content = readElementMesh(source);
  EXPECT_EQ(content.mesh.points.col(0).norm(), 0);
  const Points moved = content.mesh.points.array() + 0.25;
  writeElementMesh(content, moved, source, folder.file("b.node"));
  const std::string text = readBytes(folder.file("b.node"));
  for (const char* rest : { "0.25        30.5        0\n", " 0.25 31.5 0 -2\n", "1.25\t32.5\n" })
    EXPECT_NE(text.find(rest), std::string::npos) << text;
  folder.write("b.elem", readBytes(folder.file("a.elem")));
  EXPECT_EQ(readElementMesh(folder.file("b.node")).mesh.points, moved);
}

TEST(ElementMeshIO, GeneratedSetsHaveTheIdsThatExist)
{
  const TemporaryFolder folder;
  const ElementMeshFile content =
    readElementMesh(folder.write("a.inp", std::string(deck) + "*NSET, NSET=odd, GENERATE\n13, 2000000001, 2\n"));
  vtkDataArray* odd = content.data->GetPointData()->GetArray("odd");
  ASSERT_NE(odd, nullptr);
  int count = 0;
  for (vtkIdType p = 0; p < odd->GetNumberOfTuples(); ++p) count += odd->GetComponent(p, 0) != 0;
  EXPECT_EQ(count, 5); // 13, 15, 21, 23, 25
}

TEST(ElementMeshIO, KeepsThePointsOfAnObjInTheirOrder)
{
  const TemporaryFolder folder;
  const std::string file =
    folder.write("a.obj", "v 0 0 0\nv 1 0 0\nvt 0 0\nvt 1 1\nv 1 1 0\nv 0 1 0\nf 1/1 2/2 3/1 4/2\nf -4 -3 -2\n");
  const ElementMeshFile content = readElementMesh(file);
  EXPECT_EQ(content.mesh.points.cols(), 4);
  ASSERT_EQ(content.mesh.elements.size(), 2u);
  EXPECT_EQ(content.mesh.elements[0].shape, ElementShape::Quad);
  EXPECT_EQ(content.mesh.elements[1].nodes[2], 2);
  EXPECT_EQ(readSurfaceOf(file).triangles.size(), 3u);
}

TEST(ElementMeshIO, MakesOneOfThePointsThatAnStlRepeats)
{
  const TemporaryFolder folder;
  const auto facet = [](const char* a, const char* b, const char* c)
  {
    return std::string("facet normal 0 0 1\nouter loop\nvertex ") + a + "\nvertex " + b + "\nvertex " + c +
           "\nendloop\nendfacet\n";
  };
  const std::string content =
    "solid s\n" + facet("0 0 0", "1 0 0", "1 1 0") + facet("0 0 0", "1 1 0", "0 1 0") + "endsolid\n";
  const TriangleSurface surface = readSurfaceOf(folder.write("a.stl", content));
  EXPECT_EQ(surface.points.cols(), 4);
  EXPECT_EQ(surface.triangles.size(), 2u);
}

TEST(ElementMeshIO, RefusesFilesAtFault)
{
  expectRefused("a.inp", "*NODE\n1, 0, 0, 0\n1, 1, 0, 0\n", "stands twice");
  expectRefused("a.inp", "*NODE\n1, 0, zero, 0\n", "coordinates");
  expectRefused("a.inp", "*NODE\n1, 0, 0, 0\n*ELEMENT, TYPE=C3D10\n", "C3D8");
  expectRefused("a.inp", "*NODE\n1, 0, 0, 0\n*ELEMENT, TYPE=S3\n1, 1, 2, 3\n", "node 2 is not there");
  expectRefused("a.inp", "*NODE\n1, 0, 0, 0\n*ELEMENT, TYPE=S3\n1, 1, 1\n", "all its nodes");
  expectRefused("a.inp", "*NODE\n1, 0, 0, 0\n*ELEMENT, TYPE=S3\n1, 1, 1\n*ELSET, ELSET=a\n1\n",
                "element 1 has 2 of its 3 nodes");
  expectRefused("a.inp", "*NODE\n1, 0, 0, 0\n", "no element");
  expectRefused("a.inp", "*Node, System=c\n1, 0, 0, 0\n", "a.inp:1: \"*Node, System=c\", expected rectangular");
  expectRefused("a.inp", "*SYSTEM\n1, 0, 0\n*NODE\n1, 0, 0, 0\n", "a.inp:2: \"1, 0, 0\", expected nodes in the global");
  expectRefused("a.inp", "*NSET, NSET=a, GENERATE\n5, 2000000000\n*NODE\n1, 0, 0, 0\n*ELEMENT, TYPE=S3\n1, 1, 1, 1\n",
                "set a has no member from 5 to 2000000000");
  expectRefused("a.inp", "", "no point");
  expectRefused("a.obj", "v 0 0\n", "three coordinates");
  expectRefused("a.obj", "v 0 0 0\nf 1 2 3\n", "points");
  const TemporaryFolder folder;
  EXPECT_NE(refusalOf(folder.write("a.node", nodeList)).find("a.elem"), std::string::npos);
  expectRefused("a.vtu", "not a mesh", "a.vtu");
  expectRefused("a.vtp", "", "a.vtp");
  expectRefused("a.xyz", "1", ".vtu");
}

TEST(ElementMeshIO, RefusesAMeshThatIsInsideOut)
{
  ElementMesh mesh = slab();
  EXPECT_NO_THROW(requireRightSideOut(mesh, "a.vtu"));
  mesh.points.row(0) *= -1;
  EXPECT_THROW(requireRightSideOut(mesh, "a.vtu"), InputError);
}
