// SPDX-License-Identifier: Apache-2.0
#include "FiniteElementModel.h"

#include "Errors.h"
#include "LabelledBlocks.h"

#include <gtest/gtest.h>
#include <rapidjson/document.h>

#include <cctype>
#include <numeric>
#include <set>
#include <stdexcept>

namespace surgicalmesher
{
namespace
{

using test::randomBlocks;
using test::volumeOf;
using Triangles = std::vector<Cell>;

constexpr double kExact = 1e-10;

/// Each edge as often in one direction as in the other.
bool isClosed(const Triangles& triangles)
{
  std::map<std::pair<std::int32_t, std::int32_t>, int> balance;
  for (const auto& t : triangles)
  {
    for (int i = 0; i < 3; ++i)
    {
      const std::int32_t a = t[i], b = t[(i + 1) % 3];
      balance[std::minmax(a, b)] += a < b ? 1 : -1;
    }
  }
  return !triangles.empty() &&
         std::all_of(balance.begin(), balance.end(), [](const auto& edge) { return edge.second == 0; });
}

double enclosedVolume(const TetMesh& mesh, const Triangles& triangles)
{
  double volume = 0;
  for (const Cell& t : triangles) volume += orient({}, mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]) / 6;
  return volume;
}

std::vector<std::int32_t> pointsOf(const Triangles& triangles)
{
  std::set<std::int32_t> points;
  for (const auto& triangle : triangles) points.insert(triangle.begin(), triangle.end());
  return { points.begin(), points.end() };
}

/// The triangles of all surfaces of a kind with this id behind.
Triangles trianglesOf(const FiniteElementModel& model, SetKind kind, std::int32_t behind)
{
  Triangles result;
  for (const SurfaceSet& surface : model.surfaces)
  {
    if (surface.kind == kind && surface.ids[0] == behind)
      result.insert(result.end(), surface.cells.begin(), surface.cells.end());
  }
  return result;
}

const NodeSet& nodeSet(const FiniteElementModel& model, const std::string& name)
{
  for (const NodeSet& set : model.nodeSets)
  {
    if (set.name == name) return set;
  }
  throw std::out_of_range("no node set " + name);
}

class FiniteElementModels : public testing::TestWithParam<unsigned>
{
protected:
  FiniteElementModels() : content(randomBlocks(GetParam())), model(finiteElementModel(content)) {}

