// SPDX-License-Identifier: Apache-2.0
#include "Export.h"

#include "../../Libs/TissueMap/Testing/TestFiles.h"
#include "Errors.h"
#include "LabelledBlocks.h"
#include "VtkExport.h"

#include <gtest/gtest.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLUtilities.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <sstream>

namespace surgicalmesher
{
namespace
{

using Ids = std::vector<std::int32_t>;
using Numbers = std::vector<double>;

/// Numbers with anything else between them.
Numbers numbersIn(std::string text)
{
  for (char& c : text) c = c == ',' ? ' ' : c;
  std::istringstream stream(text);
  Numbers numbers;
  for (double number; stream >> number;) numbers.push_back(number);
  return numbers;
}

/// Ids that count from 1, as they count from 0.
Ids idsIn(const std::string& text)
{
  Ids ids;
  for (const double number : numbersIn(text)) ids.push_back(static_cast<std::int32_t>(number) - 1);
  return ids;
}

/// A model with all there is: several materials, shells, null displacement.
FiniteElementModel richModel()
{
  MeshFile content = test::randomBlocks(2);
  content.mesh.points[0].x += 1e-7; // digits to keep
  FiniteElementOptions options;
  options.materials[1] = { MaterialLaw::NeoHookean, 0.004, 0.4, 1.1e-9 };
  options.shells = { { 1, -1, 0.5 }, { 2, 0, 0.75 } };
  return finiteElementModel(content, options);
}

/// The cards of an input deck: keyword line and data lines.
struct Card
{
  std::string keyword; ///< "ELEMENT"
  std::map<std::string, std::string> parameters;
  std::vector<std::string> lines;

  std::string data() const
  {
    std::string text;
    for (const std::string& line : lines) text += line + "\n";
    return text;
  }
};

std::vector<Card> cardsOf(const std::string& deck)
{
  std::vector<Card> cards;
  std::istringstream stream(deck);
  for (std::string line; std::getline(stream, line);)
  {
    EXPECT_LE(line.size(), 256u);
    if (line[0] != '*')
    {
      cards.back().lines.push_back(line);
      continue;
    }
    std::istringstream fields(line.substr(1));
    cards.emplace_back();
    std::getline(fields, cards.back().keyword, ',');
    for (std::string field; std::getline(fields, field, ',');)
    {
      const std::size_t equals = field.find('=');
      cards.back().parameters[field.substr(1, equals - 1)] = equals == field.npos ? "" : field.substr(equals + 1);
    }
  }
  return cards;
}

std::string written(const FiniteElementModel& model, const std::string& name)
{
  const test::TemporaryFolder folder;
  exportModel(model, folder.file(name));
  return test::readBytes(folder.file(name));
}

/// The corners of faces S1 to S4 of a C3D4 element, counted from 1 (CalculiX's manual).
constexpr int kAbaqusFaces[4][3] = { { 1, 2, 3 }, { 1, 4, 2 }, { 2, 4, 3 }, { 3, 4, 1 } };

class AbaqusDeck : public testing::Test
{
protected:
  AbaqusDeck() : model(richModel()), cards(cardsOf(written(model, "m.inp"))) {}

  /// The only card with this keyword whose parameter has this value.
  const Card& card(const std::string& keyword, const std::string& parameter, const std::string& value) const
  {
    const Card* found = nullptr;
    for (const Card& candidate : cards)
    {
      const auto entry = candidate.parameters.find(parameter);
      if (candidate.keyword != keyword || entry == candidate.parameters.end() || entry->second != value) continue;
      EXPECT_EQ(found, nullptr) << keyword << " " << value << " is there twice";
      found = &candidate;
    }
    if (!found) throw std::out_of_range(keyword + " " + value);
    return *found;
  }

