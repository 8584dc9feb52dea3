// SPDX-License-Identifier: Apache-2.0
#include "FiniteElementModel.h"
#include "JsonReport.h"
#include "SetNames.h"
#include "SetTags.h"

namespace surgicalmesher
{
namespace
{

void write(JsonWriter& json, const char* key, const std::string& value) { writeMember(json, key, validUtf8(value)); }

/// Begins the object of a set; the caller ends it.
void writeSet(JsonWriter& json, const SetInfo& set, const std::string& type, std::size_t size)
{
  json.StartObject();
  write(json, "name", set.name);
  write(json, "type", type);
  write(json, "kind", nameOf(set.kind));
  write(json, "original", set.original);
  json.SetFormatOptions(rapidjson::kFormatSingleLineArray);
  writeMember(json, "ids", set.ids);
  writeMember(json, "color", set.color);
  json.SetFormatOptions(rapidjson::kFormatDefault);
  writeMember(json, "size", size);
}

/// Writes the tag of a face set and the tags of its disjoint pieces, for formats with one number per face.
void writeFaceTags(JsonWriter& json, const SetTags& tags, std::int32_t tag)
{
  writeMember(json, "tag", tag);
  json.SetFormatOptions(rapidjson::kFormatSingleLineArray);
  writeMember(json, "faceTags", piecesOf(tags, tag));
  json.SetFormatOptions(rapidjson::kFormatDefault);
}

void writeSets(JsonWriter& json, const FiniteElementModel& model)
{
  const SetTags tags = tagsOf(model);
  json.Key("sets");
  json.StartArray();
  for (std::size_t i = 0; i < model.elementSets.size(); ++i)
  {
    writeSet(json, model.elementSets[i], "elements", model.elementSets[i].elements.size());
    writeMember(json, "tag", tags.elementSets[i]);
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
    if (set.kind == SetKind::NullDisplacement) writeMember(json, "tag", tags.nullDisplacement);
    json.EndObject();
  }
  for (std::size_t i = 0; i < model.shells.size(); ++i)
  {
    const Shell& shell = model.shells[i];
    writeSet(json, shell, "shell", shell.cells.size());
    writeMember(json, "thickness", shell.thickness);
    write(json, "material", model.materials[shell.material].name);
    writeFaceTags(json, tags, tags.shells[i]);
    json.EndObject();
  }
  for (std::size_t i = 0; i < model.beams.size(); ++i)
  {
    const Beam& beam = model.beams[i];
    writeSet(json, beam, beam.isTruss ? "truss" : "beam", beam.edges.size());
    writeMember(json, "radius", beam.radius);
    write(json, "material", model.materials[beam.material].name);
    writeMember(json, "tag", tags.beams[i]);
    json.EndObject();
  }
  json.EndArray();
}

void writeMaterials(JsonWriter& json, const FiniteElementModel& model)
{
  writeObjects(json, "materials", model.materials,
               [&](const Material& material)
               {
                 write(json, "name", material.name);
                 writeMember(json, "law", material.law == MaterialLaw::NeoHookean ? "neo-Hookean" : "linear elastic");
                 writeMember(json, "youngsModulus", material.youngsModulus);
                 writeMember(json, "poissonsRatio", material.poissonsRatio);
                 writeMember(json, "density", material.density);
               });
  writeObjects(json, "sections", model.sections,
               [&](const Section& section)
               {
                 write(json, "elements", model.elementSets[section.elementSet].name);
                 write(json, "material", model.materials[section.material].name);
               });
}

} // namespace

std::string setNamesJSON(const FiniteElementModel& model)
{
  const auto writeMembers = [&](JsonWriter& json)
  {
    writeObject(json, "units",
                [&]
                {
                  const bool si = model.units == Units::SI;
                  writeMember(json, "length", si ? "m" : "mm");
                  writeMember(json, "stress", si ? "Pa" : "MPa");
                  writeMember(json, "density", si ? "kg/m^3" : "tonne/mm^3");
                });
    writeSets(json, model);
    writeMaterials(json, model);
  };
  return jsonText(writeMembers);
}

} // namespace surgicalmesher
