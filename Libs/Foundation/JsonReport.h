// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The reports that programs write, as JSON text: what they have in common.

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
  int decimals = JsonWriter::kDefaultMaxDecimalPlaces; ///< places of numbers behind the point, at most
  bool arraysInOneLine = false;
};

/// The text of one object, whose members writeMembers(json) writes, and the end of its last line.
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

/// "warnings", as the terminal had them.
inline void writeWarnings(JsonWriter& json, const std::vector<std::string>& warnings)
{
  json.Key("warnings");
  json.StartArray();
  for (const std::string& warning : warnings) writeValue(json, printable(warning));
  json.EndArray();
}

} // namespace surgicalmesher
