// SPDX-License-Identifier: Apache-2.0
#include "PrintableText.h"

#include <algorithm>
#include <cstring>

namespace surgicalmesher
{

namespace
{

int byteAt(const std::string& text, std::size_t at)
{
  return at < text.size() ? static_cast<unsigned char>(text[at]) : 0;
}

/// ASCII characters that must be escaped in strings of JSON or TOML.
bool isASCIIControl(unsigned char letter) { return letter < 0x20 || letter == 0x7f; }

std::string numbered(unsigned char letter)
{
  const char* const digits = "0123456789abcdef";
  return { '\\', 'u', '0', '0', digits[letter >> 4], digits[letter & 15] };
}

bool isControl(const std::string& text, std::size_t at, std::size_t length)
{
  const int first = byteAt(text, at), second = byteAt(text, at + 1), third = byteAt(text, at + 2);
  if (length == 1) return first == 0x7f || (first < 0x20 && !(first && std::strchr("\t\n\r", first)));
  if (length == 2) return first == 0xc2 && second < 0xa0; // U+0080 .. U+009F
  // U+200E, U+200F, U+202A .. U+202E, U+2066 .. U+2069
  if (length != 3 || first != 0xe2) return false;
  return (second == 0x80 && ((third >= 0x8e && third <= 0x8f) || (third >= 0xaa && third <= 0xae))) ||
         (second == 0x81 && third >= 0xa6 && third <= 0xa9);
}

std::string escaped(const std::string& bytes)
{
  const char* const digits = "0123456789abcdef";
  std::string text;
  for (const unsigned char byte : bytes) text += { '\\', 'x', digits[byte >> 4], digits[byte & 15] };
  return text;
}

} // namespace

std::size_t utf8Length(const std::string& text, std::size_t at)
{
  const int first = byteAt(text, at), second = byteAt(text, at + 1);
  const std::size_t length = first < 0x80   ? 1
                             : first < 0xc2 ? 0
                             : first < 0xe0 ? 2
                             : first < 0xf0 ? 3
                             : first < 0xf5 ? 4
                                            : 0;
  const int lowest = first == 0xe0 ? 0xa0 : first == 0xf0 ? 0x90 : 0x80;
  const int highest = first == 0xed ? 0x9f : first == 0xf4 ? 0x8f : 0xbf;
  if (length > 1 && (second < lowest || second > highest)) return 0;
  for (std::size_t n = 2; n < length; ++n)
  {
    if ((byteAt(text, at + n) & 0xc0) != 0x80) return 0;
  }
  return length;
}

bool isUTF8(const std::string& text)
{
  for (std::size_t at = 0; at < text.size();)
  {
    const std::size_t length = utf8Length(text, at);
    if (length == 0) return false;
    at += length;
  }
  return true;
}

std::string printable(const std::string& text)
{
  std::string result;
  for (std::size_t at = 0; at < text.size();)
  {
    const std::size_t length = utf8Length(text, at);
    const std::size_t taken = std::max<std::size_t>(length, 1);
    const std::string character = text.substr(at, taken);
    result += length == 0 || isControl(text, at, length) ? escaped(character) : character;
    at += taken;
  }
  return result;
}

std::string quoted(const std::string& text)
{
  std::string result = "\"";
  for (const char letter : text)
  {
    if (letter == '"' || letter == '\\') result += '\\';
    result += isASCIIControl(letter) ? numbered(letter) : std::string(1, letter);
  }
  return result + "\"";
}

} // namespace surgicalmesher
