// SPDX-License-Identifier: Apache-2.0
#include "Report.h"

#include "JsonMember.h"
#include "MeshChecks.h"
#include "PrintableText.h"
#include "StiffnessConditioning.h"

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

rapidjson::Value stiffnessJSON(const StiffnessConditioning& conditioning, rapidjson::Document::AllocatorType& allocator)
{
  rapidjson::Value stiffness(rapidjson::kObjectType);
  stiffness.AddMember("unknowns", rapidjson::Value(std::uint64_t(conditioning.unknowns)), allocator);
  stiffness.AddMember("converged", rapidjson::Value(conditioning.converged), allocator);
  stiffness.AddMember("conditionNumber", rapidjson::Value(conditioning.condition), allocator);
  stiffness.AddMember("iterations", rapidjson::Value(conditioning.iterations), allocator);
  return stiffness;
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
  if (report.withConditioning)
  {
    auto& allocator = members.GetAllocator();
    members.AddMember("stiffness", stiffnessJSON(stiffnessConditioning(content.mesh), allocator), allocator);
  }
  members.Accept(json);
  json.Key("warnings");
  json.StartArray();
  for (const std::string& warning : report.warnings) json.String(printable(warning).c_str());
  json.EndArray();
  json.EndObject();
  return std::string(buffer.GetString()) + "\n";
}

std::string summaryOf(const QualityGroup& whole)
{
  std::ostringstream text;
  text.precision(4);
  text << whole.tetrahedra << " tetrahedra, " << whole.points << " points, dihedral angles " << whole.dihedral.minimum
       << " to " << whole.dihedral.maximum << " degrees, " << 100 * whole.edgesNearTarget
       << " % of edges within 0.7 to 1.4 of their target";
  return text.str();
}

} // namespace surgicalmesher
