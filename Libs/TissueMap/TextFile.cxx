// SPDX-License-Identifier: Apache-2.0
#include "TextFile.h"

#include "Errors.h"

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

} // namespace text
} // namespace surgicalmesher
