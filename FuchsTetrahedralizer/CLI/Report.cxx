// SPDX-License-Identifier: Apache-2.0
#include "Report.h"

#include "JsonMember.h"
#include "MeshChecks.h"
#include "PrintableText.h"
#include "SolverReport.h"

#include <rapidjson/document.h>
#include <rapidjson/prettywriter.h>
#include <rapidjson/stringbuffer.h>

#include <sstream>

namespace surgicalmesher
{

namespace
{

using JsonWriter = rapidjson::PrettyWriter<rapidjson::StringBuffer>;

void writeSubMeshes(JsonWriter& json, const SubMeshes& division)
{
  json.Key("subMeshes");
  json.StartObject();
  writeMember(json, "children", division.children);
  writeMember(json, "pieces", division.pieces);
  writeMember(json, "interfacePoints", division.interfacePoints);
  json.EndObject();
}

void writeTopology(JsonWriter& json, const TetMesh& mesh)
{
  writeObjects(json, "topology", meshTopology(mesh),
               [&](const auto& tissue)
               {
                 const auto& [label, betti] = tissue;
                 writeMember(json, "label", label);
                 writeMember(json, "components", betti.components);
                 writeMember(json, "tunnels", betti.tunnels);
                 writeMember(json, "cavities", betti.cavities);
               });
}

/// The JSON object `text` as a member.
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
  rapidjson::StringBuffer buffer;
  JsonWriter json(buffer);
  json.StartObject();
  writeMember(json, "start", report.fromBackground ? "ambient tetrahedra" : "constrained Delaunay");
  writeSubMeshes(json, report.mesh.division);
  writeTopology(json, content.mesh);
  json.Key("quality");
  rapidjson::Document members;
  members.Parse(qualityJSON(report.quality, content.tissues).c_str());
  addMember(members, "explicit", explicitJSON(content, report.steps));
  if (report.conditioning) addMember(members, "stiffness", stiffnessJSON(*report.conditioning, content.tissues));
  members.Accept(json);
  json.Key("warnings");
  json.StartArray();
  for (const std::string& warning : report.warnings) json.String(printable(warning).c_str());
  json.EndArray();
  json.EndObject();
  return std::string(buffer.GetString()) + "\n";
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
