// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Shared parts of the JSON reports that the programs write.

#include "JsonMember.h"
#include "PrintableText.h"

#include <rapidjson/prettywriter.h>
#include <rapidjson/stringbuffer.h>

#include <string>
#include <vector>

namespace surgicalmesher
{

using JsonWriter = rapidjson::PrettyWriter<rapidjson::StringBuffer>;

struct JsonStyle
{
  int decimals = JsonWriter::kDefaultMaxDecimalPlaces; ///< most digits after the decimal point
  bool arraysInOneLine = false;
};

/// Returns the text of one JSON object, whose members writeMembers(json) writes, with a line end.
template <class WriteMembers>
std::string jsonText(const WriteMembers& writeMembers, const JsonStyle& style = {})
{
  rapidjson::StringBuffer buffer;
  JsonWriter json(buffer);
  json.SetMaxDecimalPlaces(style.decimals);
  if (style.arraysInOneLine) json.SetFormatOptions(rapidjson::kFormatSingleLineArray);
  json.StartObject();
  writeMembers(json);
  json.EndObject();
  return std::string(buffer.GetString(), buffer.GetSize()) + "\n";
}

/// Writes the member "warnings": the texts as the terminal shows them.
inline void writeWarnings(JsonWriter& json, const std::vector<std::string>& warnings)
{
  json.Key("warnings");
  json.StartArray();
  for (const std::string& warning : warnings) writeValue(json, printable(warning));
  json.EndArray();
}

} // namespace surgicalmesher
