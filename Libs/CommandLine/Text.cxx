// SPDX-License-Identifier: Apache-2.0
#include "Text.h"

#include <cctype>
#include <cmath>
#include <iomanip>
#include <locale>
#include <sstream>

namespace surgicalmesher
{

namespace
{

template <class T>
std::optional<T> parseWhole(const std::string& text)
{
  std::istringstream stream(text);
  stream.imbue(std::locale::classic());
  T value{};
  stream >> std::noskipws >> value;
  if (!stream || stream.peek() != std::istringstream::traits_type::eof()) return {};
  return value;
}

} // namespace

std::string trimmed(const std::string& text)
{
  const char* const white = " \t\r\n";
  const std::size_t first = text.find_first_not_of(white);
  return first == std::string::npos ? std::string() : text.substr(first, text.find_last_not_of(white) - first + 1);
}

std::string lowerCase(std::string text)
{
  for (char& letter : text) letter = char(std::tolower(static_cast<unsigned char>(letter)));
  return text;
}

std::string oneLine(const std::string& text)
{
  std::istringstream stream(text);
  std::string line;
  for (std::string word; stream >> word;) line += (line.empty() ? "" : " ") + word;
  return line;
}

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

std::vector<std::string> splitQuoted(const std::string& text)
{
  std::vector<std::string> parts(1);
  bool quoted = false;
  for (const char letter : text)
  {
    if (letter == '"') quoted = !quoted;
    else if (letter == ',' && !quoted) parts.emplace_back();
    else parts.back() += letter;
  }
  return parts;
}

std::string joined(const std::vector<std::string>& parts, const std::string& separator)
{
  std::string text;
  for (const std::string& part : parts) text += (&part == &parts.front() ? "" : separator) + part;
  return text;
}

std::optional<int> parseInteger(const std::string& text) { return parseWhole<int>(text); }

std::optional<double> parseNumber(const std::string& text)
{
  const std::optional<double> value = parseWhole<double>(text);
  return value && std::isfinite(*value) ? value : std::nullopt;
}

std::string formatNumber(double value)
{
  std::ostringstream stream;
  stream.imbue(std::locale::classic());
  stream << std::setprecision(10) << value;
  return stream.str();
}

} // namespace surgicalmesher
