// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Members of JSON objects, for any of RapidJSON's writers.

#include <string_view>
#include <type_traits>

namespace surgicalmesher
{

/// "key": value. `value` is a bool, an integer, a floating-point number or a text.
template <class Writer, class Value>
void writeMember(Writer& json, const char* key, const Value& value)
{
  json.Key(key);
  if constexpr (std::is_same_v<Value, bool>) json.Bool(value);
  else if constexpr (std::is_floating_point_v<Value>) json.Double(value);
  else if constexpr (std::is_integral_v<Value> && std::is_signed_v<Value>) json.Int64(value);
  else if constexpr (std::is_integral_v<Value>) json.Uint64(value);
  else
  {
    const std::string_view text = value;
    json.String(text.data(), static_cast<unsigned>(text.size()));
  }
}

} // namespace surgicalmesher
