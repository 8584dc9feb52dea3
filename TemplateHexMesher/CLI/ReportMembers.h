// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Members on elements and distances that the reports of both programs share.

#include "ElementQuality.h"
#include "JsonReport.h"
#include "SurfaceDistance.h"
#include "TextFile.h"

namespace surgicalmesher
{

/// Writes the members of the summary into the current object.
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

/// Writes a report of one object whose members writeMembers(json) writes. Throws InputError if it cannot be written in
/// full.
template <class WriteMembers>
void writeReportFile(const std::string& file, const WriteMembers& writeMembers)
{
  writeBytes(jsonText(writeMembers, { 6 }), file);
}

} // namespace surgicalmesher