  FiniteElementModel model;
  std::vector<Card> cards;
};

TEST_F(AbaqusDeck, HasThePointsAndTetrahedra)
{
  const TetMesh& mesh = model.content.mesh;
  const Card& nodes = card("NODE", "NSET", "all_nodes");
  ASSERT_EQ(nodes.lines.size(), mesh.points.size());
  for (std::size_t i = 0; i < mesh.points.size(); ++i)
  {
    const Vec3& p = mesh.points[i];
    EXPECT_EQ(numbersIn(nodes.lines[i]), (Numbers{ double(i + 1), p.x, p.y, p.z }));
  }
  const Card& elements = card("ELEMENT", "TYPE", "C3D4");
  ASSERT_EQ(elements.lines.size(), mesh.tetrahedra.size());
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t)
  {
    const auto& [a, b, c, d] = mesh.tetrahedra[t];
    EXPECT_EQ(idsIn(elements.lines[t]), (Ids{ std::int32_t(t), a, b, c, d }));
  }
}

TEST_F(AbaqusDeck, HasTheSets)
{
  for (const ElementSet& set : model.elementSets)
    EXPECT_EQ(idsIn(card("ELSET", "ELSET", set.name).data()), set.elements);
  for (const NodeSet& set : model.nodeSets) EXPECT_EQ(idsIn(card("NSET", "NSET", set.name).data()), set.points);
  for (const SurfaceSet& set : model.surfaces)
  {
    const Card& surface = card("SURFACE", "NAME", set.name);
    ASSERT_EQ(surface.lines.size(), set.cells.size());
    for (std::size_t i = 0; i < surface.lines.size(); ++i)
    {
      const std::size_t comma = surface.lines[i].find(", S");
      const auto& ids = model.content.mesh.tetrahedra.at(std::stoul(surface.lines[i].substr(0, comma)) - 1);
      std::set<std::int32_t> corners;
      for (const int corner : kAbaqusFaces[surface.lines[i].at(comma + 3) - '1']) corners.insert(ids[corner - 1]);
      EXPECT_EQ(corners, std::set<std::int32_t>(set.cells[i].begin(), set.cells[i].end()));
    }
  }
}

TEST_F(AbaqusDeck, GivesEveryElementOneMaterial)
{
  std::vector<int> count(model.content.mesh.tetrahedra.size(), 0);
  for (const Card& section : cards)
  {
    if (section.keyword != "SOLID SECTION") continue;
    for (const std::int32_t t : idsIn(card("ELSET", "ELSET", section.parameters.at("ELSET")).data())) ++count.at(t);
    card("MATERIAL", "NAME", section.parameters.at("MATERIAL"));
  }
  EXPECT_EQ(count, std::vector<int>(count.size(), 1));
}

TEST_F(AbaqusDeck, MaterialsHaveTheModuliOfTheTable)
{
  std::map<std::string, Card> laws, densities;
  std::string name;
  for (const Card& entry : cards)
  {
    if (entry.keyword == "MATERIAL") name = entry.parameters.at("NAME");
    if (entry.keyword == "ELASTIC" || entry.keyword == "HYPERELASTIC") laws[name] = entry;
    if (entry.keyword == "DENSITY") densities[name] = entry;
  }
  ASSERT_EQ(laws.size(), model.materials.size());
  for (const Material& material : model.materials)
  {
    const Numbers values = numbersIn(laws.at(material.name).data());
    ASSERT_EQ(values.size(), 2u);
    double young = values[0], poisson = values[1];
    if (laws.at(material.name).keyword == "HYPERELASTIC")
    {
      const double shear = 2 * values[0], bulk = 2 / values[1];
      young = 9 * bulk * shear / (3 * bulk + shear);
      poisson = (3 * bulk - 2 * shear) / (2 * (3 * bulk + shear));
    }
    EXPECT_EQ(laws.at(material.name).keyword == "HYPERELASTIC", material.law == MaterialLaw::NeoHookean);
    EXPECT_NEAR(young, material.youngsModulus, 1e-10 * young);
    EXPECT_NEAR(poisson, material.poissonsRatio, 1e-10);
    EXPECT_EQ(numbersIn(densities.at(material.name).data()), Numbers{ material.density });
  }
}

TEST_F(AbaqusDeck, ShellsShareTheNodes)
{
  auto next = static_cast<std::int32_t>(model.content.mesh.tetrahedra.size());
  for (const Shell& shell : model.shells)
  {
    const Card& elements = card("ELEMENT", "ELSET", shell.name);
    EXPECT_EQ(elements.parameters.at("TYPE"), "S3");
    ASSERT_EQ(elements.lines.size(), shell.cells.size());
    for (std::size_t i = 0; i < elements.lines.size(); ++i)
    {
      const Cell& cell = shell.cells[i];
      EXPECT_EQ(idsIn(elements.lines[i]), (Ids{ next++, cell[0], cell[1], cell[2] }));
    }
    EXPECT_EQ(numbersIn(card("SHELL SECTION", "ELSET", shell.name).data()), Numbers{ shell.thickness });
  }
}

TEST_F(AbaqusDeck, ClampsNullDisplacement)
{
  std::vector<std::string> clamps;
  for (const Card& entry : cards)
  {
    if (entry.keyword == "BOUNDARY") clamps.insert(clamps.end(), entry.lines.begin(), entry.lines.end());
  }
  EXPECT_EQ(clamps, std::vector<std::string>{ "null_displacement_nodes, 1, 3" });
}

/// CalculiX reads the first 20 characters of a field.
TEST(Abaqus, NumbersFitTheFieldsOfCalculiX)
{
  MeshFile content = test::randomBlocks(1);
  content.mesh.points[0] = { -1.2345678901234567e-5, -123.45678901234567, 1.0 / 3 };
  for (const Card& card : cardsOf(written(finiteElementModel(content), "m.inp")))
  {
    if (card.keyword != "NODE") continue;
    std::istringstream fields(card.lines.at(0));
    std::string field;
    std::getline(fields, field, ',');
    for (int axis = 0; axis < 3; ++axis)
    {
      std::getline(fields, field, ',');
      EXPECT_LE(field.size() - 1, 20u) << field;
      EXPECT_NEAR(std::stod(field), content.mesh.points[0][axis], 1e-12 * std::abs(content.mesh.points[0][axis]));
    }
  }
}

class FebioModel : public testing::Test
{
protected:
  FebioModel() : model(richModel())
  {
    const test::TemporaryFolder folder;
    exportModel(model, folder.file("m.feb"));
    root.TakeReference(vtkXMLUtilities::ReadElementFromFile(folder.file("m.feb").c_str()));
    if (!root) throw std::runtime_error("not well-formed");
    mesh = root->FindNestedElementWithName("Mesh");
  }

