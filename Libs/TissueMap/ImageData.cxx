// SPDX-License-Identifier: Apache-2.0
#include "ImageData.h"

#include "Errors.h"
#include "ImageHeader.h"
#include "Text.h"

#include <itk_zlib.h>
#include <itksys/SystemTools.hxx>

#include <filesystem>
#include <fstream>
#include <iomanip>
#include <limits>
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
  std::string compressedBytes = {}; ///< text of CompressedDataSize in a MetaImage header
  bool isText = false;
  char separator = ' ';  ///< allowed between the numbers of a text besides white space
  long skippedLines = 0; ///< after the offset
};

bool isGzip(const std::string& file)
{
  std::ifstream stream(file.c_str(), std::ios::binary);
  return stream.get() == 0x1f && stream.get() == 0x8b;
}

DataBlock wholeFile(const std::string& file, std::uint64_t headerBytes)
{
  return { file, 0, headerBytes, isGzip(file) };
}

/// A file that the header names, relative to the header's folder.
std::string besides(const std::string& headerFile, const std::string& name)
{
  if (itksys::SystemTools::FileIsFullPath(name)) return name;
  const std::string folder = itksys::SystemTools::GetFilenamePath(headerFile);
  return folder.empty() ? name : folder + "/" + name;
}

/// The voxel file (.img) of a NIfTI pair.
std::string pairedImage(const std::string& file)
{
  const bool isGz = hasExtension(file, ".gz");
  const std::string stem = file.substr(0, file.size() - (isGz ? 7 : 4)); // .hdr, .img
  const std::string image = stem + ".img";
  return itksys::SystemTools::FileExists(image, true) ? image : image + ".gz";
}

/// The number in a header's field, or 0 if it is none from 1 on.
long sizeField(const TextHeader& header, const std::string& name)
{
  long value = 0;
  return text::parseInteger(header[name], 1, std::numeric_limits<int>::max(), value) ? value : 0;
}

/// Bytes are skipped after lines, and within data that are compressed.
DataBlock nrrdData(const std::string& file)
{
  const TextHeader header = readTextHeader(file);
  const std::string encoding = text::lowerCase(header["encoding"]), dataFile = header["datafile"];
  DataBlock block;
  block.file = dataFile.empty() ? file : besides(file, dataFile);
  block.offset = dataFile.empty() ? header.end : 0;
  block.headerBytes = std::uint64_t(sizeField(header, "byteskip"));
  block.compressed = encoding == "gzip" || encoding == "gz";
  block.isText = encoding == "ascii" || encoding == "text" || encoding == "txt";
  block.separator = ',';
  block.skippedLines = sizeField(header, "lineskip");
  return block;
}

/// MetaImage takes T, t and 1 for true, and data that are text for uncompressed.
DataBlock metaImageData(const std::string& file)
{
  const TextHeader header = readTextHeader(file);
  const auto isTrue = [&](const char* field, const char* missing)
  {
    const std::string value = header[field].empty() ? missing : header[field];
    return value[0] == 'T' || value[0] == 't' || value[0] == '1';
  };
  const bool isAttached = text::lowerCase(header["elementdatafile"]) == "local";
  DataBlock block;
  block.file = isAttached ? file : besides(file, header["elementdatafile"]);
  block.offset = isAttached ? header.end : 0;
  if (const long size = sizeField(header, "headersize")) block.offset = std::uint64_t(size);
  block.isText = !isTrue("binarydata", "true");
  block.compressed = !block.isText && isTrue("compresseddata", "false");
  block.compressedBytes = header["compresseddatasize"];
  return block;
}

DataBlock findData(const std::string& file)
{
  if (isNRRD(file)) return nrrdData(file);
  if (isMetaImage(file)) return metaImageData(file);
  if (hasExtension(file, ".gipl") || hasExtension(file, ".gipl.gz")) return wholeFile(file, 256);
  if (hasExtension(file, ".nii") || hasExtension(file, ".nii.gz")) return wholeFile(file, 0);
  return wholeFile(pairedImage(file), 0);
}

/// Places the stream where the (compressed) data begin.
void seekData(std::istream& stream, const DataBlock& block)
{
  stream.seekg(std::streamoff(block.offset));
  std::string line;
  for (long n = 0; n < block.skippedLines && std::getline(stream, line); ++n) continue;
}

bool isNumber(const std::string& word)
{
  double value = 0;
  return word.find_first_not_of("0123456789") == std::string::npos || text::parseNumber(word, value);
}

/// Reads the text to its end: MetaImage's reader repeats its last number at every word that is none and at the end of
/// the file, and that of NRRD takes the beginning of a word for its number.
void requireNumbers(std::istream& stream, const DataBlock& block, std::uint64_t expected)
{
  constexpr int longest = 60; // characters of a number; NRRD's reader has a buffer of limited size
  const auto refuse = [&](const std::string& what) {
    throw InputError(block.file + ": " + what + ", expected " + std::to_string(expected) + " numbers, one per voxel");
  };
  std::uint64_t count = 0;
  for (std::string word; stream >> std::setw(longest) >> word;)
  {
    if (int(word.size()) == longest) refuse("a word of " + std::to_string(longest) + " characters or more");
    for (const std::string& number : text::split(word, block.separator))
    {
      if (number.empty()) continue;
      if (!isNumber(number)) refuse("\"" + number + "\" among the voxels");
      ++count;
    }
  }
  if (count != expected) refuse(std::to_string(count) + " numbers" + (count < expected ? ", truncated" : ""));
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
  if (!isNRRD(file)) return;
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

/// Whether voxels are in a list of files, or in those that a pattern with numbers stands for.
bool namesSeveralFiles(const DataBlock& block)
{
  const std::string name = std::filesystem::path(block.file).filename().string();
  return name.compare(0, 4, "LIST") == 0 || name.find('%') != std::string::npos;
}

} // namespace

void requireCredibleDimensions(const std::string& imageFile)
{
  requireLegibleNrrd(imageFile);
  if (!isMetaImage(imageFile)) return;
  constexpr long mostDimensions = 10; // of MetaImage
  std::ifstream stream(imageFile.c_str(), std::ios::binary);
  for (std::string line; std::getline(stream, line);)
  {
    const std::size_t at = line.find_first_of("=:");
    const std::string key = text::lowerCase(text::trimmed(line.substr(0, at)));
    if (key == "elementdatafile") return;
    if (at == std::string::npos) continue;
    long dimensions = 0;
    if (key != "ndims" || text::parseInteger(text::trimmed(line.substr(at + 1)), 1, mostDimensions, dimensions))
      continue;
    throw InputError(imageFile + ": NDims is \"" + text::trimmed(line.substr(at + 1)).substr(0, 40) + "\", expected 3");
  }
}

void requireImageData(const std::string& imageFile, std::uint64_t byteCount, std::uint64_t valueCount)
{
  const DataBlock block = findData(imageFile);
  if (isNRRD(imageFile) && !block.compressed && (!block.isText || namesSeveralFiles(block)))
    return; // its reader counts raw data itself
  std::ifstream stream(block.file.c_str(), std::ios::binary);
  if (!stream)
  {
    throw InputError(imageFile + ": its voxels are not to be found, expected one file of voxels, " + block.file);
  }
  stream.seekg(0, std::ios::end);
  const std::uint64_t size = std::uint64_t(stream.tellg());
  const std::uint64_t expected = block.headerBytes + byteCount;
  seekData(stream, block);
  if (block.isText)
  {
    stream.ignore(std::streamsize(block.headerBytes));
    return requireNumbers(stream, block, valueCount);
  }
  if (block.compressed)
  {
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
