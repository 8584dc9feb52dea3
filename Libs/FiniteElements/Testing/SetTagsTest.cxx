// SPDX-License-Identifier: Apache-2.0
#include "SetTags.h"

#include "../../Libs/TissueMap/Testing/TestFiles.h"
#include "Errors.h"
#include "Export.h"
#include "LabelledBlocks.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <numeric>
#include <set>

namespace surgicalmesher
{
namespace
{

using Triangle = Cell;

FiniteElementModel modelWithShells(unsigned seed)
{
  FiniteElementOptions options;
  options.shells = { { 1, -1, 0.5 }, { 2, 0, 0.75 } };
  return finiteElementModel(test::randomBlocks(seed), options);
}

std::multiset<Triangle> cornersOf(const std::vector<Triangle>& triangles)
{
  std::multiset<Triangle> corners;
  for (Triangle triangle : triangles)
  {
    std::sort(triangle.begin(), triangle.end());
    corners.insert(triangle);
  }
  return corners;
}

class TagsOfSets : public testing::TestWithParam<unsigned>
{
protected:
  const FiniteElementModel model = modelWithShells(GetParam());
  const SetTags tags = tagsOf(model);
};

TEST_P(TagsOfSets, AreLabelsForTissuesAndDifferForAllSets)
{
  std::multiset<std::int32_t> all(tags.elementSets.begin(), tags.elementSets.end());
  for (const FaceSet& set : tags.faceSets) all.insert(set.tag);
  all.insert(tags.nullDisplacement);
  EXPECT_EQ(std::set<std::int32_t>(all.begin(), all.end()).size(), all.size());
  EXPECT_GT(*all.begin(), 0);
  for (std::size_t s = 0; s < model.elementSets.size(); ++s)
  {
    const ElementSet& set = model.elementSets[s];
    if (set.kind == SetKind::Tissue) EXPECT_EQ(tags.elementSets[s], set.ids[0]);
    else EXPECT_GT(tags.elementSets[s], 4);
  }
}

TEST_P(TagsOfSets, AreTheSameOnBothSidesOfAnInterface)
{
  std::map<std::int32_t, std::multiset<Triangle>> faces;
  for (std::size_t i = 0; i < model.surfaces.size(); ++i)
  {
    const auto corners = cornersOf(model.surfaces[i].cells);
    EXPECT_EQ(faces.emplace(tags.surfaces[i], corners).first->second, corners) << model.surfaces[i].name;
  }
  EXPECT_LT(faces.size(), model.surfaces.size());
}

TEST_P(TagsOfSets, PiecesOfFacesAreDisjointAndMakeUpEverySet)
{
  std::map<std::int32_t, const FacePiece*> pieces;
  std::multiset<Triangle> all;
  for (const FacePiece& piece : tags.facePieces)
  {
    EXPECT_TRUE(pieces.emplace(piece.tag, &piece).second) << piece.name;
    all.merge(cornersOf(piece.cells));
  }
  EXPECT_EQ(std::set<Triangle>(all.begin(), all.end()).size(), all.size());
  for (const FaceSet& set : tags.faceSets)
  {
    std::multiset<Triangle> whole;
    for (const std::int32_t tag : piecesOf(tags, set.tag)) whole.merge(cornersOf(pieces.at(tag)->cells));
    EXPECT_EQ(whole, cornersOf(*set.cells)) << set.info->name;
  }
}

TEST_P(TagsOfSets, PieceOfOneInterfaceHasItsTagAndName)
{
  for (const FacePiece& piece : tags.facePieces)
  {
    std::vector<const FaceSet*> inner;
    for (const std::size_t s : piece.sets)
    {
      if (tags.faceSets[s].info->kind != SetKind::OuterBoundary) inner.push_back(&tags.faceSets[s]);
    }
    ASSERT_FALSE(inner.empty());
    EXPECT_EQ(piece.tag == inner[0]->tag, inner.size() == 1) << piece.name;
    EXPECT_EQ(piece.name == inner[0]->info->name, inner.size() == 1) << piece.name;
  }
}

TEST_P(TagsOfSets, PiecesOfTetrahedraAreDisjointAndMakeUpEverySet)
{
  std::vector<std::vector<std::int32_t>> members(model.elementSets.size());
  std::vector<std::int32_t> all;
  for (const ElementPiece& piece : tags.elementPieces)
  {
    all.insert(all.end(), piece.elements.begin(), piece.elements.end());
    ASSERT_EQ(model.elementSets[piece.sets[0]].kind, SetKind::Tissue);
    for (const std::size_t s : piece.sets)
    {
      members[s].insert(members[s].end(), piece.elements.begin(), piece.elements.end());
    }
  }
  std::sort(all.begin(), all.end());
  std::vector<std::int32_t> expected(model.content.mesh.tetrahedra.size());
  std::iota(expected.begin(), expected.end(), 0);
  EXPECT_EQ(all, expected);
  for (std::size_t s = 0; s < members.size(); ++s)
  {
    std::sort(members[s].begin(), members[s].end());
    EXPECT_EQ(members[s], model.elementSets[s].elements) << model.elementSets[s].name;
  }
}

INSTANTIATE_TEST_SUITE_P(RandomBlocks, TagsOfSets, testing::Range(1u, 4u));

/// Every file that a format writes, by name.
std::map<std::string, std::string> exported(const FiniteElementModel& model, const std::string& extension)
{
  const test::TemporaryFolder folder;
  exportModel(model, folder.file("m" + extension));
  std::map<std::string, std::string> files;
  for (const std::string& name : folder.files()) files[name] = test::readBytes(folder.file(name));
  return files;
}

TEST(Exports, HaveTheSameBytesTwice)
{
  const FiniteElementModel model = modelWithShells(1);
  for (const ExportFormat& format : exportFormats())
  {
    const auto files = exported(model, format.extension);
    EXPECT_EQ(files.count("m" + format.extension), 1u);
    EXPECT_EQ(files, exported(model, format.extension)) << format.extension;
  }
}

TEST(Exports, SayWhenTheDiskIsFull)
{
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  const FiniteElementModel model = modelWithShells(1);
  const test::TemporaryFolder folder;
  const Destination fullDisk = [&](const std::string& finalPath)
  {
    const std::string link = folder.file(finalPath);
    std::filesystem::create_symlink("/dev/full", link);
    return link;
  };
  for (const ExportFormat& format : exportFormats())
  {
    EXPECT_THROW(exportModel(model, "m" + format.extension, fullDisk), InputError) << format.extension;
  }
}

} // namespace
} // namespace surgicalmesher