  /// The only child of `parent` with this tag and name.
  vtkXMLDataElement* child(vtkXMLDataElement* parent, const std::string& tag, const std::string& name) const
  {
    vtkXMLDataElement* found = nullptr;
    for (int i = 0; i < parent->GetNumberOfNestedElements(); ++i)
    {
      vtkXMLDataElement* candidate = parent->GetNestedElement(i);
      if (candidate->GetName() != tag || candidate->GetAttribute("name") != name) continue;
      EXPECT_EQ(found, nullptr) << tag << " " << name << " is there twice";
      found = candidate;
    }
    if (!found) throw std::out_of_range(tag + " " + name);
    return found;
  }

  static std::vector<Ids> rowsOf(vtkXMLDataElement* parent)
  {
    std::vector<Ids> rows;
    for (int i = 0; i < parent->GetNumberOfNestedElements(); ++i)
    {
      rows.push_back(idsIn(parent->GetNestedElement(i)->GetCharacterData()));
    }
    return rows;
  }

  static Ids attributesOf(vtkXMLDataElement* parent)
  {
    Ids ids;
    for (int i = 0; i < parent->GetNumberOfNestedElements(); ++i)
    {
      ids.push_back(std::stoi(parent->GetNestedElement(i)->GetAttribute("id")) - 1);
    }
    return ids;
  }

