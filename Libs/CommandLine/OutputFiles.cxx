// SPDX-License-Identifier: Apache-2.0
#include "OutputFiles.h"

#include "Errors.h"
#include "Platform.h"
#include "PrintableText.h"
#include "TextFile.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>
#include <vector>

namespace fs = std::filesystem;

namespace surgicalmesher
{

namespace
{

const char* const partialMark = ".partial";

/// The file that a final path refers to. Symbolic links are followed, so that they remain and their target is replaced.
fs::path resolved(const std::string& finalPath)
{
  std::error_code error;
  fs::path path = fs::absolute(finalPath, error);
  // The limit ends cycles of links; creating their file fails, which is reported then.
  for (int links = 0; links < 40 && fs::is_symlink(path, error); ++links)
  {
    path = path.parent_path() / fs::read_symlink(path, error);
  }
  return path.lexically_normal();
}

void requireWritablePlace(const fs::path& path, const std::string& finalPath)
{
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (fs::is_directory(status)) throw InputError(finalPath + ": folder found, name of an output file expected");
  if (fs::exists(status) && !fs::is_regular_file(status))
  {
    throw InputError(finalPath + ": device found, name of an output file expected");
  }
  if (!fs::is_directory(path.parent_path(), error))
  {
    throw InputError(finalPath + ": folder " + path.parent_path().string() + " not found, a writable folder expected");
  }
}

constexpr std::size_t longestName = 255; ///< bytes; accepted by nearly every file system

/// FNV-1a, 64 bit.
std::string hashOf(const std::string& text)
{
  std::uint64_t hash = 14695981039346656037u;
  for (const unsigned char byte : text) hash = (hash ^ byte) * 1099511628211u;
  std::ostringstream digits;
  digits << std::hex << hash;
  return digits.str();
}

/// The name of this process's temporary file for a file called `name`.
std::string temporaryName(const std::string& name)
{
  const std::string end = "." + hostName() + "-" + std::to_string(processId()) + partialMark + fullExtension(name);
  if (1 + name.size() + end.size() <= longestName) return "." + name + end;
  const std::string hash = hashOf(name);
  std::size_t kept = longestName - std::min(longestName, 2 + hash.size() + end.size());
  while (kept > 0 && (static_cast<unsigned char>(name[kept]) & 0xc0) == 0x80) --kept; // not within a UTF-8 character
  return "." + name.substr(0, kept) + "." + hash + end;
}

/// The process that a temporary file of this host belongs to; 0 for any other file. Temporary files are named
/// `.<name>.<host>-<process>.partial<extension>`, with the extension of the name unless the name was cut.
int ownerOfTemporary(const std::string& candidate)
{
  const std::size_t mark = candidate.rfind(partialMark);
  const std::string host = "." + hostName() + "-";
  const std::size_t at = mark == std::string::npos ? mark : candidate.rfind(host, mark);
  if (at == std::string::npos || at < 2 || candidate[0] != '.') return 0;
  const std::string name = candidate.substr(1, at - 1);
  const std::string extension = candidate.substr(mark + std::strlen(partialMark));
  const bool isCut = candidate.size() + 3 >= longestName; // up to three bytes shorter to keep a character whole
  if (!isCut && extension != fullExtension(name)) return 0;
  const std::size_t number = at + host.size();
  long owner = 0;
  text::parseInteger(candidate.substr(number, mark - number), 1, std::numeric_limits<int>::max(), owner);
  return int(owner);
}

void removeLeftovers(const fs::path& folder)
{
  std::error_code error;
  std::vector<fs::path> leftovers;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error))
  {
    const int owner = ownerOfTemporary(entry->path().filename().string());
    if (owner > 0 && !processIsAlive(owner)) leftovers.push_back(entry->path());
  }
  for (const fs::path& leftover : leftovers) fs::remove(leftover, error);
}

void requireWritten(const fs::path& temporary, const fs::path& path)
{
  std::error_code error;
  const auto bytes = fs::file_size(temporary, error);
  if (error || bytes == 0) throw EngineError(path.string() + ": output was not written");
  if (!syncToDevice(temporary.string()))
    throw InputError(path.string() + ": disk full or failing, room for the file expected");
}

struct Replaced
{
  std::string path;
  std::string earlier; ///< another name of the file that was there before; empty if there was none
};

