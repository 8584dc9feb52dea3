// SPDX-License-Identifier: Apache-2.0
#include "TextFile.h"

#include "Errors.h"
#include "PrintableText.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <locale>
#include <sstream>

namespace surgicalmesher
{
namespace text
{

namespace
{

const char* const blanks = " \t\r\n";

/// Splits at separators outside double quotes. With `merge`, runs of separators count as one and "" is a quote's end.
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

void requireReadableFile(const std::string& file)
{
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(file, error);
  if (!std::filesystem::exists(status)) throw InputError(file + ": no such file");
  if (std::filesystem::is_directory(status)) throw InputError(file + ": is a directory, expected a file");
  if (!std::filesystem::is_regular_file(status)) throw InputError(file + ": is a device or pipe, expected a file");
  if (!std::ifstream(file.c_str(), std::ios::binary)) throw InputError(file + ": cannot be opened for reading");
}

std::string readTextFile(const std::string& file)
{
  requireReadableFile(file);
  std::ifstream stream(file.c_str(), std::ios::binary);
  std::ostringstream content;
  content << stream.rdbuf();
  if (stream.bad()) throw InputError(file + ": cannot be read to its end");
  const std::string text = content.str();
  return text.compare(0, 3, "\xEF\xBB\xBF") == 0 ? text.substr(3) : text;
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

bool parseNumber(const std::string& text, double& value)
{
  std::istringstream stream(text);
  stream.imbue(std::locale::classic());
  double number = 0;
  if (!(stream >> number) || stream.peek() != std::istringstream::traits_type::eof()) return false;
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

} // namespace text
} // namespace surgicalmesher
