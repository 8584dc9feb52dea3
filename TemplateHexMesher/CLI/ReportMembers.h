// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What the reports of both programs say about elements and distances.

#include "ElementQuality.h"
#include "JsonReport.h"
#include "SurfaceDistance.h"
#include "TextFile.h"

namespace surgicalmesher
{

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
  writeBytes(jsonText(writeMembers, { 6 }), file);
}

} // namespace surgicalmesher
