// SPDX-License-Identifier: Apache-2.0
#include "VolumeOffsets.h"

#include <gtest/gtest.h>

using namespace surgicalmesher;

namespace
{
/// Two tissues that share 4, with 6 and 10 towards the background.
const std::map<std::pair<Label, Label>, double> areas = { { { 0, 1 }, 6 }, { { 0, 2 }, 10 }, { { 1, 2 }, 4 } };
} // namespace

TEST(VolumeOffsets, GiveEveryTissueWhatItLacks)
{
  const std::map<Label, double> lacking = { { 0, -0.1 }, { 1, 0.5 }, { 2, -0.4 } };
  const std::map<Label, double> offsets = offsetsForVolumes(lacking, areas, 1);
  const double first = offsets.at(1), second = offsets.at(2);
  EXPECT_NEAR(6 * first + 4 * (first - second), 0.5, 1e-6);
  EXPECT_NEAR(10 * second + 4 * (second - first), -0.4, 1e-6);
  EXPECT_EQ(offsets.at(0), 0) << "the background has no volume to keep";
}

TEST(VolumeOffsets, AreNeverFartherThanAsked)
{
  const std::map<Label, double> offsets = offsetsForVolumes({ { 1, 50 }, { 2, -50 } }, areas, 0.25);
  EXPECT_EQ(offsets.at(1), 0.25);
  EXPECT_EQ(offsets.at(2), -0.25);
}

TEST(VolumeOffsets, WithoutFacesThereAreNone)
{
  const std::map<Label, double> offsets = offsetsForVolumes({ { 1, 5 } }, {}, 1);
  EXPECT_EQ(offsets.count(1), 0u);
}
