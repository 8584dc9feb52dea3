// SPDX-License-Identifier: Apache-2.0
#include "Text.h"

#include "PrintableText.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <locale>
#include <sstream>

namespace surgicalmesher
{
namespace text
{

namespace
{

const char* const blanks = " \t\r\n";

/// Splits at separators outside double quotes, within which "" stands for a quote. With `merge`, runs of separators
/// count as one.
template <typename IsSeparator>
std::vector<std::string> splitQuoted(const std::string& line, bool merge, IsSeparator isSeparator)
{
  std::vector<std::string> parts;
  std::string part;
  bool quoted = false;
  bool started = false;
  const auto finish = [&]()
  {
    if (started || !merge) parts.push_back(part);
    part.clear();
    started = false;
  };
  for (std::size_t i = 0; i < line.size(); ++i)
  {
    const char c = line[i];
    if (c == '"')
    {
      if (quoted && i + 1 < line.size() && line[i + 1] == '"') part += line[++i];
      else quoted = !quoted;
      started = true;
    }
    else if (!quoted && isSeparator(c))
    {
      finish();
    }
    else
    {
      part += c;
      started = true;
    }
  }
  finish();
  return parts;
}

} // namespace

std::string trimmed(const std::string& text)
{
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == std::string::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

std::string lowerCase(std::string text)
{
  for (char& c : text)
  {
    if (c >= 'A' && c <= 'Z') c = char(c - 'A' + 'a');
  }
  return text;
}

std::string oneLine(const std::string& text)
{
  std::istringstream stream(text);
  std::string line;
  for (std::string word; stream >> word;) line += (line.empty() ? "" : " ") + word;
  return line;
}

std::string legible(const std::string& text)
{
  std::string result;
  for (std::size_t i = 0; i < text.size();)
  {
    const std::size_t length = utf8Length(text, i);
    const auto first = static_cast<unsigned char>(text[i]);
    if (length == 0) result += '?';
    else if (first < 0x20 || first == 0x7f) result += ' ';
    else result += text.substr(i, length);
    i += std::max<std::size_t>(length, 1);
  }
  return result;
}

std::string xmlEscaped(const std::string& text)
{
  std::string result;
  for (const char c : text)
  {
    if (c == '&') result += "&amp;";
    else if (c == '<') result += "&lt;";
    else if (c == '>') result += "&gt;";
    else if (c == '"') result += "&quot;";
    else result += c;
  }
  return result;
}

std::string extensionOf(const std::string& file) { return lowerCase(std::filesystem::path(file).extension().string()); }

std::vector<std::string> split(const std::string& text, char separator)
{
  std::vector<std::string> parts;
  if (text.empty()) return parts;
  std::size_t start = 0;
  for (std::size_t end; (end = text.find(separator, start)) != std::string::npos; start = end + 1)
  {
    parts.push_back(text.substr(start, end - start));
  }
  parts.push_back(text.substr(start));
  return parts;
}

std::string joined(const std::vector<std::string>& parts, const std::string& separator)
{
  std::string text;
  for (const std::string& part : parts) text += (&part == &parts.front() ? "" : separator) + part;
  return text;
}

std::vector<std::string> splitLines(const std::string& text)
{
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);)
  {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    lines.push_back(line);
  }
  return lines;
}

std::vector<std::string> splitWords(const std::string& line)
{
  return splitQuoted(line, true, [](char c) { return c == ' ' || c == '\t'; });
}

std::vector<std::string> splitFields(const std::string& line)
{
  std::vector<std::string> fields = splitQuoted(line, false, [](char c) { return c == ','; });
  for (std::string& field : fields) field = trimmed(field);
  return fields;
}

bool parseNumber(const std::string& text, double& value)
{
  std::istringstream stream(text);
  stream.imbue(std::locale::classic());
  double number = 0;
  if (!(stream >> std::noskipws >> number) || stream.peek() != std::istringstream::traits_type::eof()) return false;
  value = number;
  return std::isfinite(number);
}

bool parseInteger(const std::string& text, long minimum, long maximum, long& value)
{
  double number = 0;
  if (!parseNumber(text, number) || number != std::floor(number)) return false;
  if (number < double(minimum) || number > double(maximum)) return false;
  value = long(number);
  return true;
}

std::string rounded(double value, int digits)
{
  std::ostringstream stream;
  stream.imbue(std::locale::classic());
  stream.precision(digits);
  stream << value;
  return stream.str();
}

} // namespace text
} // namespace surgicalmesher