  FiniteElementModel model;
  vtkSmartPointer<vtkXMLDataElement> root;
  vtkXMLDataElement* mesh = nullptr;
};

template <class Rows>
std::vector<Ids> asIds(const Rows& rows)
{
  std::vector<Ids> result;
  for (const auto& row : rows) result.push_back(Ids(row.begin(), row.end()));
  return result;
}

TEST_F(FebioModel, HasThePoints)
{
  EXPECT_STREQ(root->GetAttribute("version"), "4.0");
  vtkXMLDataElement* nodes = child(mesh, "Nodes", "all_nodes");
  const auto& points = model.content.mesh.points;
  ASSERT_EQ(nodes->GetNumberOfNestedElements(), static_cast<int>(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    vtkXMLDataElement* node = nodes->GetNestedElement(static_cast<int>(i));
    EXPECT_EQ(std::stoul(node->GetAttribute("id")), i + 1);
    EXPECT_EQ(numbersIn(node->GetCharacterData()), (Numbers{ points[i].x, points[i].y, points[i].z }));
  }
}

TEST_F(FebioModel, EveryElementIsInOnePartWithADomain)
{
  std::vector<int> count(model.content.mesh.tetrahedra.size(), 0);
  vtkXMLDataElement* domains = root->FindNestedElementWithName("MeshDomains");
  vtkXMLDataElement* materials = root->FindNestedElementWithName("Material");
  for (const Section& section : model.sections)
  {
    const ElementSet& set = model.elementSets[section.elementSet];
    vtkXMLDataElement* part = child(mesh, "Elements", set.name);
    EXPECT_STREQ(part->GetAttribute("type"), "tet4");
    EXPECT_EQ(attributesOf(part), set.elements);
    const std::vector<Ids> rows = rowsOf(part);
    for (std::size_t i = 0; i < rows.size(); ++i)
    {
      const auto& ids = model.content.mesh.tetrahedra[set.elements[i]];
      EXPECT_EQ(rows[i], Ids(ids.begin(), ids.end()));
      ++count[set.elements[i]];
    }
    child(materials, "material", child(domains, "SolidDomain", set.name)->GetAttribute("mat"));
  }
  EXPECT_EQ(count, std::vector<int>(count.size(), 1));
}

TEST_F(FebioModel, HasTheSetsAndNoNameTwice)
{
  std::set<std::int32_t> parts;
  for (const Section& section : model.sections) parts.insert(section.elementSet);
  for (std::size_t i = 0; i < model.elementSets.size(); ++i)
  {
    const ElementSet& set = model.elementSets[i];
    if (parts.count(static_cast<std::int32_t>(i)) > 0)
      EXPECT_THROW(child(mesh, "ElementSet", set.name), std::out_of_range);
    else EXPECT_EQ(idsIn(child(mesh, "ElementSet", set.name)->GetCharacterData()), set.elements);
  }
  for (const NodeSet& set : model.nodeSets)
  {
    EXPECT_EQ(idsIn(child(mesh, "NodeSet", set.name)->GetCharacterData()), set.points);
  }
  for (const SurfaceSet& set : model.surfaces)
  {
    EXPECT_EQ(rowsOf(child(mesh, "Surface", set.name)), asIds(set.cells));
  }
}

TEST_F(FebioModel, HasMaterialsShellsAndClamps)
{
  for (const Material& material : model.materials)
  {
    vtkXMLDataElement* entry = child(root->FindNestedElementWithName("Material"), "material", material.name);
    const auto value = [&](const char* tag)
    { return numbersIn(entry->FindNestedElementWithName(tag)->GetCharacterData()); };
    EXPECT_STREQ(entry->GetAttribute("type"),
                 material.law == MaterialLaw::NeoHookean ? "neo-Hookean" : "isotropic elastic");
    EXPECT_EQ(value("E"), Numbers{ material.youngsModulus });
    EXPECT_EQ(value("v"), Numbers{ material.poissonsRatio });
    EXPECT_EQ(value("density"), Numbers{ material.density });
  }
  for (const Shell& shell : model.shells)
  {
    EXPECT_EQ(rowsOf(child(mesh, "Elements", shell.name)), asIds(shell.cells));
    vtkXMLDataElement* domain = child(root->FindNestedElementWithName("MeshDomains"), "ShellDomain", shell.name);
    EXPECT_EQ(numbersIn(domain->FindNestedElementWithName("shell_thickness")->GetCharacterData()),
              Numbers{ shell.thickness });
  }
  EXPECT_STREQ(root->FindNestedElementWithName("Boundary")->GetNestedElement(0)->GetAttribute("node_set"),
               "null_displacement_nodes");
}

TEST(Export, VtkFilesHoldTheMesh)
{
  const test::TemporaryFolder folder;
  const FiniteElementModel model = richModel();
  for (const char* name : { "m.vtu", "m.vtk" })
  {
    exportModel(model, folder.file(name));
    const MeshFile read = readMesh(folder.file(name));
    EXPECT_EQ(read.mesh.tetrahedra, model.content.mesh.tetrahedra);
    EXPECT_EQ(read.mesh.labels, model.content.mesh.labels);
    EXPECT_EQ(read.subMesh, model.content.subMesh);
    EXPECT_EQ(read.constitutive, model.content.constitutive);
  }
}

// B15: Gmsh refuses field data before the points; SOFA does not swap the bytes of binary cell data.
TEST(Trial, B15_LegacyFilesForOtherReadersArePlain)
{
  const test::TemporaryFolder folder;
  exportModel(richModel(), folder.file("m.vtk"));
  const std::string text = test::readBytes(folder.file("m.vtk"));
  EXPECT_NE(text.find("\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS "), std::string::npos) << text.substr(0, 200);
  EXPECT_EQ(text.find("TissueIds"), std::string::npos);
}

TEST(Export, ShellFilesShareThePointsOfTheVolume)
{
  const test::TemporaryFolder folder;
  const FiniteElementModel model = richModel();
  writeShells(model, folder.file("s.vtp"));
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName(folder.file("s.vtp").c_str());
  reader->Update();
  vtkPolyData* data = reader->GetOutput();
  vtkDataArray* volumeId = data->GetPointData()->GetArray("VolumePointId");
  ASSERT_NE(volumeId, nullptr);
  for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i)
  {
    const Vec3& p = model.content.mesh.points.at(static_cast<std::size_t>(volumeId->GetComponent(i, 0)));
    const double* q = data->GetPoint(i);
    EXPECT_TRUE(q[0] == p.x && q[1] == p.y && q[2] == p.z);
  }
  vtkIdType cell = 0;
  for (const Shell& shell : model.shells)
  {
    for (const auto& triangle : shell.cells)
    {
      EXPECT_EQ(data->GetCellData()->GetArray("TissueLabel")->GetComponent(cell, 0), shell.ids[0]);
      EXPECT_EQ(data->GetCellData()->GetArray("Thickness")->GetComponent(cell, 0), shell.thickness);
      vtkIdType size;
      const vtkIdType* ids;
      data->GetPolys()->GetCellAtId(cell++, size, ids);
      ASSERT_EQ(size, 3);
      for (int i = 0; i < 3; ++i) EXPECT_EQ(volumeId->GetComponent(ids[i], 0), triangle[i]);
    }
  }
  EXPECT_EQ(cell, data->GetNumberOfPolys());
}

/// The numbers between `head`, which is there once, and the end of so many lines.
Numbers numbersAfter(const std::string& text, const std::string& head, int lines = 1)
{
  const std::size_t at = text.find(head);
  EXPECT_NE(at, std::string::npos) << head;
  EXPECT_EQ(text.find(head, at + 1), std::string::npos) << head;
  std::size_t end = at + head.size();
  for (int i = 0; i < lines; ++i) end = text.find('\n', end) + 1;
  return numbersIn(text.substr(at + head.size(), end - at - head.size()));
}

TEST(Export, LsDynaAndAnsysHaveTheMaterials)
{
  const FiniteElementModel model = richModel();
  const std::string deck = written(model, "m.k"), archive = written(model, "m.cdb");
  std::set<MaterialLaw> laws;
  for (std::size_t m = 0; m < model.materials.size(); ++m)
  {
    const Material& material = model.materials[m];
    const double E = material.youngsModulus, nu = material.poissonsRatio;
    const std::string number = std::to_string(m + 1);
    EXPECT_EQ(numbersAfter(archive, "MP,DENS," + number), Numbers{ material.density });
    laws.insert(material.law);
    if (material.law == MaterialLaw::LinearElastic)
    {
      EXPECT_EQ(numbersAfter(deck, "*MAT_ELASTIC_TITLE\n" + material.name + "\n"),
                (Numbers{ m + 1.0, material.density, E, nu }));
      EXPECT_EQ(numbersAfter(archive, "MP,EX," + number), Numbers{ E });
      EXPECT_EQ(numbersAfter(archive, "MP,PRXY," + number), Numbers{ nu });
      continue;
    }
    const Numbers ogden = numbersAfter(deck, "*MAT_OGDEN_RUBBER_TITLE\n" + material.name + "\n", 3);
    ASSERT_EQ(ogden.size(), 6u); // number, density, Poisson's ratio, no fit; coefficient; exponent
    EXPECT_EQ(ogden[2], nu);
    EXPECT_NEAR(ogden[4] * ogden[5] / 2, E / (2 + 2 * nu), 1e-5 * E); // the shear modulus, in ten columns
    const Numbers neoHooke = numbersAfter(archive, "TB,HYPER," + number + ",1,2,NEO\nTBDATA");
    ASSERT_EQ(neoHooke.size(), 3u);
    EXPECT_DOUBLE_EQ(neoHooke[1], E / (2 + 2 * nu));
    EXPECT_DOUBLE_EQ(2 / neoHooke[2], E / (3 - 6 * nu)); // the bulk modulus
  }
  EXPECT_EQ(laws.size(), 2u);
}

TEST(Export, EveryFormatGivesTheSameBytesTwiceAndASidecar)
{
  const FiniteElementModel model = richModel();
  for (const ExportFormat& format : exportFormats())
  {
    std::vector<std::string> names, contents;
    for (int run = 0; run < 2; ++run)
    {
      const test::TemporaryFolder folder;
      exportModel(model, folder.file("m" + format.extension));
      names = folder.files();
      std::string all;
      for (const std::string& name : names) all += test::readBytes(folder.file(name));
      contents.push_back(all);
    }
    EXPECT_EQ(contents[0], contents[1]) << format.extension;
    EXPECT_EQ(std::count(names.begin(), names.end(), "m" + format.extension + ".names.json"), 1);
  }
}

TEST(Export, RefusesUnknownExtensionsWithTheKnownOnes)
{
  for (const char* file : { "m.foo", "m", "m.inp.gz" })
  {
    try
    {
      exportFormatOf(file);
      ADD_FAILURE() << file;
    }
    catch (const UsageError& error)
    {
      for (const ExportFormat& format : exportFormats())
        EXPECT_NE(std::string(error.what()).find(format.extension), std::string::npos);
    }
  }
  EXPECT_TRUE(hasExportExtension("folder.vtu/M.INP"));
  EXPECT_FALSE(hasExportExtension("Skull 1.5 mm"));
  EXPECT_FALSE(hasExportExtension("mesh"));
  EXPECT_EQ(exportFormatOf("folder.vtu/M.INP").extension, ".inp");
  EXPECT_EQ(exportFormatOf("a.b.Simnibs.MSH").extension, ".simnibs.msh");
  EXPECT_EQ(exportFormatOf("simnibs.msh").extension, ".msh");
}

TEST(Export, SimnibsRefusesLabelsOfElectrodes)
{
  MeshFile content = test::randomBlocks(2);
  for (const Label label : { 99, 100 })
  {
    for (Label& some : content.mesh.labels) some = some == 1 ? 1 : label;
    const FiniteElementModel model = finiteElementModel(content);
    if (label < 100) EXPECT_GT(written(model, "m.simnibs.msh").size(), 100u);
    else EXPECT_THROW(written(model, "m.simnibs.msh"), InputError);
  }
}

/// Two curves along edges of the mesh, one of two radii.
FiniteElementModel modelWithCurves(bool areTrusses)
{
  MeshFile content = test::randomBlocks(2);
  const auto& first = content.mesh.tetrahedra.front();
  const auto& last = content.mesh.tetrahedra.back();
  content.curves = { { "basilar artery", { first[0], first[1], first[2] }, { 1, 1, 3 } },
                     { "nerve", { last[0], last[1] }, { 0.5, 0.5 } } };
  FiniteElementOptions options;
  options.beams.areTrusses = areTrusses;
  options.beams.material.youngsModulus = 2;
  return finiteElementModel(content, options);
}

TEST(Beams, ACurveIsASetForEachRadius)
{
  const FiniteElementModel model = modelWithCurves(false);
  ASSERT_EQ(model.beams.size(), 3u);
  EXPECT_EQ(model.beams[0].name, "basilar_artery_section_1");
  EXPECT_EQ(model.beams[0].original, "basilar artery");
  EXPECT_EQ(model.beams[2].name, "nerve");
  const double radii[] = { 1, 2, 0.5 };
  for (std::size_t b = 0; b < model.beams.size(); ++b)
  {
    EXPECT_NEAR(model.beams[b].radius, radii[b], 1e-12);
    EXPECT_EQ(model.beams[b].edges.size(), 1u);
    EXPECT_EQ(model.materials[model.beams[b].material].youngsModulus, 2);
  }
}

TEST(Beams, AbaqusHasTheirElementsAndSections)
{
  for (const bool areTrusses : { false, true })
  {
    const FiniteElementModel model = modelWithCurves(areTrusses);
    auto next = static_cast<std::int32_t>(model.content.mesh.tetrahedra.size());
    std::size_t elements = 0, sections = 0;
    for (const Card& card : cardsOf(written(model, "m.inp")))
    {
      const std::string type = card.keyword == "ELEMENT" ? card.parameters.at("TYPE") : "";
      if (type == (areTrusses ? "T3D2" : "B31"))
      {
        const Beam& beam = model.beams.at(elements++);
        EXPECT_EQ(card.parameters.at("ELSET"), beam.name);
        EXPECT_EQ(idsIn(card.data()), (Ids{ next++, beam.edges[0][0], beam.edges[0][1] }));
      }
      const bool isSection = card.keyword == "BEAM SECTION" || (card.keyword == "SOLID SECTION" && !card.lines.empty());
      if (!isSection) continue;
      const Beam& beam = model.beams.at(sections++);
      const Numbers numbers = numbersIn(card.data());
      const double r = beam.radius, area = std::acos(-1.0) * r * r;
      EXPECT_EQ(card.parameters.at("ELSET"), beam.name);
      EXPECT_EQ(card.keyword == "SOLID SECTION", areTrusses);
      if (areTrusses) EXPECT_NEAR(numbers[0], area, 1e-9 * area);
      else EXPECT_NEAR(std::pow(numbers[0], 4) / 12, area * r * r / 4, 1e-9 * area);
    }
    EXPECT_EQ(elements, 3u);
    EXPECT_EQ(sections, 3u);
  }
}

TEST(Beams, FebioHasTheirElementsAndSections)
{
  for (const bool areTrusses : { false, true })
  {
    const FiniteElementModel model = modelWithCurves(areTrusses);
    const test::TemporaryFolder folder;
    exportModel(model, folder.file("m.feb"));
    vtkSmartPointer<vtkXMLDataElement> root;
    root.TakeReference(vtkXMLUtilities::ReadElementFromFile(folder.file("m.feb").c_str()));
    ASSERT_TRUE(root);
    vtkXMLDataElement* mesh = root->FindNestedElementWithName("Mesh");
    vtkXMLDataElement* domains = root->FindNestedElementWithName("MeshDomains");
    vtkXMLDataElement* materials = root->FindNestedElementWithName("Material");
    for (const Beam& beam : model.beams)
    {
      vtkXMLDataElement* elements = mesh->FindNestedElementWithNameAndAttribute("Elements", "name", beam.name.c_str());
      ASSERT_TRUE(elements);
      EXPECT_STREQ(elements->GetAttribute("type"), "line2");
      EXPECT_EQ(idsIn(elements->GetNestedElement(0)->GetCharacterData()), (Ids{ beam.edges[0][0], beam.edges[0][1] }));
      vtkXMLDataElement* domain =
        domains->FindNestedElementWithNameAndAttribute("BeamDomain", "name", beam.name.c_str());
      ASSERT_TRUE(domain);
      vtkXMLDataElement* material =
        materials->FindNestedElementWithNameAndAttribute("material", "name", domain->GetAttribute("mat"));
      ASSERT_TRUE(material);
      const double area = std::acos(-1.0) * beam.radius * beam.radius;
      vtkXMLDataElement* written = areTrusses ? domain->FindNestedElementWithName("cross_sectional_area")
                                              : material->FindNestedElementWithName("A");
      ASSERT_TRUE(written);
      EXPECT_NEAR(std::stod(written->GetCharacterData()), area, 1e-9 * area);
    }
  }
}

/// Numbers of all lines that have this name in their first eight columns, and fields so wide after them.
std::vector<Numbers> rowsOf(const std::string& text, const std::string& name, std::size_t width)
{
  std::vector<Numbers> rows;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);)
  {
    if (line.rfind(name, 0) != 0) continue;
    rows.emplace_back();
    for (std::size_t at = 8; at < line.size(); at += width)
      for (const double number : numbersIn(line.substr(at, width))) rows.back().push_back(number);
  }
  return rows;
}

