// SPDX-License-Identifier: Apache-2.0
#include "SetNames.h"

#include <algorithm>
#include <cctype>

namespace surgicalmesher
{
namespace
{

/// U+00C0 to U+017F without accents; _ where no single letter corresponds.
constexpr const char* kLatin = "AAAAAAACEEEEIIIIDNOOOOO_OUUUUYTsaaaaaaaceeeeiiiidnooooo_ouuuuyty"
                               "AaAaAaCcCcCcCcDdDdEeEeEeEeEeGgGgGgGgHhHhIiIiIiIiIiIiJjKkkLlLlLlL"
                               "lLlNnNnNnnNnOoOoOoOoRrRrRrSsSsSsSsTtTtTtUuUuUuUuUuUuWwYyYZzZzZzs";

/// Returns the number of bytes of the UTF-8 character at `at`, 1 for an invalid byte.
std::size_t bytesAt(const std::string& text, std::size_t at)
{
  const auto lead = static_cast<unsigned char>(text[at]);
  const std::size_t count = lead >= 0xf0 && lead < 0xf5 ? 4 : lead >= 0xe0 ? 3 : lead >= 0xc2 ? 2 : 1;
  if (lead >= 0xf5 || at + count > text.size()) return 1;
  for (std::size_t i = 1; i < count; ++i)
  {
    if ((static_cast<unsigned char>(text[at + i]) & 0xc0) != 0x80) return 1;
  }
  return count;
}

/// Returns the character at `at` as an ASCII letter or digit, or an underscore. Single bytes above ASCII are taken as
/// Latin-1.
char asciiAt(const std::string& text, std::size_t at, std::size_t bytes)
{
  const auto lead = static_cast<unsigned char>(text[at]);
  if (lead < 0x80) return std::isalnum(lead) ? text[at] : '_';
  if (bytes > 2) return '_';
  const unsigned code = bytes == 1 ? lead : (lead & 0x1fu) << 6 | (static_cast<unsigned char>(text[at + 1]) & 0x3fu);
  return code >= 0xc0 && code < 0x180 ? kLatin[code - 0xc0] : '_';
}

std::string withoutUnderscores(const std::string& text)
{
  std::string result;
  for (const char c : text)
  {
    if (c != '_' || (!result.empty() && result.back() != '_')) result += c;
  }
  if (!result.empty() && result.back() == '_') result.pop_back();
  return result;
}

std::string shortened(const std::string& name, std::size_t length)
{
  if (name.size() <= length) return name;
  const std::size_t tail = (length - 1) / 3, head = length - 1 - tail;
  return withoutUnderscores(name.substr(0, head) + "_" + name.substr(name.size() - tail));
}

std::string upperCase(std::string text)
{
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::toupper(c); });
  return text;
}

} // namespace

std::string validUtf8(const std::string& text)
{
  std::string result;
  for (std::size_t at = 0, bytes; at < text.size(); at += bytes)
  {
    bytes = bytesAt(text, at);
    const auto lead = static_cast<unsigned char>(text[at]);
    if (bytes > 1 || lead < 0x80) result += text.substr(at, bytes);
    else result += { static_cast<char>(0xc0 | lead >> 6), static_cast<char>(0x80 | (lead & 0x3f)) };
  }
  return result;
}

std::string validName(const std::string& text, std::size_t length)
{
  std::string name;
  for (std::size_t at = 0, bytes; at < text.size(); at += bytes)
  {
    bytes = bytesAt(text, at);
    name += asciiAt(text, at, bytes);
  }
  name = withoutUnderscores(name);
  if (!name.empty() && std::isdigit(static_cast<unsigned char>(name.front()))) name = "n" + name;
  return shortened(name, length);
}

std::string SetNames::unique(const std::string& text, const std::string& fallback)
{
  std::string name = validName(text, m_Longest);
  if (name.empty()) name = validName(fallback, m_Longest);
  std::string result = name;
  for (int n = 2; !m_Taken.insert(upperCase(result)).second; ++n)
  {
    const std::string suffix = "_" + std::to_string(n);
    result = shortened(name, m_Longest - suffix.size()) + suffix;
  }
  return result;
}

} // namespace surgicalmesher
