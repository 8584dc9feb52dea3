// SPDX-License-Identifier: Apache-2.0
#include "HeaderData.h"

#include "Text.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <limits>

namespace surgicalmesher
{

namespace
{

/// What follows `data file:` or `ElementDataFile =`. The stream then stands behind that line. Empty if there is no such
/// line before the header's end, which an empty line is in NRRD alone.
std::string dataField(std::istream& stream, bool isNRRD)
{
  for (std::string line; std::getline(stream, line);)
  {
    line = text::trimmed(line);
    if (isNRRD && line.empty()) break;
    const std::size_t at = line.find_first_of(isNRRD ? ":" : "=:");
    if (at == std::string::npos) continue;
    const std::string key = text::lowerCase(text::trimmed(line.substr(0, at)));
    if (isNRRD ? key == "data file" || key == "datafile" : key == "elementdatafile")
      return text::trimmed(line.substr(at + 1));
  }
  return {};
}

/// Names one a line, up to the end of the file.
std::vector<std::string> listedNames(std::istream& stream)
{
  std::vector<std::string> names;
  for (std::string line; std::getline(stream, line);)
  {
    if (!text::trimmed(line).empty()) names.push_back(text::trimmed(line));
  }
  return names;
}

/// Returns the number as printf would write it for what stands between % and d: a width, with a 0 before it for zeros.
std::string padded(long number, const std::string& width)
{
  constexpr long longest = 255;
  std::string digits = std::to_string(number);
  long wanted = 0;
  text::parseInteger(width, 0, longest, wanted);
  const char filling = width[0] == '0' ? '0' : ' ';
  return std::string(std::max<long>(wanted - long(digits.size()), 0), filling) + digits;
}

/// Returns the names that a pattern stands for, such as "slice%03d.raw 1 30 1": first number, last number and step.
/// Empty if `field` is no pattern.
std::vector<std::string> numberedNames(const std::string& field)
{
  constexpr long most = std::numeric_limits<int>::max();
  constexpr std::size_t mostNames = 65536; // so that a header with absurd numbers does not take all memory
  const std::vector<std::string> words = text::splitWords(field);
  const std::size_t percent = field.find('%'), letter = field.find('d', percent);
  long first = 0, last = 0, step = 0;
  const bool isPattern = percent != std::string::npos && letter != std::string::npos && words.size() >= 4 &&
                         letter < words[0].size() && text::parseInteger(words[1], -most, most, first) &&
                         text::parseInteger(words[2], -most, most, last) &&
                         text::parseInteger(words[3], -most, most, step) && step != 0;
  std::vector<std::string> names;
  if (!isPattern) return names;
  const std::string before = field.substr(0, percent), width = field.substr(percent + 1, letter - percent - 1);
  const std::string after = words[0].substr(letter + 1);
  for (long n = first; (step > 0 ? n <= last : n >= last) && names.size() < mostNames; n += step)
    names.push_back(before + padded(n, width) + after);
  return names;
}

std::vector<std::string> namesIn(std::istream& stream, const std::string& field)
{
  if (field.empty() || text::lowerCase(field) == "local") return {};
  if (field.compare(0, 4, "LIST") == 0) return listedNames(stream);
  const std::vector<std::string> numbered = numberedNames(field);
  return numbered.empty() ? std::vector<std::string>{ field } : numbered;
}

} // namespace

std::vector<std::string> dataFilesOf(const std::string& header)
{
  const std::string extension = text::extensionOf(header);
  const bool isNRRD = extension == ".nrrd" || extension == ".nhdr";
  if (!isNRRD && extension != ".mha" && extension != ".mhd") return {};
  std::ifstream stream(header, std::ios::binary);
  const std::string field = dataField(stream, isNRRD);
  const std::filesystem::path folder = std::filesystem::path(header).parent_path();
  std::vector<std::string> files;
  for (const std::string& name : namesIn(stream, field)) files.push_back((folder / name).lexically_normal().string());
  return files;
}

} // namespace surgicalmesher
