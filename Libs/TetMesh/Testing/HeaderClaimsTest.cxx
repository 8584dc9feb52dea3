// SPDX-License-Identifier: Apache-2.0
#include "HeaderClaims.h"
#include "Errors.h"
#include "TextFile.h"

#include <gtest/gtest.h>

#include <filesystem>

namespace surgicalmesher
{
namespace
{

std::string written(const std::string& content)
{
  const std::string file = (std::filesystem::path(testing::TempDir()) / "HeaderClaimsTest.stl").string();
  writeBytes(content, file);
  return file;
}

/// A binary STL of one triangle whose header claims `count` of them.
std::string binarySTL(std::string title, char count)
{
  title.resize(80, ' ');
  return title + std::string({ count, count, 0, 0 }) + std::string(50, '\0');
}

} // namespace

TEST(HeaderClaims, OfABinarySTLCountWhateverItsTitle)
{
  for (const char* title : { "solid part", "part" })
  {
    EXPECT_THROW(requireCredibleHeader(written(binarySTL(title, 1))), InputError) << title; // 257 triangles
    EXPECT_NO_THROW(requireCredibleHeader(written(binarySTL(title, 0)))) << title;
  }
  EXPECT_NO_THROW(requireCredibleHeader(written("solid part\n" + std::string(200, ' ') + "endsolid part\n")));
}

} // namespace surgicalmesher
