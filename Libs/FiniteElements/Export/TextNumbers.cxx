// SPDX-License-Identifier: Apache-2.0
#include "TextNumbers.h"

#include <rapidjson/stringbuffer.h>
#include <rapidjson/writer.h>

#include <locale>
#include <sstream>

namespace surgicalmesher
{

std::string textOf(double value, std::size_t length)
{
  rapidjson::StringBuffer buffer;
  rapidjson::Writer<rapidjson::StringBuffer> writer(buffer);
  writer.Double(value);
  if (buffer.GetSize() <= length) return buffer.GetString();
  std::ostringstream rounded;
  rounded.imbue(std::locale::classic());
  rounded.precision(13);
  rounded << value;
  return rounded.str();
}

void appendIds(std::string& text, const std::vector<std::int32_t>& ids, std::size_t perLine, const std::string& lineEnd)
{
  for (std::size_t i = 0; i < ids.size(); ++i)
  {
    text += std::to_string(ids[i] + 1);
    const bool last = i + 1 == ids.size(), full = (i + 1) % perLine == 0;
    text += last ? "\n" : full ? lineEnd + "\n" : ", ";
  }
}

} // namespace surgicalmesher