/// Cards whose name ends in an asterisk.
std::size_t wideCards(const std::string& deck)
{
  std::size_t count = 0;
  std::istringstream stream(deck);
  for (std::string line; std::getline(stream, line);)
  {
    const std::size_t asterisk = line.substr(0, 8).find('*');
    count += asterisk != std::string::npos && asterisk > 0;
  }
  return count;
}

/// Whether a direction tells how an edge's section is turned.
bool isAcross(const Vec3& direction, const Cell& edge, const FiniteElementModel& model)
{
  const auto& points = model.content.mesh.points;
  const Vec3 along = points[edge[1]] - points[edge[0]];
  return norm(direction) > 0 && std::abs(dot(along, direction)) < 0.6 * norm(along) * norm(direction);
}

TEST(Beams, NastranHasTheirElementsAndSections)
{
  for (const bool areTrusses : { false, true })
  {
    const FiniteElementModel model = modelWithCurves(areTrusses);
    const std::string deck = written(model, "m.bdf");
    const auto elements = rowsOf(deck, areTrusses ? "CROD " : "CBAR ", 8);
    const auto properties = rowsOf(deck, areTrusses ? "PROD* " : "PBAR* ", 16);
    ASSERT_EQ(elements.size(), 3u);
    ASSERT_EQ(properties.size(), 3u);
    EXPECT_EQ(rowsOf(deck, "*", 16).size(), wideCards(deck)) << "of wide cards lines are even";
    for (std::size_t b = 0; b < 3; ++b)
    {
      const Beam& beam = model.beams[b];
      const Numbers& row = elements[b];
      EXPECT_EQ(row[0], double(model.elements.size() + b + 1));
      EXPECT_EQ(row[1], properties[b][0]);
      EXPECT_EQ((Ids{ int(row[2]) - 1, int(row[3]) - 1 }), (Ids{ beam.edges[0][0], beam.edges[0][1] }));
      EXPECT_EQ(properties[b][1], beam.material + 1);
      EXPECT_NEAR(properties[b][2], sectionArea(beam), 1e-9 * sectionArea(beam));
      if (areTrusses) continue;
      EXPECT_TRUE(isAcross({ row[4], row[5], row[6] }, beam.edges[0], model));
      EXPECT_NEAR(properties[b][3], secondMomentOfArea(beam), 1e-9 * properties[b][3]);
    }
  }
}

