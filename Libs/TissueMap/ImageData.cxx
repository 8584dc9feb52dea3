// SPDX-License-Identifier: Apache-2.0
#include "ImageData.h"

#include "Errors.h"
#include "TextFile.h"
#include "Vec3.h"

#include <itk_zlib.h>
#include <itksys/SystemTools.hxx>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <fstream>
#include <vector>

namespace surgicalmesher
{

namespace
{

/// Where the voxels lie: `headerBytes` of the (decompressed) data come before the first voxel.
struct DataBlock
{
  std::string file;
  std::uint64_t offset = 0; ///< in the file
  std::uint64_t headerBytes = 0;
  bool compressed = false;
  std::string compressedBytes; ///< text of CompressedDataSize in a MetaImage header
};

bool hasExtension(const std::string& file, const std::string& extension)
{
  const std::string name = text::lowerCase(file);
  return name.size() >= extension.size() &&
         name.compare(name.size() - extension.size(), extension.size(), extension) == 0;
}

bool isGzip(const std::string& file)
{
  std::ifstream stream(file.c_str(), std::ios::binary);
  return stream.get() == 0x1f && stream.get() == 0x8b;
}

DataBlock wholeFile(const std::string& file, std::uint64_t headerBytes)
{
  return { file, 0, headerBytes, isGzip(file), {} };
}

/// A file that the header names, relative to the header's folder.
std::string besides(const std::string& headerFile, const std::string& name)
{
  if (itksys::SystemTools::FileIsFullPath(name)) return name;
  const std::string folder = itksys::SystemTools::GetFilenamePath(headerFile);
  return folder.empty() ? name : folder + "/" + name;
}

/// The voxel file (.img) of a NIfTI or Analyze pair.
std::string pairedImage(const std::string& file)
{
  const bool isGz = hasExtension(file, ".gz");
  const std::string stem = file.substr(0, file.size() - (isGz ? 7 : 4)); // .hdr, .img
  const std::string image = stem + ".img";
  return itksys::SystemTools::FileExists(image, true) ? image : image + ".gz";
}

/// Reads `key: value` or `key = value` lines up to the one after which voxels follow, or the end of the file.
DataBlock textHeader(const std::string& file, char separator, const std::string& dataKey,
                     const std::string& compressionKey)
{
  DataBlock block{ file, 0, 0, false, {} };
  bool attached = true;
  std::ifstream stream(file.c_str(), std::ios::binary);
  for (std::string line; std::getline(stream, line);)
  {
    line = text::trimmed(line);
    if (line.empty()) break;
    const std::size_t at = line.find(separator);
    if (at == std::string::npos) continue;
    const std::string key = text::lowerCase(text::trimmed(line.substr(0, at)));
    const std::string value = text::trimmed(line.substr(at + 1));
    const std::string word = text::lowerCase(value);
    if (key == "compresseddatasize") block.compressedBytes = value;
    if (key == compressionKey) block.compressed = word == "true" || word == "gzip" || word == "gz";
    if (key != dataKey) continue;
    attached = word == "local";
    if (!attached) block.file = besides(file, value);
    if (dataKey == "elementdatafile") break; // the last line of a MetaImage header
  }
  if (attached) block.offset = std::uint64_t(stream.tellg());
  return block;
}

bool isNRRD(const std::string& file) { return hasExtension(file, ".nrrd") || hasExtension(file, ".nhdr"); }

DataBlock findData(const std::string& file)
{
  if (isNRRD(file)) return textHeader(file, ':', "data file", "encoding");
  if (hasExtension(file, ".mha") || hasExtension(file, ".mhd"))
  {
    return textHeader(file, '=', "elementdatafile", "compresseddata");
  }
  if (hasExtension(file, ".gipl") || hasExtension(file, ".gipl.gz")) return wholeFile(file, 256);
  if (hasExtension(file, ".nii") || hasExtension(file, ".nii.gz")) return wholeFile(file, 0);
  return wholeFile(pairedImage(file), 0);
}

/// Number of bytes that the stream decompresses to, without members after the one that reaches `enough`; 0 if it ends
/// early or a checksum is wrong.
std::uint64_t inflatedSize(std::istream& stream, std::uint64_t enough)
{
  constexpr int anyHeader = 47; // zlib or gzip, detected automatically
  std::vector<unsigned char> in(1 << 16);
  std::vector<unsigned char> out(1 << 18);
  std::uint64_t size = 0;
  z_stream state{};
  if (inflateInit2(&state, anyHeader) != Z_OK) return 0;
  int status = Z_OK;
  while (status == Z_OK)
  {
    if (state.avail_in == 0)
    {
      stream.read(reinterpret_cast<char*>(in.data()), std::streamsize(in.size()));
      state.next_in = in.data();
      state.avail_in = uInt(stream.gcount());
      if (state.avail_in == 0) break;
    }
    state.next_out = out.data();
    state.avail_out = uInt(out.size());
    status = inflate(&state, Z_NO_FLUSH);
    size += out.size() - state.avail_out;
    if (status == Z_STREAM_END && size < enough) status = inflateReset(&state); // another member follows
  }
  inflateEnd(&state);
  return status == Z_STREAM_END ? size : 0;
}

/// Refuses long header lines that are no key/value pairs: the reader copies such a line into a message buffer of
/// limited size.
void requireLegibleNrrd(const std::string& file)
{
  constexpr std::size_t longest = 500;
  if (!hasExtension(file, ".nrrd") && !hasExtension(file, ".nhdr")) return;
  std::ifstream stream(file.c_str(), std::ios::binary);
  for (std::string line; std::getline(stream, line) && !line.empty() && line != "\r";)
    if (line.size() > longest && line.find(":=") == std::string::npos)
      throw InputError(file + ": a line of " + std::to_string(line.size()) +
                       " characters in the header, expected fields of at most " + std::to_string(longest));
}

/// Checks CompressedDataSize, for which MetaImage's reader allocates memory before it reads.
void requireCredibleCompression(const DataBlock& block, std::uint64_t fileSize)
{
  double claimed = 0;
  if (block.compressedBytes.empty() ||
      (text::parseNumber(block.compressedBytes, claimed) && claimed >= 0 && claimed + block.offset <= fileSize))
    return;
  throw InputError(block.file + ": CompressedDataSize is \"" + block.compressedBytes.substr(0, 40) +
                   "\", expected no more than the file's " + std::to_string(fileSize) + " bytes");
}

} // namespace

void requireCredibleDimensions(const std::string& imageFile)
{
  requireLegibleNrrd(imageFile);
  if (!hasExtension(imageFile, ".mha") && !hasExtension(imageFile, ".mhd")) return;
  constexpr long mostDimensions = 10; // of MetaImage
  std::ifstream stream(imageFile.c_str(), std::ios::binary);
  for (std::string line; std::getline(stream, line);)
  {
    const std::size_t at = line.find('=');
    const std::string key = text::lowerCase(text::trimmed(line.substr(0, at)));
    if (key == "elementdatafile" || at == std::string::npos) return;
    long dimensions = 0;
    if (key != "ndims" || text::parseInteger(text::trimmed(line.substr(at + 1)), 1, mostDimensions, dimensions))
      continue;
    throw InputError(imageFile + ": NDims is \"" + text::trimmed(line.substr(at + 1)).substr(0, 40) + "\", expected 3");
  }
}

std::optional<NiftiPlacement> readNiftiPlacement(const std::string& file)
{
  constexpr std::size_t headerSize = 348;
  std::array<unsigned char, headerSize> bytes{};
  const gzFile stream = gzopen(file.c_str(), "rb"); // also reads uncompressed files
  if (!stream) return {};
  const bool isWhole = gzread(stream, bytes.data(), headerSize) == int(headerSize);
  gzclose(stream);
  const auto integer = [&](std::size_t at, int length, bool swap)
  {
    std::uint32_t value = 0;
    for (int n = 0; n < length; ++n) value |= std::uint32_t(bytes[at + (swap ? length - 1 - n : n)]) << (8 * n);
    return value;
  };
  if (!isWhole || bytes[344] != 'n' || bytes[346] != '1') return {};
  const bool swap = integer(0, 4, false) != headerSize;
  NiftiPlacement placement;
  placement.isInMetres = (bytes[123] & 7) == 1;
  placement.sformCode = int(integer(254, 2, swap));
  std::array<Vec3, 3> columns;
  for (int row = 0; row < 3; ++row)
  {
    for (int column = 0; column < 3; ++column)
    {
      const std::uint32_t bits = integer(280 + 16 * row + 4 * column, 4, swap);
      float value = 0;
      std::memcpy(&value, &bits, sizeof(value));
      columns[column][row] = value;
    }
  }
  for (int axis = 0; axis < 3; ++axis)
  {
    const Vec3 &a = columns[axis], &b = columns[(axis + 1) % 3];
    const double sine = std::min(1.0, std::abs(dot(a, b)) / (norm(a) * norm(b)));
    placement.skew = std::max(placement.skew, std::asin(sine) * 180 / 3.14159265358979323846);
  }
  return placement;
}

void requireImageData(const std::string& imageFile, std::uint64_t byteCount)
{
  const DataBlock block = findData(imageFile);
  if (isNRRD(imageFile) && !block.compressed) return; // its reader counts raw and text data itself
  std::ifstream stream(block.file.c_str(), std::ios::binary);
  if (!stream)
  {
    throw InputError(imageFile + ": its voxels are not to be found, expected one file of voxels, " + block.file);
  }
  stream.seekg(0, std::ios::end);
  const std::uint64_t size = std::uint64_t(stream.tellg());
  const std::uint64_t expected = block.headerBytes + byteCount;
  if (block.compressed)
  {
    stream.seekg(std::streamoff(block.offset));
    if (inflatedSize(stream, expected) >= expected) return requireCredibleCompression(block, size);
    throw InputError(block.file + ": the compressed voxels are truncated or damaged, expected " +
                     std::to_string(byteCount) + " bytes of them");
  }
  if (size >= block.offset + expected) return;
  throw InputError(block.file + ": truncated, " + std::to_string(size) + " bytes, expected " +
                   std::to_string(block.offset + expected));
}

void requirePlausibleData(const std::string& imageFile, std::uint64_t byteCount)
{
  constexpr std::uint64_t densestText = 4; // memory over file size: "0 " may stand for a number of eight bytes
  const DataBlock block = findData(imageFile);
  std::ifstream stream(block.file.c_str(), std::ios::binary | std::ios::ate);
  if (!stream || block.compressed) return; // checked already, or data in several files
  const std::uint64_t size = std::uint64_t(stream.tellg());
  if (densestText * size >= byteCount) return;
  throw InputError(block.file + ": truncated, " + std::to_string(size) + " bytes, expected " +
                   std::to_string(block.offset + byteCount));
}

} // namespace surgicalmesher
