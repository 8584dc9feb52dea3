// SPDX-License-Identifier: Apache-2.0
#include "HeaderClaims.h"

#include "Errors.h"
#include "Text.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <locale>
#include <sstream>
#include <vector>

namespace surgicalmesher
{

namespace
{

struct Claim
{
  std::string what; ///< as the file calls it
  double count = 0;
  double bytesEach = 1; ///< at least
};

/// The digits at `at`, blanks before them skipped; -1 if there is none.
double numberAt(const std::string& text, std::size_t at)
{
  while (at < text.size() && text[at] == ' ') ++at;
  if (at >= text.size() || !std::isdigit(static_cast<unsigned char>(text[at]))) return -1;
  double value = 0;
  for (; at < text.size() && std::isdigit(static_cast<unsigned char>(text[at])); ++at)
    value = 10 * value + (text[at] - '0');
  return value;
}

template <class Take>
void forEach(const std::string& text, const std::string& word, const Take& take)
{
  for (std::size_t at = text.find(word); at != text.npos; at = text.find(word, at + 1)) take(at, at + word.size());
}

/// XML: attributes NumberOfPoints="..." and the like. Data that are compressed shrink to a thousandth at most (zlib:
/// 1032 times), and a point is 12 bytes at least.
std::vector<Claim> xmlClaims(const std::string& text)
{
  std::vector<Claim> claims;
  for (const char* name : { "NumberOfPoints", "NumberOfCells", "NumberOfPolys", "NumberOfStrips", "NumberOfTuples" })
  {
    forEach(text, std::string(name) + "=\"",
            [&](std::size_t, std::size_t end) {
              claims.push_back({ name, numberAt(text, end), 0.004 });
            });
  }
  return claims;
}

/// Legacy VTK: keywords at the beginning of a line.
std::vector<Claim> legacyClaims(const std::string& text)
{
  std::vector<Claim> claims;
  for (const char* name : { "POINTS", "CELLS", "POLYGONS", "TRIANGLE_STRIPS", "CELL_TYPES" })
  {
    forEach(text, std::string("\n") + name + " ",
            [&](std::size_t, std::size_t end) {
              claims.push_back({ name, numberAt(text, end), std::strcmp(name, "POINTS") == 0 ? 3. : 1. });
            });
  }
  return claims;
}

/// PLY: lines "element NAME COUNT" of the header, each followed by its properties, of a byte at least.
std::vector<Claim> plyClaims(const std::string& text)
{
  std::vector<Claim> claims;
  std::istringstream lines(text.substr(0, text.find("end_header")));
  for (std::string line; std::getline(lines, line);)
  {
    std::istringstream words(line);
    std::string keyword, name;
    words >> keyword >> name;
    double count = 0;
    if (keyword == "element" && words >> count) claims.push_back({ "element " + name, count, 0 });
    if (keyword == "property" && !claims.empty()) ++claims.back().bytesEach;
  }
  return claims;
}

/// Reads the elements of a PLY one after the other, as its header has them: VTK 9.1's reader ends the process where one
/// is not whole.
class PlyWalk
{
public:
  explicit PlyWalk(const std::string& text)
  {
    const std::size_t end = text.find("end_header"), data = text.find('\n', end);
    if (end == text.npos || data == text.npos) return;
    readHeader(text.substr(0, end));
    m_Data.str(text.substr(data + 1));
    m_Data.imbue(std::locale::classic());
  }

  /// The first element that is not whole; empty if all are.
  std::string broken()
  {
    for (const Element& element : m_Elements)
      for (double n = 0; n < element.count; ++n)
        if (!readElement(element)) return element.name + " " + text::rounded(n, 15);
    return {};
  }

private:
  struct Property
  {
    std::string countType; ///< of lists; empty: no list
    std::string type;
  };
  struct Element
  {
    std::string name;
    double count = 0;
    std::vector<Property> properties;
  };

  void readHeader(const std::string& header)
  {
    std::istringstream lines(header);
    for (std::string line; std::getline(lines, line);)
    {
      std::istringstream words(line);
      std::string keyword, first, second, third;
      words >> keyword >> first >> second >> third;
      if (keyword == "format") m_Format = first;
      if (keyword == "element") m_Elements.push_back({ first, std::max(0., numberAt(second, 0)), {} });
      if (keyword == "property" && !m_Elements.empty())
        m_Elements.back().properties.push_back(first == "list" ? Property{ second, third } : Property{ "", first });
    }
  }

  static std::size_t sizeOf(const std::string& type)
  {
    if (type == "char" || type == "uchar" || type == "int8" || type == "uint8") return 1;
    if (type == "short" || type == "ushort" || type == "int16" || type == "uint16") return 2;
    return type == "double" || type == "float64" ? 8 : 4;
  }

  /// One number; in text, from the line of its element.
  bool readNumber(std::istream& stream, const std::string& type, double& value) const
  {
    if (m_Format == "ascii") return bool(stream >> value);
    unsigned char bytes[8] = {};
    const std::size_t size = sizeOf(type);
    if (!stream.read(reinterpret_cast<char*>(bytes), std::streamsize(size))) return false;
    value = 0; // counts of lists alone are looked at
    for (std::size_t n = 0; n < size; ++n)
      value = 256 * value + bytes[m_Format == "binary_big_endian" ? n : size - 1 - n];
    return true;
  }

  bool readElement(const Element& element)
  {
    std::string line;
    if (m_Format == "ascii" && !std::getline(m_Data, line)) return false;
    std::istringstream words(line);
    std::istream& stream = m_Format == "ascii" ? static_cast<std::istream&>(words) : m_Data;
    for (const Property& property : element.properties)
    {
      double count = 1, value = 0;
      if (!property.countType.empty() && !readNumber(stream, property.countType, count)) return false;
      for (double n = 0; n < count; ++n)
        if (!readNumber(stream, property.type, value)) return false;
    }
    return true;
  }

  std::string m_Format = "ascii";
  std::vector<Element> m_Elements;
  std::istringstream m_Data;
};

std::vector<Claim> stlClaims(const std::string& text)
{
  if (text.size() < 84 || text.compare(0, 5, "solid") == 0) return {};
  std::uint32_t count = 0;
  for (int n = 0; n < 4; ++n) count |= std::uint32_t(static_cast<unsigned char>(text[80 + n])) << (8 * n);
  return { { "triangles", double(count), 50 } };
}

} // namespace

void requireCredibleHeader(const std::string& file)
{
  const std::string extension = text::extensionOf(file);
  std::ifstream stream(file, std::ios::binary);
  const std::string text{ std::istreambuf_iterator<char>(stream), {} };
  std::vector<Claim> claims;
  if (extension == ".vtp" || extension == ".vtu") claims = xmlClaims(text);
  else if (extension == ".vtk") claims = legacyClaims(text);
  else if (extension == ".ply") claims = plyClaims(text);
  else if (extension == ".stl") claims = stlClaims(text);
  for (const Claim& claim : claims)
  {
    if (claim.count * claim.bytesEach <= double(text.size()) + 1000) continue;
    throw InputError(file + ": the header claims " + text::rounded(claim.count, 15) + " (" + claim.what +
                     "), expected no more than fit into the file's " + std::to_string(text.size()) + " bytes");
  }
  if (extension != ".ply") return;
  const std::string broken = PlyWalk(text).broken();
  if (!broken.empty()) throw InputError(file + ": " + broken + " is not whole, expected all that the header names");
}

} // namespace surgicalmesher
