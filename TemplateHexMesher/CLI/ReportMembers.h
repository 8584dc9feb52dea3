// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What the reports of both programs say about elements and distances.

#include "ElementQuality.h"
#include "Errors.h"
#include "JsonMember.h"
#include "SurfaceDistance.h"

#include <rapidjson/ostreamwrapper.h>
#include <rapidjson/prettywriter.h>

#include <fstream>

namespace surgicalmesher
{

using JsonWriter = rapidjson::PrettyWriter<rapidjson::OStreamWrapper>;

/// Into an object.
inline void writeQuality(JsonWriter& json, const QualitySummary& quality)
{
  writeMember(json, "elements", quality.elements);
  writeMember(json, "invalid", quality.invalid);
  writeMember(json, "minimumScaledJacobian", quality.minimum);
  writeMember(json, "meanScaledJacobian", quality.mean);
  writeMember(json, "meanShapeSkew", quality.meanShapeSkew);
  writeMember(json, "histogramOfMinimum", quality.histogram);
}

inline void writeDistance(JsonWriter& json, const char* key, const DistanceSummary& distance)
{
  json.Key(key);
  json.StartObject();
  writeMember(json, "mean", distance.mean);
  writeMember(json, "percentile95", distance.percentile95);
  writeMember(json, "maximum", distance.maximum);
  json.EndObject();
}

/// One object, whose members writeMembers(json) writes. Throws InputError unless it arrives whole.
template <class WriteMembers>
void writeReportFile(const std::string& file, const WriteMembers& writeMembers)
{
  std::ofstream stream(file.c_str(), std::ios::binary);
  rapidjson::OStreamWrapper wrapper(stream);
  JsonWriter json(wrapper);
  json.SetMaxDecimalPlaces(6);
  json.StartObject();
  writeMembers(json);
  json.EndObject();
  stream << '\n' << std::flush;
  if (!stream) throw InputError(file + ": the report cannot be written whole");
}

} // namespace surgicalmesher
