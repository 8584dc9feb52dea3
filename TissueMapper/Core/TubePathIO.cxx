// SPDX-License-Identifier: Apache-2.0
#include "TubePathIO.h"

#include "JsonReport.h"
#include "TextFile.h"
#include "TissueMapIO.h"

namespace surgicalmesher
{

namespace
{

void writeControlPoint(JsonWriter& json, const Vec3& point, std::size_t number)
{
  json.StartObject();
  writeMember(json, "id", std::to_string(number));
  writeMember(json, "position", point);
  writeMember(json, "positionStatus", "defined");
  json.EndObject();
}

void writeMeasurement(JsonWriter& json, const std::string& name, const std::string& units,
                      const std::vector<double>& values)
{
  json.StartObject();
  writeMember(json, "name", name);
  writeMember(json, "enabled", true);
  writeMember(json, "units", units);
  writeMember(json, "controlPointValues", values);
  json.EndObject();
}

} // namespace

void writeTubePath(const TubePath& tube, const std::string& name, const std::string& file)
{
  const auto writeMembers = [&](JsonWriter& json)
  {
    writeMember(json, "@schema",
                "https://raw.githubusercontent.com/slicer/slicer/master/Modules/Loadable/Markups/Resources/Schema/"
                "markups-schema-v1.0.3.json#");
    json.Key("markups");
    json.StartArray();
    json.StartObject();
    writeMember(json, "type", "Curve");
    writeMember(json, "name", name);
    writeMember(json, "coordinateSystem", "LPS");
    writeMember(json, "coordinateUnits", "mm");
    json.Key("controlPoints");
    json.StartArray();
    for (std::size_t n = 0; n < tube.points.size(); ++n) writeControlPoint(json, tube.points[n], n + 1);
    json.EndArray();
    json.Key("measurements");
    json.StartArray();
    writeMeasurement(json, "Radius", "mm", tube.radii);
    writeMeasurement(json, "Flux", "", tube.flux);
    json.EndArray();
    json.EndObject();
    json.EndArray();
  };
  writeBytes(jsonText(writeMembers, { 6, true }), file);
}

std::vector<TubePath> readTubePaths(const std::string& file, double missingRadius)
{
  std::vector<TubePath> tubes;
  for (const Markup& markup : readLabelledMarkups(file))
  {
    TubePath tube;
    tube.points = markup.points;
    tube.radii.assign(markup.points.size(), missingRadius);
    tube.flux.assign(markup.points.size(), 0);
    const auto radius = markup.pointValues.find("Radius");
    const auto flux = markup.pointValues.find("Flux");
    if (radius != markup.pointValues.end()) tube.radii = radius->second;
    if (flux != markup.pointValues.end()) tube.flux = flux->second;
    tubes.push_back(tube);
  }
  return tubes;
}

} // namespace surgicalmesher