  MeshFile content;
  FiniteElementModel model;
};

TEST_P(FiniteElementModels, ElementSetsOfEachKindPartitionTheMesh)
{
  for (const SetKind kind : { SetKind::Tissue, SetKind::SubMesh, SetKind::Constitutive })
  {
    std::vector<int> count(content.mesh.tetrahedra.size(), 0);
    for (const ElementSet& set : model.elementSets)
    {
      if (set.kind != kind) continue;
      double volume = 0;
      for (std::size_t t = 0; t < count.size(); ++t)
      {
        const std::int32_t id = kind == SetKind::Tissue    ? content.mesh.labels[t]
                                : kind == SetKind::SubMesh ? content.subMesh[t]
                                                           : content.constitutive[t];
        if (id == set.ids[0]) volume += volumeOf(content.mesh, static_cast<std::int32_t>(t));
      }
      EXPECT_NEAR(volumeOf(content.mesh, set.elements), volume, kExact * volume) << set.name;
      for (const std::int32_t t : set.elements) ++count[t];
    }
    EXPECT_EQ(count, std::vector<int>(count.size(), 1)) << nameOf(kind);
  }
}

TEST_P(FiniteElementModels, SectionsPartitionTheMesh)
{
  std::vector<int> count(content.mesh.tetrahedra.size(), 0);
  for (const Section& section : model.sections)
  {
    const bool isNonlinear = model.materials.at(section.material).law == MaterialLaw::NeoHookean;
    for (const std::int32_t t : model.elementSets.at(section.elementSet).elements)
    {
      ++count[t];
      EXPECT_EQ(isNonlinear, content.constitutive[t] == 1);
    }
  }
  EXPECT_EQ(count, std::vector<int>(count.size(), 1));
}

TEST_P(FiniteElementModels, SurfacesOfATissueCloseAroundIt)
{
  for (const ElementSet& set : model.elementSets)
  {
    if (set.kind != SetKind::Tissue) continue;
    const Triangles boundary = trianglesOf(model, SetKind::TissueInterface, set.ids[0]);
    EXPECT_TRUE(isClosed(boundary)) << set.name;
    const double volume = volumeOf(content.mesh, set.elements);
    EXPECT_NEAR(enclosedVolume(content.mesh, boundary), volume, kExact * volume) << set.name;
  }
}

TEST_P(FiniteElementModels, OuterBoundaryClosesAroundTheMesh)
{
  const SurfaceSet& outer = model.surfaces.front();
  ASSERT_EQ(outer.kind, SetKind::OuterBoundary);
  EXPECT_TRUE(isClosed(outer.cells));
  std::vector<std::int32_t> all(content.mesh.tetrahedra.size());
  std::iota(all.begin(), all.end(), 0);
  const double volume = volumeOf(content.mesh, all);
  EXPECT_NEAR(enclosedVolume(content.mesh, outer.cells), volume, kExact * volume);
  std::set<Cell> byTissue;
  for (const SurfaceSet& surface : model.surfaces)
  {
    if (surface.kind == SetKind::TissueInterface && surface.ids[1] == 0)
      byTissue.insert(surface.cells.begin(), surface.cells.end());
  }
  EXPECT_EQ(byTissue, (std::set<Cell>(outer.cells.begin(), outer.cells.end())));
}

TEST_P(FiniteElementModels, TrianglesAreTheFacesWoundOutwards)
{
  for (const SurfaceSet& surface : model.surfaces)
  {
    ASSERT_EQ(surface.faces.size(), surface.cells.size()) << surface.name;
    for (std::size_t i = 0; i < surface.faces.size(); ++i)
    {
      const auto& ids = content.mesh.tetrahedra[surface.faces[i].element];
      const Cell& face = surface.cells[i];
      const std::int32_t a = face[0], b = face[1], c = face[2];
      const std::int32_t apex = ids[surface.faces[i].face];
      EXPECT_EQ((std::set<std::int32_t>{ a, b, c, apex }), std::set<std::int32_t>(ids.begin(), ids.end()));
      const auto& p = content.mesh.points;
      EXPECT_LT(orient(p[a], p[b], p[c], p[apex]), 0) << "the apex lies behind";
    }
  }
}

TEST_P(FiniteElementModels, BothSidesOfAnInterfaceHaveTheSameNodes)
{
  std::map<std::vector<std::int32_t>, const SurfaceSet*> byIds[2];
  for (const SurfaceSet& surface : model.surfaces)
  {
    EXPECT_EQ(nodeSet(model, surface.nodeSet).points, pointsOf(surface.cells)) << surface.name;
    if (surface.kind == SetKind::OuterBoundary) continue;
    byIds[surface.kind == SetKind::SubMeshInterface][surface.ids] = &surface;
  }
  for (const auto& sides : byIds)
  {
    for (const auto& [ids, surface] : sides)
    {
      if (surface->kind == SetKind::TissueInterface && ids[1] == 0) continue; // nobody is there
      const SurfaceSet& other = *sides.at({ ids[1], ids[0] });
      EXPECT_EQ(other.nodeSet, surface->nodeSet);
      EXPECT_EQ(other.faces.size(), surface->faces.size());
    }
  }
}

TEST_P(FiniteElementModels, EveryContactHasASurface)
{
  const FaceAdjacency neighbours = faceAdjacency(content.mesh);
  std::map<std::vector<std::int32_t>, std::size_t> contacts;
  for (std::size_t t = 0; t < content.mesh.tetrahedra.size(); ++t)
  {
    for (const std::int32_t beyond : neighbours.across[t])
    {
      const std::int32_t here = content.mesh.labels[t], there = beyond < 0 ? 0 : content.mesh.labels[beyond];
      if (here != there) ++contacts[{ here, there }];
    }
  }
  std::map<std::vector<std::int32_t>, std::size_t> surfaces;
  for (const SurfaceSet& surface : model.surfaces)
  {
    if (surface.kind == SetKind::TissueInterface) surfaces[surface.ids] = surface.faces.size();
  }
  EXPECT_EQ(surfaces, contacts);
}

TEST_P(FiniteElementModels, SubMeshAndNullDisplacementNodesAreThoseOfTheirTetrahedra)
{
  std::set<std::int32_t> held, ofParent, ofChild, ofBoth;
  for (std::size_t t = 0; t < content.mesh.tetrahedra.size(); ++t)
  {
    const auto& ids = content.mesh.tetrahedra[t];
    if (content.constitutive[t] == 2) held.insert(ids.begin(), ids.end());
    (content.subMesh[t] == 0 ? ofParent : ofChild).insert(ids.begin(), ids.end());
  }
  std::set_intersection(ofParent.begin(), ofParent.end(), ofChild.begin(), ofChild.end(),
                        std::inserter(ofBoth, ofBoth.end()));
  EXPECT_EQ(nodeSet(model, "null_displacement_nodes").points, std::vector<std::int32_t>(held.begin(), held.end()));
  EXPECT_EQ(nodeSet(model, "submesh_interface_nodes").points, std::vector<std::int32_t>(ofBoth.begin(), ofBoth.end()));
}

INSTANTIATE_TEST_SUITE_P(RandomMaps, FiniteElementModels, testing::Range(1u, 6u));

/// Every name of the model, in upper case.
std::vector<std::string> allNames(const FiniteElementModel& model)
{
  std::vector<std::string> names;
  for (const ElementSet& set : model.elementSets) names.push_back(set.name);
  for (const SurfaceSet& set : model.surfaces) names.push_back(set.name);
  for (const NodeSet& set : model.nodeSets) names.push_back(set.name);
  for (const Shell& shell : model.shells) names.push_back(shell.name);
  for (const Material& material : model.materials) names.push_back(material.name);
  for (std::string& name : names)
  {
    for (char& c : name) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  }
  return names;
}

/// A row of voxels, one for each name, labels from 1.
MeshFile rowOf(const std::vector<std::string>& names)
{
  MeshFile content;
  content.mesh = withoutOutside(test::tetrahedraOf(
    test::paintedMap({ static_cast<int>(names.size()), 1, 1 }, [](int i, int, int) { return i + 1; })));
  for (std::size_t i = 0; i < names.size(); ++i)
  {
    content.tissues[static_cast<Label>(i + 1)] = { names[i], { 0.25, 0.5, 1.0 / double(i + 1) }, {} };
  }
  return content;
}

TEST(FiniteElementModel, HostileNamesAreMappedAndTheMapSaysSo)
{
  const std::string lengthy(200, 'x'), half(30, 'y');
  const std::vector<std::string> originals{ "Gray matter",
                                            "gray_matter",
                                            "Gray matter",
                                            "\xc3\x89piphyse \"pin\xc3\xa9"
                                            "ale\"",
                                            "3rd ventricle",
                                            lengthy + "1",
                                            lengthy + "2",
                                            "outer boundary",
                                            "submesh parent",
                                            "\xe8\x84\xb3",
                                            "",
                                            "tissue 11",
                                            "a|b,c;d<e>&f",
                                            "outside",
                                            half + "A" + half,
                                            half + "B" + half };
  FiniteElementOptions options;
  for (Label label = 1; label <= 4; ++label) options.materials[label] = {};
  options.shells = { { 1, -1, 1 }, { 3, 4, 1 } };
  const FiniteElementModel model = finiteElementModel(rowOf(originals), options);

  const std::vector<std::string> names = allNames(model);
  EXPECT_EQ(std::set<std::string>(names.begin(), names.end()).size(), names.size());

  rapidjson::Document json;
  json.Parse(setNamesJSON(model).c_str());
  ASSERT_FALSE(json.HasParseError());
  std::map<std::string, int> labelOf;
  for (const auto& set : json["sets"].GetArray())
  {
    if (std::string(set["kind"].GetString()) != "tissue") continue;
    const int label = set["ids"][0].GetInt();
    labelOf[set["name"].GetString()] = label;
    const std::string original = originals[label - 1];
    EXPECT_EQ(set["original"].GetString(), original.empty() ? "tissue " + std::to_string(label) : original);
    EXPECT_DOUBLE_EQ(set["color"][2].GetDouble(), 1.0 / label);
  }
  EXPECT_EQ(labelOf.size(), originals.size());
  EXPECT_EQ(labelOf.at("Gray_matter"), 1);
  EXPECT_EQ(labelOf.at("gray_matter_2"), 2);
  EXPECT_EQ(labelOf.at("Gray_matter_3"), 3);
  EXPECT_EQ(labelOf.at("Epiphyse_pineale"), 4);
  EXPECT_EQ(labelOf.at("n3rd_ventricle"), 5);
}

TEST(FiniteElementModel, ShellsAreFacesOfTheirTissue)
{
  const MeshFile content = randomBlocks(3);
  FiniteElementOptions options;
  options.shells = { { 2, 1, 0.5 }, { 2, -1, 0.25 }, { 1, 0, 1 } };
  const FiniteElementModel model = finiteElementModel(content, options);
  ASSERT_EQ(model.shells.size(), 3u);
  const auto sorted = [](Triangles triangles)
  {
    std::sort(triangles.begin(), triangles.end());
    return triangles;
  };
  const auto surface = [&](const std::vector<std::int32_t>& ids)
  {
    const auto found =
      std::find_if(model.surfaces.begin(), model.surfaces.end(),
                   [&](const SurfaceSet& s) { return s.kind == SetKind::TissueInterface && s.ids == ids; });
    return found == model.surfaces.end() ? Triangles() : found->cells;
  };
  EXPECT_EQ(model.shells[0].cells.size(), surface({ 2, 1 }).size());
  EXPECT_EQ(sorted(model.shells[2].cells), sorted(surface({ 1, 0 })));
  Triangles whole = model.shells[0].cells;
  whole.insert(whole.end(), model.shells[1].cells.begin(), model.shells[1].cells.end());
  EXPECT_TRUE(isClosed(whole)) << "what the first shell took, the second lacks";
  EXPECT_NEAR(enclosedVolume(content.mesh, whole),
              enclosedVolume(content.mesh, trianglesOf(model, SetKind::TissueInterface, 2)), 1e-9);
  EXPECT_EQ(model.shells[0].thickness, 0.5);
  EXPECT_EQ(model.materials.at(model.shells[1].material).law, MaterialLaw::LinearElastic);
}

TEST(FiniteElementModel, RefusesShellsWithoutAFace)
{
  const MeshFile row = rowOf({ "a", "b", "c" });
  for (const ShellChoice& choice : { ShellChoice{ 9, -1, 1 }, ShellChoice{ 1, 3, 1 }, ShellChoice{ 1, 9, 1 } })
  {
    FiniteElementOptions options;
    options.shells = { choice };
    EXPECT_THROW(finiteElementModel(row, options), InputError);
  }
}

TEST(FiniteElementModel, TissuesOfTheTableHaveTheirOwnMaterials)
{
  MeshFile row = rowOf({ "a", "b", "c" });
  row.constitutive = std::vector<std::int32_t>(row.mesh.tetrahedra.size(), 1);
  FiniteElementOptions options;
  options.materials[1] = { MaterialLaw::LinearElastic, 2, 0.3, 1e-9 };
  options.materials[2] = { MaterialLaw::NeoHookean, 3, 0.4, 2e-9 };
  const FiniteElementModel model = finiteElementModel(row, options);
  ASSERT_EQ(model.sections.size(), 3u);
  const auto material = [&](std::size_t section) { return model.materials.at(model.sections[section].material); };
  EXPECT_EQ(material(0).name, "material_a_linear_elastic");
  EXPECT_EQ(material(0).youngsModulus, 2);
  EXPECT_EQ(material(1).name, "material_b_neo_hookean");
  EXPECT_EQ(material(1).density, 2e-9);
  EXPECT_EQ(material(2).name, "default_material_neo_hookean");
}

} // namespace
} // namespace surgicalmesher
