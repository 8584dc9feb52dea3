// SPDX-License-Identifier: Apache-2.0
#include "ImageHeader.h"

#include "Errors.h"
#include "Text.h"

#include <itk_zlib.h>
#include <itksys/SystemTools.hxx>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <vector>

namespace surgicalmesher
{

namespace
{

constexpr std::size_t niftiHeaderSize = 348;

/// The name of a field in lower case without blanks: NRRD allows "data file" and "datafile".
std::string fieldName(const std::string& text)
{
  std::string name = text::lowerCase(text);
  name.erase(std::remove_if(name.begin(), name.end(), [](char c) { return c == ' ' || c == '\t'; }), name.end());
  return name;
}

/// Millimetres in a unit of length; 0 if it is none of those known.
double millimetresIn(const std::string& unit)
{
  static const std::map<std::string, double> known{ { "mm", 1 },
                                                    { "millimeter", 1 },
                                                    { "millimetre", 1 },
                                                    { "cm", 10 },
                                                    { "centimeter", 10 },
                                                    { "centimetre", 10 },
                                                    { "m", 1000 },
                                                    { "meter", 1000 },
                                                    { "metre", 1000 },
                                                    { "um", 0.001 },
                                                    { "\xC2\xB5m", 0.001 }, // micro sign
                                                    { "\xCE\xBCm", 0.001 }, // Greek mu
                                                    { "micron", 0.001 },
                                                    { "micrometer", 0.001 },
                                                    { "micrometre", 0.001 } };
  std::string name = text::lowerCase(unit);
  if (name.size() > 2 && name.back() == 's') name.pop_back();
  const auto found = known.find(name);
  return found == known.end() ? 0 : found->second;
}

/// The units that a header names, without the words that stand for none.
std::vector<std::string> namedUnits(const std::string& text)
{
  std::vector<std::string> units = text::splitWords(text);
  const auto isNone = [](const std::string& unit)
  { return unit.find_first_not_of('?') == std::string::npos || text::lowerCase(unit) == "none"; };
  units.erase(std::remove_if(units.begin(), units.end(), isNone), units.end());
  return units;
}

/// The header (.hdr) of a pair of which `file` may be the voxels.
std::string pairedHeader(const std::string& file)
{
  const bool isGz = hasExtension(file, ".img.gz");
  if (!isGz && !hasExtension(file, ".img")) return file;
  const std::string header = file.substr(0, file.size() - (isGz ? 7 : 4)) + ".hdr";
  return itksys::SystemTools::FileExists(header, true) ? header : header + ".gz";
}

/// The first bytes of a NIfTI file, in either byte order.
class NiftiBytes
{
public:
  explicit NiftiBytes(const std::string& file)
  {
    const gzFile stream = gzopen(file.c_str(), "rb"); // also reads uncompressed files
    if (!stream) return;
    m_IsWhole = gzread(stream, m_Bytes.data(), niftiHeaderSize) == int(niftiHeaderSize);
    gzclose(stream);
    m_Swap = integer(40) < 1 || integer(40) > 7; // the number of dimensions
  }
  bool isNifti() const
  {
    return m_IsWhole && m_Bytes[344] == 'n' && (m_Bytes[345] == '+' || m_Bytes[345] == 'i') && m_Bytes[346] == '1';
  }
  bool isPair() const { return m_Bytes[345] == 'i'; }
  int unitCode() const { return m_Bytes[123] & 7; }
  int integer(std::size_t at) const { return std::int16_t(bits(at, 2)); }
  float real(std::size_t at) const
  {
    const std::uint32_t source = bits(at, 4);
    float value = 0;
    std::memcpy(&value, &source, sizeof(value));
    return value;
  }

private:
  std::uint32_t bits(std::size_t at, int length) const
  {
    std::uint32_t value = 0;
    for (int n = 0; n < length; ++n)
      value |= std::uint32_t(m_Bytes[at + std::size_t(m_Swap ? length - 1 - n : n)]) << (8 * n);
    return value;
  }