TEST(Beams, LsDynaHasTheirElementsAndSections)
{
  for (const bool areTrusses : { false, true })
  {
    const FiniteElementModel model = modelWithCurves(areTrusses);
    const std::string deck = written(model, "m.k");
    const char* keyword = areTrusses ? "*ELEMENT_BEAM\n" : "*ELEMENT_BEAM_ORIENTATION\n";
    const std::size_t perBeam = areTrusses ? 4 : 7;
    const Numbers elements = numbersAfter(deck, keyword, areTrusses ? 3 : 6);
    ASSERT_EQ(elements.size(), 3 * perBeam);
    for (std::size_t b = 0; b < 3; ++b)
    {
      const Beam& beam = model.beams[b];
      const Numbers row(elements.begin() + std::ptrdiff_t(b * perBeam), elements.end());
      EXPECT_EQ(row[0], double(model.elements.size() + b + 1));
      EXPECT_TRUE(areTrusses || isAcross({ row[4], row[5], row[6] }, beam.edges[0], model));
      EXPECT_EQ((Ids{ int(row[2]) - 1, int(row[3]) - 1 }), (Ids{ beam.edges[0][0], beam.edges[0][1] }));
      const Numbers part = numbersAfter(deck, "*PART\n" + beam.name + "\n");
      EXPECT_EQ(part[0], row[1]);
      EXPECT_EQ(part[2], beam.material + 1);
      const std::string section = "*SECTION_BEAM\n";
      const std::size_t begin = deck.find(section, deck.find("*PART\n" + beam.name)) + section.size();
      const Numbers numbers = numbersIn(deck.substr(begin, deck.find('*', begin) - begin));
      EXPECT_EQ(numbers[0], part[1]);
      const double d = 2 * beam.radius;
      if (areTrusses) EXPECT_NEAR(numbers.at(2), sectionArea(beam), 1e-6 * sectionArea(beam));
      else EXPECT_EQ(Numbers(numbers.begin() + 4, numbers.end()), (Numbers{ 1, d, d, 0, 0 }));
    }
  }
}

