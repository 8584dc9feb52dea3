// SPDX-License-Identifier: Apache-2.0
#include "TextFile.h"

#include "Errors.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace surgicalmesher
{
namespace text
{

void requireReadableFile(const std::string& file)
{
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(file, error);
  if (!std::filesystem::exists(status)) throw InputError(file + ": no such file");
  if (std::filesystem::is_directory(status)) throw InputError(file + ": is a folder, expected a file");
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

} // namespace text

void writeBytes(const std::string& bytes, const std::string& file)
{
  const auto refuse = [&](const std::string& what)
  { throw InputError(file + ": can't be " + what + " (" + std::strerror(errno) + ")"); };
  errno = 0;
  std::ofstream stream(file, std::ios::binary | std::ios::trunc);
  if (!stream) refuse("opened for writing");
  stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  stream.close();
  if (!stream) refuse("written to its end");
}
} // namespace surgicalmesher
