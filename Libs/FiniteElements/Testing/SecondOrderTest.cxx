// SPDX-License-Identifier: Apache-2.0
#include "SecondOrder.h"

#include "../../Libs/TissueMap/Testing/TestFiles.h"
#include "ConstitutiveTags.h"
#include "Errors.h"
#include "Export.h"
#include "LabelledBlocks.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

namespace surgicalmesher
{
namespace
{

constexpr int kEdges[6][2] = { { 0, 1 }, { 1, 2 }, { 0, 2 }, { 0, 3 }, { 1, 3 }, { 2, 3 } };

class SecondOrder : public testing::TestWithParam<unsigned>
{
protected:
  SecondOrder() : content(test::randomBlocks(GetParam()))
  {
    content.targetEdgeLength.assign(content.mesh.points.size(), 1.5);
    FiniteElementOptions options;
    options.shells = { { 1, -1, 0.5 } };
    first = finiteElementModel(content, options);
    second = withMidSideNodes(first);
  }

  /// Corners as they were, and of each edge its middle.
  void expectCompleted(const std::vector<Cell>& before, const std::vector<Cell>& after) const
  {
    const std::vector<Vec3>& points = second.content.mesh.points;
    ASSERT_EQ(before.size(), after.size());
    for (std::size_t c = 0; c < before.size(); ++c)
    {
      const std::size_t corners = before[c].size();
      ASSERT_EQ(after[c].size(), corners == 4 ? 10 : 6);
      ASSERT_TRUE(std::equal(before[c].begin(), before[c].end(), after[c].begin()));
      for (std::size_t e = corners; e < after[c].size(); ++e)
      {
        const auto& [a, b] = kEdges[e - corners];
        ASSERT_EQ(norm(points[after[c][e]] - 0.5 * (points[after[c][a]] + points[after[c][b]])), 0);
      }
    }
  }

  MeshFile content;
  FiniteElementModel first, second;
};

TEST_P(SecondOrder, EveryEdgeHasOneNodeInItsMiddle)
{
  std::map<std::set<std::int32_t>, std::set<std::int32_t>> middles;
  for (const Cell& element : second.elements)
  {
    for (int e = 0; e < 6; ++e) middles[{ element[kEdges[e][0]], element[kEdges[e][1]] }].insert(element[4 + e]);
  }
  for (const auto& [edge, ids] : middles) EXPECT_EQ(ids.size(), 1);
  EXPECT_EQ(second.content.mesh.points.size(), first.content.mesh.points.size() + middles.size());
  EXPECT_EQ(nodesOf(second.elements).size(), second.content.mesh.points.size());
  EXPECT_EQ(second.content.targetEdgeLength, std::vector<double>(second.content.mesh.points.size(), 1.5));
}

TEST_P(SecondOrder, ElementsFacesAndShellsHaveThem)
{
  expectCompleted(first.elements, second.elements);
  for (std::size_t s = 0; s < first.surfaces.size(); ++s)
    expectCompleted(first.surfaces[s].cells, second.surfaces[s].cells);
  expectCompleted(first.shells[0].cells, second.shells[0].cells);
  std::vector<Cell> before, after;
  for (std::size_t e = 0; e < first.elements.size(); ++e)
  {
    ASSERT_EQ(faceCount(second.elements[e]), 4);
    for (int f = 0; f < 4; ++f)
    {
      before.push_back(faceOf(first.elements[e], f));
      after.push_back(faceOf(second.elements[e], f));
    }
  }
  expectCompleted(before, after);
}

TEST_P(SecondOrder, SetsOfNodesHaveThoseThatBelongToThem)
{
  std::map<std::string, const NodeSet*> sets;
  for (const NodeSet& set : second.nodeSets) sets[set.name] = &set;
  for (const SurfaceSet& surface : second.surfaces)
    EXPECT_EQ(sets.at(surface.nodeSet)->points, nodesOf(surface.cells)) << surface.name;
  std::vector<Cell> still;
  std::vector<std::set<std::int32_t>> subMeshes(second.content.mesh.points.size());
  for (std::size_t e = 0; e < second.elements.size(); ++e)
  {
    if (content.constitutive[e] == kNullDisplacement) still.push_back(second.elements[e]);
    for (const std::int32_t id : second.elements[e]) subMeshes[id].insert(content.subMesh[e]);
  }
  EXPECT_EQ(sets.at("null_displacement_nodes")->points, nodesOf(still));
  for (std::size_t id = 0; id < subMeshes.size(); ++id)
  {
    const auto& shared = sets.at("submesh_interface_nodes")->points;
    EXPECT_EQ(std::binary_search(shared.begin(), shared.end(), std::int32_t(id)), subMeshes[id].size() > 1);
  }
}

TEST_P(SecondOrder, FormatsWriteItOrRefuseIt)
{
  int written = 0;
  for (const ExportFormat& format : exportFormats())
  {
    const test::TemporaryFolder folder;
    if (format.hasSecondOrder) exportModel(second, folder.file("m" + format.extension));
    else EXPECT_THROW(exportModel(second, folder.file("m" + format.extension)), UsageError) << format.extension;
    EXPECT_EQ(folder.files().empty(), !format.hasSecondOrder);
    written += format.hasSecondOrder;
  }
  EXPECT_GE(written, 7);
}

INSTANTIATE_TEST_SUITE_P(RandomBlocks, SecondOrder, testing::Values(1, 2, 3));

} // namespace
} // namespace surgicalmesher
