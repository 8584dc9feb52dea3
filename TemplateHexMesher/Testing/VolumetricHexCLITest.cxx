// SPDX-License-Identifier: Apache-2.0
#include "ElementMeshIO.h"
#include "ElementQuality.h"
#include "ExecutableTest.h"
#include "SlabEnvelope.h"

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkPointSet.h>

#include <algorithm>
#include <sstream>

using namespace surgicalmesher;
using namespace surgicalmesher::test;

namespace
{

/// A surface as legacy VTK text, with its sides if there are any.
std::string textOf(const TriangleSurface& surface, const std::vector<Side>& sides = {})
{
  std::ostringstream text;
  text.precision(12);
  text << "# vtk DataFile Version 3.0\nslab\nASCII\nDATASET POLYDATA\nPOINTS " << surface.points.cols() << " double\n";
  for (Eigen::Index i = 0; i < surface.points.cols(); ++i) text << surface.points.col(i).transpose() << "\n";
  text << "POLYGONS " << surface.triangles.size() << " " << 4 * surface.triangles.size() << "\n";
  for (const Triangle& t : surface.triangles) text << "3 " << t[0] << " " << t[1] << " " << t[2] << "\n";
  if (sides.empty()) return text.str();
  text << "CELL_DATA " << sides.size() << "\nSCALARS Side int 1\nLOOKUP_TABLE default\n";
  for (const Side side : sides) text << int(side) << "\n";
  return text.str();
}

/// A bar of tissue within the slab.
TriangleSurface bar()
{
  ElementMesh mesh = slab(10, 8, 2);
  for (auto row : { 0, 1 }) mesh.points.row(row) *= 0.4;
  mesh.points.row(2).array() = 0.4 * (mesh.points.row(2).array() - 5) + 5;
  return outerSurface(mesh);
}

class VolumetricHexCLI : public ExecutableTest
{
protected:
  VolumetricHexCLI() : ExecutableTest(VOLUMETRICHEXCLI) {}

  void SetUp() override
  {
    folder.write("envelope.vtk", textOf(envelope.surface));
    folder.write("sides.vtk", textOf(envelope.surface, envelope.sides));
    folder.write("bar.vtk", textOf(bar()));
  }

  const Envelope envelope = slabEnvelope(true);
  const std::string coarse = "--divisions 20,4,16 --edgeLength 5 ";
};

} // namespace

TEST_F(VolumetricHexCLI, WritesHexahedraWithTheirPartsAndTheReport)
{
  expectDone(coarse + "--parts bar.vtk --report r.json envelope.vtk sides.vtk mesh.vtu");
  const ElementMeshFile content = readElementMesh(folder.file("mesh.vtu"));
  EXPECT_EQ(summaryOf(content.mesh, elementQuality(content.mesh), ElementShape::Hexahedron).invalid, 0u);
  vtkDataArray* labels = content.data->GetCellData()->GetArray("TissueLabel");
  ASSERT_TRUE(labels);
  double volume = 0;
  for (std::size_t e = 0; e < content.mesh.elements.size(); ++e)
  {
    if (labels->GetTuple1(vtkIdType(e)) == 2) volume += volumeOf(content.mesh.elements[e], content.mesh.points);
  }
  EXPECT_NEAR(volume, 40 * 32 * 4, 0.05 * 40 * 32 * 4);
  const std::string report = readBytes(folder.file("r.json"));
  for (const char* expected : { "\"invalid\": 0", "\"histogramOfMinimum\"", "\"name\": \"bar\"", "\"recall\"" })
    EXPECT_NE(report.find(expected), std::string::npos) << expected;
}

TEST_F(VolumetricHexCLI, ExportsTissuesLayersAndSides)
{
  folder.write("materials.csv", "tissue, youngsModulus, poissonsRatio\nfiller, 3, 0.45\nbar, 6, 0.4\n");
  expectDone(coarse + "--parts bar.vtk --materials materials.csv --export m.inp envelope.vtk sides.vtk m.vtu");
  const std::string deck = readBytes(folder.file("m.inp"));
  for (const char* expected :
       { "*ELEMENT, TYPE=C3D8, ELSET=all_elements\n", "*ELSET, ELSET=filler\n", "*ELSET, ELSET=bar\n",
         "*ELSET, ELSET=layer_3\n", "*NSET, NSET=inner\n", "*SURFACE, NAME=inner_faces, TYPE=ELEMENT\n",
         "*SOLID SECTION, ELSET=bar, MATERIAL=material_bar_linear_elastic\n" })
    EXPECT_NE(deck.find(expected), std::string::npos) << expected;
  EXPECT_NE(readBytes(folder.file("m.inp.names.json")).find("\"inner_faces\""), std::string::npos);
  expectRefused(coarse + "--export n.xyz envelope.vtk sides.vtk n.vtu", 2, "n.xyz");
  expectRefused(coarse + "--parts bar.vtk --materials bar.vtk --export n.inp envelope.vtk sides.vtk n.vtu", 1,
                "bar.vtk");
}

TEST_F(VolumetricHexCLI, WarnsOfTissuesThatTheMaterialsLeaveOut)
{
  folder.write("materials.csv", "tissue, youngsModulus, poissonsRatio\nbar, 6, 0.4\n");
  const Outcome result =
    run(coarse + "--parts bar.vtk --materials materials.csv --export m.inp envelope.vtk sides.vtk m.vtu");
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_NE(result.err.find("materials.csv: no row for 1 of 2 tissues"), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("filler"), std::string::npos) << result.err;
}

