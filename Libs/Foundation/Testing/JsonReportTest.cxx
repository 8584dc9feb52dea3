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

TEST(JsonReport, IsUTF8WhateverAPathIs)
{
  const auto writeMembers = [](JsonWriter& json)
  {
    writeMember(json, "latin",
                std::string("sch\xE4"
                            "del.nrrd"));
    writeMember(json, "utf8",
                std::string("sch\xC3\xA4"
                            "del.nrrd"));
  };
  EXPECT_EQ(jsonText(writeMembers), "{\n    \"latin\": \"sch\\\\xe4del.nrrd\",\n"
                                    "    \"utf8\": \"sch\xC3\xA4"
                                    "del.nrrd\"\n}\n");
}
