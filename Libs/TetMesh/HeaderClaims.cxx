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
  std::string what; ///< in the file's words
  double count = 0;
  double bytesEach = 1; ///< at least
};

/// The number at position `at`, after blanks; -1 if there is none.
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

/// XML: attributes NumberOfPoints="..." and the like. Compression reduces data to a thousandth at best (zlib: 1032
/// times), and a point has at least 12 bytes.
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

/// PLY: lines "element NAME COUNT" of the header, each followed by its properties, which have at least one byte.
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

/// Whether an STL file is text. Binary ones may begin with "solid", too, but have bytes that no text has.
bool isTextSTL(const std::string& text)
{
  const auto isControl = [](unsigned char c) { return c < ' ' && !std::isspace(c); };
  return text.compare(0, 5, "solid") == 0 && std::none_of(text.begin(), text.end(), isControl);
}

std::vector<Claim> stlClaims(const std::string& text)
{
  if (text.size() < 84 || isTextSTL(text)) return {};
  std::uint32_t count = 0;
  for (int n = 0; n < 4; ++n) count |= std::uint32_t(static_cast<unsigned char>(text[80 + n])) << (8 * n);
  return { { "triangles", double(count), 50 } };
}

} // namespace

void requireCredibleHeader(const std::string& file)
{
  const std::string extension = text::extensionOf(file);
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream bytes;
  bytes << stream.rdbuf();
  const std::string text = bytes.str();
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
}

} // namespace surgicalmesher