TEST_F(VolumetricHexCLI, TakesMaterialsOfAPartThatEndsWithoutElements)
{
  TriangleSurface thin = bar();
  thin.points *= 0.01;
  thin.points.row(0).array() += 30; // beside the hole
  folder.write("thin.vtk", textOf(thin));
  folder.write("materials.csv", "tissue, youngsModulus, poissonsRatio\nfiller, 3, 0.45\nthin, 6, 0.4\n");
  const Outcome result =
    run(coarse + "--parts thin.vtk --materials materials.csv --export m.inp envelope.vtk sides.vtk m.vtu");
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_NE(result.err.find("thin.vtk: no element is this part's"), std::string::npos) << result.err;
  folder.write("odd.csv", "tissue, youngsModulus, poissonsRatio\nbone, 3, 0.45\n");
  expectRefused(coarse + "--parts thin.vtk --materials odd.csv --export n.inp envelope.vtk sides.vtk n.vtu", 1,
                "odd.csv:2: \"bone\" is neither a label nor the name of a tissue");
}

TEST_F(VolumetricHexCLI, ExportsMetresAndSetsOfNodes)
{
  expectDone(coarse + "--nodeSet 'far: plane 0 0 0 -1 0 0' --export mm.inp envelope.vtk sides.vtk m.vtu");
  expectDone(coarse + "--nodeSet 'far: plane 0 0 0 -1 0 0' --units si --export si.inp envelope.vtk sides.vtk m.vtu");
  const ElementMesh mm = readElementMesh(folder.file("mm.inp")).mesh, si = readElementMesh(folder.file("si.inp")).mesh;
  EXPECT_LT((mm.points - 1000 * si.points).colwise().norm().maxCoeff(), 1e-9);
  const std::string text = readBytes(folder.file("si.inp"));
  EXPECT_NE(text.find("NSET=far"), std::string::npos);
  EXPECT_NE(text.find("m, N, Pa, kg, s"), std::string::npos);
  const std::string files = "envelope.vtk sides.vtk n.vtu";
  expectRefused(coarse + "--nodeSet 'far: plane 0 0 0 -1 0 0' " + files, 2, "no --export");
  expectRefused(coarse + "--materials m.csv " + files, 2, "no --export");
  expectRefused(coarse + "--nodeSet 'far: cone' --export n.inp " + files, 2, "far: cone");
  expectRefused(coarse + "--nodeSet 'right: plane 0 0 0 -1 0 0' --export n.inp " + files, 1,
                "right: the mesh has a set of nodes of this name");
  expectRefused(coarse + "--nodeMarkups none.mrk.json --export n.inp " + files, 1, "none.mrk.json");
}

TEST_F(VolumetricHexCLI, WritesTheSameBytesWithOneThreadAndTwo)
{
  expectDone(coarse + "--parts bar.vtk --threads 1 envelope.vtk sides.vtk a.vtu");
  expectDone(coarse + "--parts bar.vtk --threads 2 envelope.vtk sides.vtk b.vtu");
  EXPECT_EQ(readBytes(folder.file("a.vtu")), readBytes(folder.file("b.vtu")));
}

TEST_F(VolumetricHexCLI, RefusesSurfacesAtFault)
{
  TriangleSurface open = envelope.surface;
  open.triangles.pop_back();
  folder.write("open.vtk", textOf(open));
  std::vector<Side> sides = envelope.sides;
  std::replace(sides.begin(), sides.end(), Side::Top, Side::Hole);
  folder.write("topless.vtk", textOf(envelope.surface, sides));
  sides[0] = Side(9);
  folder.write("odd.vtk", textOf(envelope.surface, sides));
  TriangleSurface openBar = bar(), farBar = bar();
  openBar.triangles.pop_back();
  farBar.points.row(0).array() += 1000;
  folder.write("openBar.vtk", textOf(openBar));
  folder.write("farBar.vtk", textOf(farBar));
  expectRefused(coarse + "open.vtk sides.vtk m.vtu", 1, "open.vtk: ");
  expectRefused(coarse + "envelope.vtk envelope.vtk m.vtu", 1, "envelope.vtk: no cell array Side");
  expectRefused(coarse + "envelope.vtk topless.vtk m.vtu", 1,
                "topless.vtk: no triangle of the envelope is on the side 6");
  expectRefused(coarse + "envelope.vtk odd.vtk m.vtu", 1, "odd.vtk: Side of cell 0");
  expectRefused(coarse + "missing.vtp sides.vtk m.vtu", 1, "missing.vtp");
  expectRefused(coarse + "--parts openBar.vtk envelope.vtk sides.vtk m.vtu", 1, "openBar.vtk: 3 open edges");
  expectRefused(coarse + "--parts farBar.vtk envelope.vtk sides.vtk m.vtu", 1, "farBar.vtk: outside all elements");
}

TEST_F(VolumetricHexCLI, RefusesCommandLinesAtFault)
{
  const std::string files = " envelope.vtk sides.vtk m.vtu";
  expectRefused("--divisions 20,4" + files, 2, "--divisions: 2 numbers found, expected three");
  expectRefused("--divisions 20,0,16" + files, 2, "--divisions");
  expectRefused("--divisions 20,4,16 --layers 5" + files, 2, "expected at least 5, the --layers");
  expectRefused(coarse + "--parts bar.vtk --cutOff 1" + files, 2, "--cutOff: a number out of range");
  expectRefused(coarse + "--parts bar.vtk --cutOff 0.5,0.5" + files, 2, "--cutOff: 2 numbers found, expected one");
  expectRefused(coarse + "--parts bar.vtk --parts bar.vtk" + files, 2, "--parts: two parts would be named bar");
  expectRefused(coarse + "envelope.vtk sides.vtk m.stl", 2, "m.stl");
}
