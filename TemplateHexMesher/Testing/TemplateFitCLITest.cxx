// SPDX-License-Identifier: Apache-2.0
#include "ElementMeshIO.h"
#include "ElementQuality.h"
#include "ExecutableTest.h"
#include "Slab.h"

#include <vtkCellData.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointSet.h>
#include <vtkUnstructuredGrid.h>

#include <sstream>

using namespace surgicalmesher;
using namespace surgicalmesher::test;

namespace
{

std::string deckOf(const ElementMesh& mesh)
{
  std::ostringstream text;
  text.precision(12);
  text << "*NODE\n";
  for (Eigen::Index i = 0; i < mesh.points.cols(); ++i)
    text << i + 1 << ", " << mesh.points(0, i) << ", " << mesh.points(1, i) << ", " << mesh.points(2, i) << "\n";
  text << "*ELEMENT, TYPE=C3D8, ELSET=skin\n";
  for (std::size_t e = 0; e < mesh.elements.size(); ++e)
  {
    text << e + 1;
    for (const std::int32_t node : mesh.elements[e].nodes) text << ", " << node + 1;
    text << "\n";
  }
  return text.str();
}

std::string markupsOf(const Points& points, const std::string& prefix = "L")
{
  std::ostringstream text;
  text.precision(12);
  text << "# CoordinateSystem = LPS\n# columns = label,x,y,z\n";
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    text << prefix << i << "," << points(0, i) << "," << points(1, i) << "," << points(2, i) << "\n";
  return text.str();
}

/// A slab, the same slab bent as its target in metres, and landmarks of both.
class TemplateFitCLI : public ExecutableTest
{
protected:
  TemplateFitCLI() : ExecutableTest(TEMPLATEFITCLI) {}

  void SetUp() override
  {
    const Points truth = bent(mesh.points);
    const LandmarkPairs pairs = everyNth(mesh.points, truth, 5);
    folder.write("template.inp", deckOf(mesh));
    folder.write("target.inp", deckOf({ 0.001 * truth, mesh.elements }));
    folder.write("a.fcsv", markupsOf(pairs.source));
    folder.write("b.fcsv", markupsOf(0.001 * pairs.target));
  }

  /// That landmarks for which the patient's are replaced by these are refused.
  void expectLandmarksRefused(const std::string& content, const std::string& expected) const
  {
    folder.write("bad.fcsv", content);
    expectRefused("--targetUnit m --landmarks a.fcsv --landmarks bad.fcsv template.inp target.inp f.vtu", 1, expected);
  }

  const ElementMesh mesh = slab(6, 5, 1);
};

} // namespace

TEST_F(TemplateFitCLI, WritesTheFittedMeshWhatItCarriesAndTheReport)
{
  folder.write("muscle.obj", "v 0 0 4\nv 20 0 4\nv 0 20 4\nf 1 2 3\n");
  expectDone(
    "--targetUnit m --landmarks a.fcsv,b.fcsv --carry muscle.obj --report r.json template.inp target.inp f.inp");
  EXPECT_EQ(folder.files(), (std::vector<std::string>{ "a.fcsv", "b.fcsv", "f.inp", "f.muscle.vtu", "muscle.obj",
                                                       "r.json", "target.inp", "template.inp" }));
  const ElementMesh fitted = readElementMesh(folder.file("f.inp")).mesh;
  ASSERT_EQ(fitted.elements.size(), mesh.elements.size());
  EXPECT_EQ(summaryOf(fitted, elementQuality(fitted), ElementShape::Hexahedron).invalid, 0u);
  EXPECT_LT((1000 * fitted.points - bent(mesh.points)).colwise().norm().maxCoeff(), 4);
  const ElementMesh muscle = readElementMesh(folder.file("f.muscle.vtu")).mesh;
  Points before(3, 3);
  before << 0, 20, 0, 0, 0, 20, 4, 4, 4;
  EXPECT_LT((1000 * muscle.points - bent(before)).colwise().norm().maxCoeff(), 4);
  EXPECT_NE(readBytes(folder.file("r.json")).find("\"invalid\": 0"), std::string::npos);
}

