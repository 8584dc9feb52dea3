// SPDX-License-Identifier: Apache-2.0
#include "FiniteElementModel.h"
#include "SetNames.h"
#include "SetTags.h"

#include <rapidjson/prettywriter.h>
#include <rapidjson/stringbuffer.h>

namespace surgicalmesher
{
namespace
{

using JsonWriter = rapidjson::PrettyWriter<rapidjson::StringBuffer>;

void write(JsonWriter& json, const char* key, const std::string& value)
{
  json.Key(key);
  json.String(validUtf8(value).c_str());
}

void write(JsonWriter& json, const char* key, double value)
{
  json.Key(key);
  json.Double(value);
}

/// Begins the set's object; the caller ends it.
void writeSet(JsonWriter& json, const SetInfo& set, const std::string& type, std::size_t size)
{
  json.StartObject();
  write(json, "name", set.name);
  write(json, "type", type);
  write(json, "kind", nameOf(set.kind));
  write(json, "original", set.original);
  json.SetFormatOptions(rapidjson::kFormatSingleLineArray);
  json.Key("ids");
  json.StartArray();
  for (const std::int32_t id : set.ids) json.Int(id);
  json.EndArray();
  json.Key("color");
  json.StartArray();
  for (const double channel : set.color) json.Double(channel);
  json.EndArray();
  json.SetFormatOptions(rapidjson::kFormatDefault);
  json.Key("size");
  json.Uint64(size);
}

void writeTag(JsonWriter& json, std::int32_t tag)
{
  json.Key("tag");
  json.Int(tag);
}

/// And the tags of the disjoint pieces that formats with one number per face know.
void writeFaceTags(JsonWriter& json, const SetTags& tags, std::int32_t tag)
{
  writeTag(json, tag);
  json.Key("faceTags");
  json.SetFormatOptions(rapidjson::kFormatSingleLineArray);
  json.StartArray();
  for (const std::int32_t piece : piecesOf(tags, tag)) json.Int(piece);
  json.EndArray();
  json.SetFormatOptions(rapidjson::kFormatDefault);
}

void writeSets(JsonWriter& json, const FiniteElementModel& model)
{
  const SetTags tags = tagsOf(model);
  json.Key("sets");
  json.StartArray();
  for (std::size_t i = 0; i < model.elementSets.size(); ++i)
  {
    writeSet(json, model.elementSets[i], "elements", model.elementSets[i].tetrahedra.size());
    writeTag(json, tags.elementSets[i]);
    json.EndObject();
  }
  for (std::size_t i = 0; i < model.surfaces.size(); ++i)
  {
    writeSet(json, model.surfaces[i], "faces", model.surfaces[i].faces.size());
    write(json, "nodes", model.surfaces[i].nodeSet);
    writeFaceTags(json, tags, tags.surfaces[i]);
    json.EndObject();
  }
  for (const NodeSet& set : model.nodeSets)
  {
    writeSet(json, set, "nodes", set.points.size());
    if (set.kind == SetKind::NullDisplacement) writeTag(json, tags.nullDisplacement);
    json.EndObject();
  }
  for (std::size_t i = 0; i < model.shells.size(); ++i)
  {
    const Shell& shell = model.shells[i];
    writeSet(json, shell, "shell", shell.triangles.size());
    write(json, "thickness", shell.thickness);
    write(json, "material", model.materials[shell.material].name);
    writeFaceTags(json, tags, tags.shells[i]);
    json.EndObject();
  }
  json.EndArray();
}

void writeMaterials(JsonWriter& json, const FiniteElementModel& model)
{
  json.Key("materials");
  json.StartArray();
  for (const Material& material : model.materials)
  {
    json.StartObject();
    write(json, "name", material.name);
    write(json, "law", std::string(material.law == MaterialLaw::NeoHookean ? "neo-Hookean" : "linear elastic"));
    write(json, "youngsModulus", material.youngsModulus);
    write(json, "poissonsRatio", material.poissonsRatio);
    write(json, "density", material.density);
    json.EndObject();
  }
  json.EndArray();
  json.Key("sections");
  json.StartArray();
  for (const Section& section : model.sections)
  {
    json.StartObject();
    write(json, "elements", model.elementSets[section.elementSet].name);
    write(json, "material", model.materials[section.material].name);
    json.EndObject();
  }
  json.EndArray();
}

} // namespace

std::string setNamesJSON(const FiniteElementModel& model)
{
  rapidjson::StringBuffer buffer;
  JsonWriter json(buffer);
  json.StartObject();
  json.Key("units");
  json.StartObject();
  write(json, "length", std::string("mm"));
  write(json, "stress", std::string("MPa"));
  write(json, "density", std::string("tonne/mm^3"));
  json.EndObject();
  writeSets(json, model);
  writeMaterials(json, model);
  json.EndObject();
  return std::string(buffer.GetString()) + "\n";
}

} // namespace surgicalmesher