TEST(Beams, AnsysHasTheirElementsAndSections)
{
  for (const bool areTrusses : { false, true })
  {
    const FiniteElementModel model = modelWithCurves(areTrusses);
    const std::string archive = written(model, "m.cdb");
    const std::size_t rows = model.elements.size() + 3;
    const std::string count = std::to_string(rows);
    const Numbers block = numbersAfter(archive, "EBLOCK,19,SOLID," + count + "," + count + "\n(19i9)\n", int(rows));
    for (std::size_t b = 0; b < 3; ++b)
    {
      const Beam& beam = model.beams[b];
      const Numbers row(block.end() - 13 * (3 - std::ptrdiff_t(b)), block.end() - 13 * (2 - std::ptrdiff_t(b)));
      EXPECT_NE(archive.find("ET," + std::to_string(int(row[1])) + (areTrusses ? ",180\n" : ",188\n")), archive.npos);
      EXPECT_EQ(row[0], beam.material + 1);
      EXPECT_EQ(row[8], 2);
      EXPECT_EQ((Ids{ int(row[11]) - 1, int(row[12]) - 1 }), (Ids{ beam.edges[0][0], beam.edges[0][1] }));
      const std::string section = "SECTYPE," + std::to_string(int(row[3])) + (areTrusses ? ",LINK," : ",BEAM,CSOLID,");
      const std::size_t data = archive.find("SECDATA,", archive.find(section));
      ASSERT_NE(data, archive.npos);
      EXPECT_DOUBLE_EQ(std::stod(archive.substr(data + 8)), areTrusses ? sectionArea(beam) : beam.radius);
      EXPECT_NE(archive.find("CMBLOCK," + beam.name + ",ELEM"), archive.npos);
    }
  }
}

