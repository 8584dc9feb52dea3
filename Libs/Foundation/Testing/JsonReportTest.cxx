// SPDX-License-Identifier: Apache-2.0
#include "JsonReport.h"

#include <gtest/gtest.h>

#include <limits>

using namespace surgicalmesher;

TEST(JsonReport, HasNullForWhatIsNoNumber)
{
  constexpr double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  const auto writeMembers = [&](JsonWriter& json)
  {
    writeMember(json, "nan", nan);
    writeMember(json, "values", std::vector<double>{ 1.5, infinity });
    writeMember(json, "point", Vec3{ 0, -infinity, 2 });
  };
  EXPECT_EQ(jsonText(writeMembers, { 6, true }),
            "{\n    \"nan\": null,\n    \"values\": [1.5, null],\n    \"point\": [0.0, null, 2.0]\n}\n");
}
