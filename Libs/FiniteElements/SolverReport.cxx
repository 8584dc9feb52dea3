// SPDX-License-Identifier: Apache-2.0
#include "SolverReport.h"

#include "JsonMember.h"
#include "SmallestTetrahedra.h"

#include <rapidjson/stringbuffer.h>
#include <rapidjson/writer.h>

#include <sstream>

namespace surgicalmesher
{
namespace
{

using Writer = rapidjson::Writer<rapidjson::StringBuffer>;

void writeTissue(Writer& json, Label label, const TissueTable& tissues)
{
  const auto found = tissues.find(label);
  writeMember(json, "label", label);
  writeMember(json, "name", found == tissues.end() ? std::string() : found->second.name);
}

void writeSteps(Writer& json, const std::map<Label, ExplicitStep>& steps, const TissueTable& tissues)
{
  writeObjects(json, "tissues", steps,
               [&](const auto& tissue)
               {
                 writeTissue(json, tissue.first, tissues);
                 writeMember(json, "leastHeight", tissue.second.leastHeight);
                 writeMember(json, "step", tissue.second.step);
                 writeMember(json, "tetrahedron", tissue.second.tetrahedron);
               });
}

void writeSmallest(Writer& json, const MeshFile& content)
{
  writeObjects(json, "smallest", smallestTetrahedra(content),
               [&](const SmallTetrahedron& small)
               {
                 writeMember(json, "tetrahedron", small.tetrahedron);
                 writeTissue(json, content.mesh.labels[small.tetrahedron], content.tissues);
                 writeMember(json, "height", small.height);
                 writeMember(json, "edgeLength", small.edgeLength);
                 writeMember(json, "tissueThickness", small.thickness);
                 writeMember(json, "place", small.place);
                 writeMember(json, "reason", nameOf(small.reason));
               });
}

} // namespace

std::string explicitJSON(const MeshFile& content, const std::map<Label, ExplicitStep>& steps)
{
  rapidjson::StringBuffer buffer;
  Writer json(buffer);
  json.StartObject();
  writeMember(json, "step", smallestStep(steps));
  writeSteps(json, steps, content.tissues);
  writeSmallest(json, content);
  json.EndObject();
  return buffer.GetString();
}

std::string stiffnessJSON(const StiffnessConditioning& conditioning, const TissueTable& tissues)
{
  rapidjson::StringBuffer buffer;
  Writer json(buffer);
  json.StartObject();
  writeMember(json, "unknowns", conditioning.unknowns);
  writeMember(json, "converged", conditioning.converged);
  writeMember(json, "conditionNumber", conditioning.condition);
  writeMember(json, "smallestEigenvalue", conditioning.smallestEigenvalue);
  writeMember(json, "largestEigenvalue", conditioning.largestEigenvalue);
  writeMember(json, "iterations", conditioning.iterations);
  writeMember(json, "iterationsPerCubeRoot", conditioning.iterationsPerCubeRoot);
  writeObjects(json, "localModes", conditioning.localModes,
               [&](const LocalMode& mode)
               {
                 writeTissue(json, mode.label, tissues);
                 writeMember(json, "eigenvalue", mode.eigenvalue);
                 writeMember(json, "nodeShare", mode.nodeShare);
                 writeMember(json, "place", mode.place);
               });
  json.EndObject();
  return buffer.GetString();
}

std::string summaryOf(const StiffnessConditioning& conditioning)
{
  if (!conditioning.converged) return "conjugate gradients do not converge: the mesh can swing around what is held";
  std::ostringstream text;
  text.precision(4);
  text << "condition number " << conditioning.condition << " (eigenvalues " << conditioning.smallestEigenvalue << " to "
       << conditioning.largestEigenvalue << "), " << conditioning.iterations << " iterations, "
       << conditioning.iterationsPerCubeRoot << " over the cube root of " << conditioning.unknowns << " unknowns, "
       << conditioning.localModes.size() << " local modes";
  return text.str();
}

} // namespace surgicalmesher