TEST(Beams, MeditHasTheirEdges)
{
  const FiniteElementModel model = modelWithCurves(false);
  const Numbers edges = numbersAfter(written(model, "m.mesh"), "\nEdges\n", 4);
  ASSERT_EQ(edges.size(), 10u); // their number; then nodes and reference
  for (std::size_t b = 0; b < 3; ++b)
    EXPECT_EQ((Ids{ int(edges[3 * b + 1]) - 1, int(edges[3 * b + 2]) - 1 }),
              (Ids{ model.beams[b].edges[0][0], model.beams[b].edges[0][1] }));
  EXPECT_EQ((std::set<double>{ edges[3], edges[6], edges[9] }.size()), 3u) << "a reference for each";
}

TEST(Export, NastranHoldsNodesOnlyWhereTheModelDoes)
{
  FiniteElementModel model = richModel();
  EXPECT_NE(written(model, "m.bdf").find("\nSPC = 1\n"), std::string::npos);
  const auto isHeld = [](const NodeSet& set) { return set.kind == SetKind::NullDisplacement; };
  model.nodeSets.erase(std::remove_if(model.nodeSets.begin(), model.nodeSets.end(), isHeld), model.nodeSets.end());
  EXPECT_EQ(written(model, "m.bdf").find("SPC"), std::string::npos);
}

TEST(Export, LsDynaRoundsNoPoissonsRatioToAHalf)
{
  FiniteElementModel model = richModel();
  for (Material& material : model.materials) material.poissonsRatio = 0.4999999999;
  const std::string deck = written(model, "m.k");
  for (const Material& material : model.materials)
  {
    const bool isLinear = material.law == MaterialLaw::LinearElastic;
    const std::string title = isLinear ? "*MAT_ELASTIC_TITLE\n" : "*MAT_OGDEN_RUBBER_TITLE\n";
    EXPECT_LT(numbersAfter(deck, title + material.name + "\n").at(isLinear ? 3 : 2), 0.5);
  }
}

TEST(Beams, GmshAndTheSidecarNameThem)
{
  const FiniteElementModel model = modelWithCurves(false);
  for (const char* name : { "m.msh", "m.msh2" })
  {
    const std::string text = written(model, name);
    for (const Beam& beam : model.beams) EXPECT_NE(text.find("\"" + beam.name + "\"\n"), text.npos) << name;
  }
  const std::string names = setNamesJSON(model);
  EXPECT_NE(names.find("\"kind\": \"beam\""), names.npos);
}

} // namespace
} // namespace surgicalmesher
