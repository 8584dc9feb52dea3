// SPDX-License-Identifier: Apache-2.0
#include "SurfaceEdgeLength.h"
#include "Errors.h"

#include <gtest/gtest.h>

namespace surgicalmesher
{
namespace
{

TEST(EdgeLengthFromPoints, IsThatOfTheNearestPoint)
{
  const SizingFunction length = edgeLengthFromPoints({ { 0, 0, 0 }, { 10, 0, 0 }, { 0, 10, 0 } }, { 1, 2, 3 });
  EXPECT_EQ(length({ 4.9, 0, 0 }), 1);
  EXPECT_EQ(length({ 5.1, 0, 0 }), 2);
  EXPECT_EQ(length({ -50, 90, 3 }), 3);
}

TEST(RequireCover, NamesTheFirstPointOutside)
{
  ScaleField scale;
  scale.grid.size = { 2, 2, 2 };
  scale.grid.spacing = { 10, 10, 10 };
  scale.lengths.assign(8, 1);
  EXPECT_NO_THROW(requireCover(scale, { { -5.4, -5, -5 }, { 15, 15, 15.4 } }, "scale.nrrd"));
  try
  {
    requireCover(scale, { { 0, 0, 0 }, { 0, 15.6, 0 } }, "scale.nrrd");
    FAIL();
  }
  catch (const InputError& error)
  {
    EXPECT_NE(std::string(error.what()).find("(0, 15.6, 0) mm"), std::string::npos) << error.what();
  }
}

} // namespace
} // namespace surgicalmesher