  std::array<unsigned char, niftiHeaderSize> m_Bytes{};
  bool m_IsWhole = false;
  bool m_Swap = false;
};

/// Degrees: the largest deviation of two of the columns from a right angle.
double skewOf(const std::array<Vec3, 3>& columns)
{
  double skew = 0;
  for (int axis = 0; axis < 3; ++axis)
  {
    const Vec3 &a = columns[axis], &b = columns[(axis + 1) % 3];
    const double sine = std::min(1.0, std::abs(dot(a, b)) / (norm(a) * norm(b)));
    skew = std::max(skew, std::asin(sine) * 180 / 3.14159265358979323846);
  }
  return skew;
}

} // namespace

bool hasExtension(const std::string& file, const std::string& extension)
{
  const std::string name = text::lowerCase(file);
  return name.size() >= extension.size() &&
         name.compare(name.size() - extension.size(), extension.size(), extension) == 0;
}

bool isNRRD(const std::string& file) { return hasExtension(file, ".nrrd") || hasExtension(file, ".nhdr"); }

bool isMetaImage(const std::string& file) { return hasExtension(file, ".mha") || hasExtension(file, ".mhd"); }

std::string TextHeader::operator[](const std::string& name) const
{
  const auto found = fields.find(name);
  return found == fields.end() ? std::string() : found->second;
}

TextHeader readTextHeader(const std::string& file)
{
  const bool isNrrd = isNRRD(file); // where an empty line ends the header, and "key:=value" is no field
  TextHeader header;
  std::ifstream stream(file.c_str(), std::ios::binary);
  for (std::string line; std::getline(stream, line);)
  {
    line = text::trimmed(line);
    if (isNrrd && line.empty()) break;
    const std::size_t at = isNrrd ? line.find(": ") : line.find_first_of("=:");
    if (at == std::string::npos) continue;
    const std::string name = fieldName(line.substr(0, at));
    header.fields[name] = text::trimmed(line.substr(at + 1));
    if (!isNrrd && name == "elementdatafile") break; // the last line of a MetaImage header
  }
  stream.clear(); // the header may end the file
  header.end = std::uint64_t(std::max<std::streamoff>(0, stream.tellg()));
  return header;
}

double millimetresPerUnit(const std::string& file)
{
  if (!isNRRD(file) && !isMetaImage(file)) return 1;
  const TextHeader header = readTextHeader(file);
  const bool isInSpace = !header["spaceunits"].empty(); // otherwise the units of the axes' spacings, if any
  const std::string field = isMetaImage(file) ? "DistanceUnits" : isInSpace ? "space units" : "units";
  const std::string text = header[fieldName(field)];
  const std::vector<std::string> units = namedUnits(text);
  if (units.empty()) return 1;
  const double unit = millimetresIn(units.front());
  const bool isOne =
    std::all_of(units.begin(), units.end(), [&](const std::string& other) { return millimetresIn(other) == unit; });
  if (unit > 0 && isOne) return unit;
  throw InputError(file + ": " + field + " is " + text.substr(0, 60) + ", expected mm, cm, m or um, one for all axes");
}

std::optional<NiftiHeader> readNiftiHeader(const std::string& file)
{
  const NiftiBytes bytes(pairedHeader(file));
  if (!bytes.isNifti()) return {};
  const double unit = bytes.unitCode() == 1 ? 1000 : bytes.unitCode() == 3 ? 0.001 : 1;
  NiftiHeader header;
  header.qformCode = bytes.integer(252);
  header.sformCode = bytes.integer(254);
  header.dataType = bytes.integer(70);
  header.slope = bytes.real(112);
  const double offset = bytes.real(108), least = bytes.isPair() ? 0 : niftiHeaderSize;
  header.bytesBeforeVoxels = std::uint64_t(std::max(least, offset < 1e9 ? offset : 0));
  for (int row = 0; row < 3; ++row)
  {
    const double scale = (row < 2 ? -1 : 1) * unit; // NIfTI's world is RAS
    const std::size_t at = 280 + 16 * std::size_t(row);
    for (int column = 0; column < 3; ++column)
      header.sformColumns[column][row] = scale * double(bytes.real(at + 4 * std::size_t(column)));
    header.sformOrigin[row] = scale * double(bytes.real(at + 12));
    header.qformOrigin[row] = scale * double(bytes.real(268 + 4 * std::size_t(row)));
  }
  header.skew = skewOf(header.sformColumns);
  return header;
}

} // namespace surgicalmesher
