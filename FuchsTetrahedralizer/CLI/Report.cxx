// SPDX-License-Identifier: Apache-2.0
#include "Report.h"

#include "JsonReport.h"
#include "SolverReport.h"

#include <rapidjson/document.h>

#include <sstream>

namespace surgicalmesher
{

namespace
{

void writeSubMeshes(JsonWriter& json, const SubMeshes& division)
{
  writeObject(json, "subMeshes",
              [&]
              {
                writeMember(json, "children", division.children);
                writeMember(json, "pieces", division.pieces);
                writeMember(json, "interfacePoints", division.interfacePoints);
              });
}

void writeTopology(JsonWriter& json, const std::map<Label, Betti>& topology)
{
  writeObjects(json, "topology", topology,
               [&](const auto& tissue)
               {
                 const auto& [label, betti] = tissue;
                 writeMember(json, "label", label);
                 writeMember(json, "components", betti.components);
                 writeMember(json, "tunnels", betti.tunnels);
                 writeMember(json, "cavities", betti.cavities);
               });
}

/// Adds the JSON object `text` as a member.
void addMember(rapidjson::Document& object, const char* key, const std::string& text)
{
  rapidjson::Document member(&object.GetAllocator());
  member.Parse(text.c_str());
  object.AddMember(rapidjson::StringRef(key), member, object.GetAllocator());
}

} // namespace

std::string reportJson(const MeshReport& report)
{
  const MeshFile& content = report.mesh.content;
  rapidjson::Document members;
  members.Parse(qualityJSON(report.quality, content.tissues).c_str());
  addMember(members, "explicit", explicitJSON(content, report.steps));
  if (report.conditioning) addMember(members, "stiffness", stiffnessJSON(*report.conditioning, content.tissues));
  return jsonText(
    [&](JsonWriter& json)
    {
      writeMember(json, "start", report.fromBackground ? "ambient tetrahedra" : "constrained Delaunay");
      writeSubMeshes(json, report.mesh.division);
      writeTopology(json, report.topology);
      json.Key("quality");
      members.Accept(json);
      writeWarnings(json, report.warnings);
    });
}

std::string summaryOf(const MeshReport& report)
{
  const QualityGroup& whole = report.quality.whole;
  std::ostringstream text;
  text.precision(4);
  text << whole.tetrahedra << " tetrahedra, " << whole.points << " points, dihedral angles " << whole.dihedral.minimum
       << " to " << whole.dihedral.maximum << " degrees, " << 100 * whole.edgesNearTarget
       << " % of edges within 0.7 to 1.4 of their target, least height " << whole.height.minimum
       << " mm, explicit step " << smallestStep(report.steps) << " s";
  if (report.conditioning) text << "; " << summaryOf(*report.conditioning);
  return text.str();
}

} // namespace surgicalmesher
