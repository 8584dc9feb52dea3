// SPDX-License-Identifier: Apache-2.0
#include "TextNumbers.h"

#include <rapidjson/stringbuffer.h>
#include <rapidjson/writer.h>

#include <locale>
#include <sstream>

namespace surgicalmesher
{
namespace
{

std::string rounded(double value, int digits)
{
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text.precision(digits);
  text << value;
  return text.str();
}

std::string withPoint(std::string number)
{
  const std::size_t exponent = number.find('e');
  if (number.find('.') == std::string::npos)
    number.insert(exponent == std::string::npos ? number.size() : exponent, ".");
  return number;
}

} // namespace

std::string textOf(double value, std::size_t length)
{
  rapidjson::StringBuffer buffer;
  rapidjson::Writer<rapidjson::StringBuffer> writer(buffer);
  writer.Double(value);
  if (buffer.GetSize() <= length) return buffer.GetString();
  return rounded(value, 13);
}

std::string textWithin(double value, std::size_t width)
{
  std::string text = withPoint(textOf(value));
  for (int digits = 15; text.size() > width; --digits) text = withPoint(rounded(value, digits));
  return text;
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
