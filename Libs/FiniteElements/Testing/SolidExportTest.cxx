// SPDX-License-Identifier: Apache-2.0
#include "../../Libs/TissueMap/Testing/TestFiles.h"
#include "Errors.h"
#include "Export.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <set>
#include <sstream>

namespace surgicalmesher
{
namespace
{

/// Three unit cubes in a row along x, the last cut into two wedges; the first cube has tissue 1, the rest tissue 2.
SolidMesh row()
{
  SolidMesh mesh;
  for (int i = 0; i < 4; ++i)
  {
    for (int j = 0; j < 4; ++j) mesh.points.push_back({ double(i), double(j == 1 || j == 2), double(j >= 2) });
  }
  const auto cube = [](std::int32_t i) {
    return std::array<std::int32_t, 4>{ 4 * i, 4 * i + 1, 4 * i + 2, 4 * i + 3 };
  };
  for (std::int32_t i = 0; i < 3; ++i)
  {
    const auto a = cube(i), b = cube(i + 1);
    if (i < 2) mesh.elements.push_back({ a[0], a[1], a[2], a[3], b[0], b[1], b[2], b[3] });
    else
      mesh.elements.insert(mesh.elements.end(),
                           { { a[0], b[1], a[1], a[3], b[2], a[2] }, { a[0], b[0], b[1], a[3], b[3], b[2] } });
  }
  mesh.labels = { 1, 2, 2, 2 };
  mesh.tissues[1].name = "skin";
  mesh.tissues[2].name = "muscle";
  mesh.elementSets["deep"] = { 1, 2 };
  mesh.nodeSets["end"] = { 0, 1, 2, 3 };
  mesh.nodeSets["corner"] = { 5 };
  return mesh;
}

const SurfaceSet& surface(const FiniteElementModel& model, const std::string& name)
{
  for (const SurfaceSet& set : model.surfaces)
  {
    if (set.name == name) return set;
  }
  throw std::out_of_range(name);
}

/// Each edge as often in one direction as in the other.
bool isClosed(const std::vector<Cell>& faces)
{
  std::map<std::pair<std::int32_t, std::int32_t>, int> balance;
  for (const Cell& face : faces)
  {
    for (std::size_t i = 0; i < face.size(); ++i)
    {
      const std::int32_t a = face[i], b = face[(i + 1) % face.size()];
      balance[std::minmax(a, b)] += a < b ? 1 : -1;
    }
  }
  return std::all_of(balance.begin(), balance.end(), [](const auto& edge) { return edge.second == 0; });
}

double enclosedVolume(const std::vector<Vec3>& p, const std::vector<Cell>& faces)
{
  double volume = 0;
  for (const Cell& f : faces)
  {
    for (std::size_t i = 2; i < f.size(); ++i) volume += dot(p[f[0]], cross(p[f[i - 1]], p[f[i]])) / 6;
  }
  return volume;
}

std::string written(const std::string& name, const FiniteElementModel& model)
{
  const test::TemporaryFolder folder;
  exportModel(model, folder.file(name));
  return test::readBytes(folder.file(name));
}

std::string written(const std::string& name) { return written(name, finiteElementModel(row())); }

/// The part of a text between two others.
std::string between(const std::string& text, const std::string& from, const std::string& to)
{
  const std::size_t begin = text.find(from);
  if (begin == text.npos) throw std::out_of_range(from);
  return text.substr(begin + from.size(), text.find(to, begin + from.size()) - begin - from.size());
}

} // namespace

TEST(SolidModel, SurfacesAreClosedAndWoundOutwards)
{
  const SolidMesh mesh = row();
  const FiniteElementModel model = finiteElementModel(mesh);
  const std::vector<Cell> outer = surface(model, "outer_boundary").cells;
  EXPECT_EQ(outer.size(), 16u);
  EXPECT_TRUE(isClosed(outer));
  EXPECT_NEAR(enclosedVolume(mesh.points, outer), 3, 1e-12);
  std::vector<Cell> skin = surface(model, "skin_to_outside").cells;
  const std::vector<Cell> inside = surface(model, "skin_to_muscle").cells;
  ASSERT_EQ(inside.size(), 1u);
  EXPECT_EQ(inside[0], turnedRound(surface(model, "muscle_to_skin").cells[0]));
  skin.push_back(inside[0]);
  EXPECT_NEAR(enclosedVolume(mesh.points, skin), 1, 1e-12);
}

TEST(SolidModel, KeepsTheSetsOfTheMesh)
{
  const FiniteElementModel model = finiteElementModel(row());
  EXPECT_EQ(surface(model, "end_faces").cells, (std::vector<Cell>{ { 0, 3, 2, 1 } }));
  EXPECT_EQ(surface(model, "end_faces").nodeSet, "end");
  EXPECT_THROW(surface(model, "corner_faces"), std::out_of_range);
  std::map<std::string, std::vector<std::int32_t>> elements, nodes;
  for (const ElementSet& set : model.elementSets) elements[set.name] = set.elements;
  for (const NodeSet& set : model.nodeSets) nodes[set.name] = set.points;
  EXPECT_EQ(elements.at("deep"), (std::vector<std::int32_t>{ 1, 2 }));
  EXPECT_EQ(elements.at("muscle"), (std::vector<std::int32_t>{ 1, 2, 3 }));
  EXPECT_EQ(nodes.at("corner"), std::vector<std::int32_t>{ 5 });
}

TEST(SolidModel, AFaceOfThreeElementsIsRefused)
{
  SolidMesh mesh = row();
  mesh.elements.push_back(mesh.elements[0]);
  mesh.labels.push_back(1);
  mesh.elements.push_back(mesh.elements[0]);
  mesh.labels.push_back(1);
  EXPECT_THROW(finiteElementModel(mesh), InputError);
}

TEST(SolidExport, AbaqusHasTypesAndNumbersOfFaces)
{
  const std::string deck = written("m.inp");
  EXPECT_EQ(between(deck, "TYPE=C3D8, ELSET=all_elements\n", "*"),
            "1, 1, 2, 3, 4, 5, 6, 7, 8\n2, 5, 6, 7, 8, 9, 10, 11, 12\n");
  EXPECT_EQ(between(deck, "TYPE=C3D6, ELSET=all_elements\n", "*"),
            "3, 9, 14, 10, 12, 15, 11\n4, 9, 13, 14, 12, 16, 15\n");
  // S1 and S2 of a C3D8 have the corners 1-2-3-4 and 5-8-7-6, S3 1-5-6-2 (CalculiX's manual).
  EXPECT_EQ(between(deck, "*SURFACE, NAME=end_faces, TYPE=ELEMENT\n", "*"), "1, S1\n");
  EXPECT_EQ(between(deck, "*SURFACE, NAME=skin_to_muscle, TYPE=ELEMENT\n", "*"), "1, S2\n");
  EXPECT_EQ(between(deck, "*SURFACE, NAME=muscle_to_skin, TYPE=ELEMENT\n", "*"), "2, S1\n");
}

TEST(SolidExport, FebioDividesAPartOfSeveralShapes)
{
  const std::string text = written("m.feb");
  for (const char* part :
       { "type=\"hex8\" name=\"skin\"", "type=\"hex8\" name=\"muscle_hex8\"", "type=\"penta6\" name=\"muscle_penta6\"",
         "<SolidDomain name=\"muscle_penta6\"", "<ElementSet name=\"muscle\">", "<quad4 id=\"1\">1,4,3,2</quad4>" })
    EXPECT_NE(text.find(part), std::string::npos) << part;
}

TEST(SolidExport, FebioDividesAShellOfSeveralShapes)
{
  FiniteElementOptions options;
  options.shells = { { 2, -1, 0.5 } };
  const std::string text = written("m.feb", finiteElementModel(row(), options));
  const auto rowsOf = [&](const std::string& type)
  { return between(text, "<Elements type=\"" + type + "\" name=\"muscle_shell_" + type + "\">\n", "    </Elements>"); };
  const std::string triangles = rowsOf("tri3"), quads = rowsOf("quad4");
  EXPECT_EQ(std::count(triangles.begin(), triangles.end(), '\n'), 4);
  EXPECT_EQ(std::count(triangles.begin(), triangles.end(), ','), 4 * 2);
  EXPECT_EQ(std::count(quads.begin(), quads.end(), '\n'), 8);
  EXPECT_EQ(std::count(quads.begin(), quads.end(), ','), 8 * 3);
  EXPECT_EQ(text.find("name=\"muscle_shell\" mat"), std::string::npos);
  for (const char* name : { "<ShellDomain name=\"muscle_shell_tri3\"", "<ShellDomain name=\"muscle_shell_quad4\"",
                            "<ElementSet name=\"muscle_shell\">" })
    EXPECT_NE(text.find(name), std::string::npos) << name;
}

TEST(SolidExport, GmshHasTheNodesThatNoElementUses)
{
  SolidMesh mesh = row();
  mesh.points.push_back({ 9, 9, 9 });
  const std::string nodes = between(written("m.msh", finiteElementModel(mesh)), "$Nodes\n", "$EndNodes");
  std::istringstream numbers(nodes);
  std::size_t blocks = 0, count = 0, first = 0, last = 0, read = 0;
  numbers >> blocks >> count >> first >> last;
  EXPECT_EQ(count, 17u);
  for (std::size_t b = 0; b < blocks; ++b)
  {
    std::size_t dimension = 0, entity = 0, parametric = 0, size = 0;
    double skipped = 0;
    numbers >> dimension >> entity >> parametric >> size;
    EXPECT_LE(entity, 4u);
    for (std::size_t n = 0; n < 4 * size; ++n) numbers >> skipped; // tags, then coordinates
    read += size;
  }
  EXPECT_EQ(read, 17u);
}

TEST(SolidExport, GmshAndMeditHaveAllShapes)
{
  const std::string gmsh = written("m.msh2"), medit = written("m.mesh");
  EXPECT_NE(gmsh.find("\n1 5 2 1 1 1 2 3 4 5 6 7 8\n"), std::string::npos);
  EXPECT_NE(gmsh.find("\n3 6 2 2 2 9 14 10 12 15 11\n"), std::string::npos);
  EXPECT_EQ(between(medit, "Hexahedra\n", "\n\n"), "2\n 1 2 3 4 5 6 7 8 1\n 5 6 7 8 9 10 11 12 2");
  EXPECT_EQ(between(medit, "Triangles\n", "\n"), "4");
  EXPECT_EQ(between(medit, "Quadrilaterals\n", "\n"), "13");
}

TEST(SolidExport, LsDynaHasPartsOfOneShape)
{
  const std::string deck = written("m.k");
  // A wedge: a quadrilateral, then the edge opposite to it, each of its nodes twice (LS-DYNA's manual).
  EXPECT_EQ(between(deck, "*ELEMENT_SOLID\n", "*"),
            "       1       1       1       2       3       4       5       6       7       8\n"
            "       2       2       5       6       7       8       9      10      11      12\n"
            "       3       3      14       9      12      15      10      10      11      11\n"
            "       4       3      13       9      12      16      14      14      15      15\n");
  EXPECT_EQ(between(deck, "*PART\nmuscle_penta6\n", "*MAT"),
            "         3         3         1\n*SECTION_SOLID\n         3        15\n");
  EXPECT_EQ(between(deck, "*SET_SEGMENT_TITLE\nend_faces\n         6\n", "*"),
            "         1         4         3         2\n");
}

TEST(SolidExport, AnsysRepeatsNodesOfWedges)
{
  const std::string archive = written("m.cdb");
  EXPECT_NE(archive.find("ET,1,185\n"), std::string::npos);
  const std::string elements = between(archive, "EBLOCK,19,SOLID,4,4\n(19i9)\n", "       -1\n");
  std::istringstream numbers(elements);
  const std::vector<int> found{ std::istream_iterator<int>(numbers), {} };
  ASSERT_EQ(found.size(), 4u * 19);
  EXPECT_EQ(std::vector<int>(found.begin() + 2 * 19 + 11, found.begin() + 3 * 19),
            (std::vector<int>{ 9, 14, 10, 10, 12, 15, 11, 11 }));
  EXPECT_EQ(found[8], 8);
  EXPECT_EQ(between(archive, "CMBLOCK,end,NODE,         4\n(8i10)\n", "FINISH"),
            "         1         2         3         4\n");
}

TEST(SolidExport, SurfacesAreClosedTriangles)
{
  const test::TemporaryFolder folder;
  exportModel(finiteElementModel(row()), folder.file("m.ply"));
  for (const char* name : { "m.ply", "m.skin.ply", "m.muscle.ply" })
  {
    const auto triangles = readSurface(folder.file(name)).surface.triangles;
    EXPECT_TRUE(isClosed({ triangles.begin(), triangles.end() })) << name;
  }
}

TEST(SolidExport, EveryFormatButThatOfTetrahedraIsWritten)
{
  for (const ExportFormat& format : exportFormats())
  {
    if (format.extension == ".simnibs.msh") EXPECT_THROW(written("m" + format.extension), UsageError);
    else EXPECT_GT(written("m" + format.extension).size(), 100u);
  }
  EXPECT_NE(written("m.xdmf").find("TopologyType=\"Mixed\" NumberOfElements=\"4\""), std::string::npos);
  EXPECT_NE(written("m.vtk").find("CELL_TYPES 4\n12\n12\n13\n13"), std::string::npos);
}

} // namespace surgicalmesher
