#include "OutputFiles.h"

#include "Errors.h"
#include "Platform.h"
#include "Text.h"

#include <filesystem>
#include <fstream>
#include <vector>

namespace fs = std::filesystem;

namespace surgicalmesher
{

namespace
{

const char* const partialMark = ".partial";

/// The file a final path stands for: a symbolic link keeps pointing to it.
fs::path resolved(const std::string& finalPath)
{
  std::error_code error;
  fs::path path = fs::absolute(finalPath, error);
  // The limit ends a circle of links; its file can't be created, and that is said then.
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

/// The process that a temporary file of `path` on this host belongs to; 0 for any other file.
int ownerOfTemporary(const fs::path& path, const std::string& candidate)
{
  const std::string name = path.filename().string();
  const std::string start = "." + name + "." + hostName() + "-";
  const std::string end = partialMark + fullExtension(name);
  if (candidate.size() <= start.size() + end.size() || candidate.compare(0, start.size(), start) != 0 ||
      candidate.compare(candidate.size() - end.size(), end.size(), end) != 0)
  {
    return 0;
  }
  return parseInteger(candidate.substr(start.size(), candidate.size() - start.size() - end.size())).value_or(0);
}

void removeLeftovers(const fs::path& path)
{
  std::error_code error;
  std::vector<fs::path> leftovers;
  for (fs::directory_iterator entry(path.parent_path(), error), end; !error && entry != end; entry.increment(error))
  {
    const int owner = ownerOfTemporary(path, entry->path().filename().string());
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

void moveIntoPlace(const std::map<std::string, std::string>& temporaryByFinal)
{
  for (const auto& [path, temporary] : temporaryByFinal) requireWritten(temporary, path);
  std::vector<std::string> inPlace;
  for (const auto& [path, temporary] : temporaryByFinal)
  {
    std::error_code error;
    fs::rename(temporary, path, error);
    if (error)
    {
      for (const std::string& file : inPlace) fs::remove(file, error);
      throw InputError(path + ": can't be replaced, a writable file expected");
    }
    inPlace.push_back(path);
  }
}

} // namespace

std::string fullExtension(const std::string& fileName)
{
  const fs::path name = fs::path(fileName).filename();
  const std::string last = name.extension().string();
  const std::string before = name.stem().extension().string();
  const bool compound = lowerCase(last) == ".gz" || lowerCase(before) == ".seg" || lowerCase(before) == ".mrk";
  return compound ? before + last : last;
}

std::string OutputFiles::temporary(const std::string& finalPath)
{
  const fs::path path = resolved(finalPath);
  const auto known = m_TemporaryByFinal.find(path.string());
  if (known != m_TemporaryByFinal.end()) return known->second;

  requireWritablePlace(path, finalPath);
  removeLeftovers(path);
  const std::string name = path.filename().string();
  const std::string temporary = (path.parent_path() / ("." + name + "." + hostName() + "-" +
                                                       std::to_string(processId()) + partialMark + fullExtension(name)))
                                  .string();
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
    for (std::size_t at; (at = message.find(temporary)) != message.npos;) message.replace(at, temporary.size(), path);
  }
  return message;
}

void OutputFiles::commit()
{
  moveIntoPlace(m_TemporaryByFinal);
  m_TemporaryByFinal.clear();
  keepOnSignal();
}

void OutputFiles::commit(const std::string& finalPath)
{
  const auto known = m_TemporaryByFinal.find(resolved(finalPath).string());
  if (known == m_TemporaryByFinal.end()) return;
  moveIntoPlace({ *known });
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

} // namespace surgicalmesher