TEST_F(TemplateFitCLI, ExportsMillimetresAndTheSetsOfTheTemplate)
{
  folder.write("named.inp", deckOf(mesh) + "*NSET, NSET=corner\n1, 2\n");
  expectDone("--targetUnit m --landmarks a.fcsv,b.fcsv --export e.inp --export e.msh2 named.inp target.inp f.vtu");
  const ElementMesh fitted = readElementMesh(folder.file("f.vtu")).mesh;
  const ElementMesh exported = readElementMesh(folder.file("e.inp")).mesh;
  EXPECT_LT((1000 * fitted.points - exported.points).colwise().norm().maxCoeff(), 1e-6);
  const std::string deck = readBytes(folder.file("e.inp"));
  for (const char* expected : { "*NSET, NSET=corner\n1, 2\n", "*ELSET, ELSET=skin\n" })
    EXPECT_NE(deck.find(expected), std::string::npos) << expected;
  expectDone("--landmarks a.fcsv,b.fcsv --targetUnit m --units si --nodeMarkups a.fcsv --export s.inp template.inp "
             "target.inp g.vtu");
  const ElementMesh inMetres = readElementMesh(folder.file("s.inp")).mesh;
  EXPECT_LT((fitted.points - inMetres.points).colwise().norm().maxCoeff(), 1e-9);
  EXPECT_NE(readBytes(folder.file("s.inp")).find("*NSET, NSET=a\n"), std::string::npos);
}

TEST_F(TemplateFitCLI, WarnsOfTissuesThatTheMaterialsLeaveOut)
{
  vtkNew<vtkIntArray> labels;
  labels->SetName("TissueLabel");
  const ElementMeshFile content = readElementMesh(folder.file("template.inp"));
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) labels->InsertNextValue(e % 2 == 0 ? 1 : 2);
  content.data->GetCellData()->AddArray(labels);
  writeElementMesh(content, mesh.points, "template.inp", folder.file("two.vtu"));
  folder.write("materials.csv", "tissue, youngsModulus, poissonsRatio\n1, 6, 0.4\n");
  const Outcome result =
    run("--targetUnit m --landmarks a.fcsv,b.fcsv --materials materials.csv --export e.inp two.vtu target.inp f.vtu");
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_NE(result.err.find("materials.csv: no row for 1 of 2 tissues"), std::string::npos) << result.err;
}

TEST_F(TemplateFitCLI, RefusesLandmarksAtFault)
{
  const LandmarkPairs pairs = everyNth(mesh.points, 0.001 * bent(mesh.points), 5);
  Points points = pairs.target;
  expectLandmarksRefused(markupsOf(points, "M"), "no landmark \"L0\"");
  expectLandmarksRefused("# columns = label,x,y,z\n", "bad.fcsv");
  points.row(0) *= -1;
  expectLandmarksRefused(markupsOf(points), "mirror");
  points = pairs.target.colwise() + Eigen::Vector3d(1, 0, 0); // of a patient a metre away
  expectLandmarksRefused(markupsOf(points), "mm from target.inp");
  points = pairs.target.colwise() - pairs.target.col(0);
  for (Eigen::Index i = 0; i < points.cols(); ++i) points.col(i) = Eigen::Vector3d(1, 1, 0) * double(i);
  expectLandmarksRefused(markupsOf(points), "line");
  folder.write("a.fcsv", markupsOf(pairs.source.leftCols(3)));
  expectLandmarksRefused(markupsOf(pairs.target.leftCols(3)), "four");
}

TEST_F(TemplateFitCLI, RefusesMeshesAtFault)
{
  const std::string start = "--targetUnit m --landmarks a.fcsv,b.fcsv ";
  ElementMesh turned = mesh;
  turned.points.row(1) *= -1;
  folder.write("turned.inp", deckOf(turned));
  expectRefused(start + "turned.inp target.inp f.vtu", 1, "turned.inp: 30 of 30 hexahedra are inside out");
  expectRefused(start + "missing.vtu target.inp f.vtu", 1, "missing.vtu");
  expectRefused(start + "template.inp missing.stl f.vtu", 1, "missing.stl");
  expectRefused(start + "--inner missing.stl template.inp target.inp f.vtu", 1, "missing.stl");
  expectRefused(start + "--carry missing.stl template.inp target.inp f.vtu", 1, "missing.stl");
}

TEST_F(TemplateFitCLI, RefusesCommandLinesAtFault)
{
  const std::string meshes = "template.inp target.inp ";
  expectRefused("--landmarks a.fcsv " + meshes + "f.vtu", 2, "--landmarks");
  expectRefused(meshes + "f.vtu", 2, "--landmarks");
  expectRefused("--landmarks a.fcsv,b.fcsv " + meshes + "f.vtu", 1, "units");
  expectRefused("--targetUnit m --landmarks a.fcsv,b.fcsv " + meshes + "f.vtp", 2, "f.vtp");
  const std::string carrying = "--targetUnit m --landmarks a.fcsv,b.fcsv --carry muscle.obj ";
  expectRefused(carrying + "--export f.muscle.vtu " + meshes + "f.vtu", 2, "'f.muscle.vtu' is an output of --export");
  expectRefused(carrying + "--carry muscle.stl " + meshes + "f.vtu", 2, "'f.muscle.vtu' is an output of --carry");
  expectRefused("--targetUnit inch --landmarks a.fcsv,b.fcsv " + meshes + "f.vtu", 2, "targetUnit");
}
