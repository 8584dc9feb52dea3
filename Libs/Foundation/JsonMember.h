// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Members of JSON objects, for any of RapidJSON's writers.

#include "PrintableText.h"
#include "Vec3.h"

#include <cmath>
#include <string>
#include <string_view>
#include <type_traits>

namespace surgicalmesher
{

/// Writes a bool, an integer, a floating-point number, a text, a point, or a range of such values. Points and ranges
/// become arrays; NaN and infinity, which JSON does not have, become null. Text that is not UTF-8, as paths may be, is
/// made printable.
template <class Writer, class Value>
void writeValue(Writer& json, const Value& value)
{
  if constexpr (std::is_same_v<Value, bool>) json.Bool(value);
  else if constexpr (std::is_floating_point_v<Value>)
  {
    if (std::isfinite(value)) json.Double(value);
    else json.Null();
  }
  else if constexpr (std::is_integral_v<Value> && std::is_signed_v<Value>) json.Int64(value);
  else if constexpr (std::is_integral_v<Value>) json.Uint64(value);
  else if constexpr (std::is_convertible_v<const Value&, std::string_view>)
  {
    std::string text(std::string_view{ value });
    if (!isUTF8(text)) text = printable(text);
    json.String(text.data(), static_cast<unsigned>(text.size()));
  }
  else if constexpr (std::is_same_v<Value, Vec3>)
  {
    json.StartArray();
    for (int axis = 0; axis < 3; ++axis) writeValue(json, value[axis]);
    json.EndArray();
  }
  else
  {
    json.StartArray();
    for (const auto& item : value) writeValue(json, item);
    json.EndArray();
  }
}

/// Writes "key": value; for the types see writeValue().
template <class Writer, class Value>
void writeMember(Writer& json, const char* key, const Value& value)
{
  json.Key(key);
  writeValue(json, value);
}

/// Writes "key": an object, whose members writeMembers() writes.
template <class Writer, class WriteMembers>
void writeObject(Writer& json, const char* key, const WriteMembers& writeMembers)
{
  json.Key(key);
  json.StartObject();
  writeMembers();
  json.EndObject();
}

/// Writes "key": an array with one object per item, whose members writeItem(item) writes.
template <class Writer, class Items, class WriteItem>
void writeObjects(Writer& json, const char* key, const Items& items, const WriteItem& writeItem)
{
  json.Key(key);
  json.StartArray();
  for (const auto& item : items)
  {
    json.StartObject();
    writeItem(item);
    json.EndObject();
  }
  json.EndArray();
}

} // namespace surgicalmesher