/// Gives the file at `path`, if any, a second name, by which it can be put back. The name is that of a temporary file,
/// so that a later run removes it if this one is killed. A link leaves the file itself in place all the time.
Replaced aboutToReplace(const std::string& path)
{
  const fs::path place(path);
  const std::string second = (place.parent_path() / temporaryName("earlier." + place.filename().string())).string();
  removeOnSignal(second);
  std::error_code error;
  fs::remove(second, error); // of a killed process with the same number
  fs::create_hard_link(path, second, error);
  return { path, error ? std::string() : second };
}

void putBack(const std::vector<Replaced>& files)
{
  for (const Replaced& file : files)
  {
    std::error_code error;
    if (file.earlier.empty()) fs::remove(file.path, error);
    else fs::rename(file.earlier, file.path, error);
  }
}

void moveIntoPlace(const std::map<std::string, std::string>& temporaryByFinal)
{
  for (const auto& [path, temporary] : temporaryByFinal) requireWritten(temporary, path);
  std::vector<Replaced> inPlace;
  std::error_code error;
  for (const auto& [path, temporary] : temporaryByFinal)
  {
    const Replaced file = aboutToReplace(path);
    fs::rename(temporary, path, error);
    if (error)
    {
      putBack(inPlace);
      if (!file.earlier.empty()) fs::remove(file.earlier, error);
      throw InputError(path + ": can't be replaced, a writable file expected");
    }
    inPlace.push_back(file);
  }
  for (const Replaced& file : inPlace)
    if (!file.earlier.empty()) fs::remove(file.earlier, error);
  if (!inPlace.empty()) outputIsInPlace();
}

} // namespace

std::string fullExtension(const std::string& fileName)
{
  const fs::path name = fs::path(fileName).filename();
  const std::string last = name.extension().string();
  const std::string before = name.stem().extension().string();
  const bool compound =
    text::lowerCase(last) == ".gz" || text::lowerCase(before) == ".seg" || text::lowerCase(before) == ".mrk";
  return compound ? before + last : last;
}

std::string placeOf(const std::string& file)
{
  const fs::path path = resolved(file);
  std::error_code error;
  const fs::path folder = fs::weakly_canonical(path.parent_path(), error);
  return error ? path.string() : (folder / path.filename()).string();
}

std::string OutputFiles::temporary(const std::string& finalPath)
{
  const fs::path path = resolved(finalPath);
  const auto known = m_TemporaryByFinal.find(path.string());
  if (known != m_TemporaryByFinal.end()) return known->second;

  requireWritablePlace(path, finalPath);
  if (m_CleanedFolders.insert(path.parent_path().string()).second) removeLeftovers(path.parent_path());
  std::string temporary = (path.parent_path() / temporaryName(path.filename().string())).string();
  removeOnSignal(temporary);
  if (!std::ofstream(temporary, std::ios::binary))
  {
    throw InputError(finalPath + ": can't create a file in " + path.parent_path().string() +
                     ", a writable folder expected");
  }
  m_TemporaryByFinal[path.string()] = temporary;
  return temporary;
}

std::string OutputFiles::withFinalNames(std::string message) const
{
  for (const auto& [path, temporary] : m_TemporaryByFinal)
  {
    const std::string found = printable(temporary); // as in the messages of Error
    for (std::size_t at; (at = message.find(found)) != message.npos;) message.replace(at, found.size(), path);
  }
  return message;
}

void OutputFiles::commit()
{
  moveIntoPlace(m_TemporaryByFinal);
  for (const auto& file : m_TemporaryByFinal) m_Committed.push_back(file.first);
  m_TemporaryByFinal.clear();
  keepOnSignal();
}

void OutputFiles::commit(const std::string& finalPath)
{
  const auto known = m_TemporaryByFinal.find(resolved(finalPath).string());
  if (known == m_TemporaryByFinal.end()) return;
  moveIntoPlace({ *known });
  m_Committed.push_back(known->first);
  m_TemporaryByFinal.erase(known);
}

void OutputFiles::discard(const std::string& finalPath)
{
  const auto known = m_TemporaryByFinal.find(resolved(finalPath).string());
  if (known == m_TemporaryByFinal.end()) return;
  std::error_code error;
  fs::remove(known->second, error);
  m_TemporaryByFinal.erase(known);
}

OutputFiles::~OutputFiles()
{
  for (const auto& [path, temporary] : m_TemporaryByFinal)
  {
    std::error_code error;
    fs::remove(temporary, error);
  }
}

void writeWhole(const std::string& bytes, const std::string& file)
{
  OutputFiles files;
  const std::string temporary = files.temporary(file);
  try
  {
    writeBytes(bytes, temporary);
    files.commit();
  }
  catch (const InputError& error)
  {
    throw InputError(files.withFinalNames(error.what()));
  }
}

} // namespace surgicalmesher
