// SPDX-License-Identifier: Apache-2.0
// surgicalmesher estimate: predicts size, memory and time of a mesh before anything is meshed.

#include "ChildProcess.h"
#include "Commands.h"
#include "Errors.h"
#include "JsonReport.h"
#include "Platform.h"
#include "StageRun.h"
#include "TextFile.h"

#include <rapidjson/document.h>

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <limits>

namespace fs = std::filesystem;

namespace surgicalmesher
{

namespace
{

/// Processor seconds per sample of the boundary, per initial face of the complex, per tetrahedron and per voxel;
/// accurate within a factor of 2, see Docs/Benchmarks.md#estimates.
constexpr double secondsPerSample = 50e-6, secondsPerStartingFace = 30e-6, secondsPerTetrahedron = 70e-6,
                 secondsPerVoxel = 0.5e-6;
constexpr double samplesPerTriangle = 16;

struct Figures
{
  double triangles = 0, tetrahedra = 0;
  double bytes = 0;
  double seconds = 0; ///< summed over all processors
};

/// The beginning of the names of this host's scratch folders; the process and random letters follow.
std::string scratchName() { return "surgicalmesher-" + hostName() + "-"; }

/// The process that a scratch folder of this host belongs to; 0 for any other name.
int ownerOfScratch(const std::string& name)
{
  const std::string before = scratchName();
  if (name.compare(0, before.size(), before) != 0) return 0;
  long owner = 0;
  text::parseInteger(name.substr(before.size(), name.rfind('.') - before.size()), 1, std::numeric_limits<int>::max(),
                     owner);
  return int(owner);
}

/// Removes the scratch folders of killed runs of the same user.
void removeLeftovers(const fs::path& place)
{
  std::error_code error;
  std::vector<fs::path> leftovers;
  for (fs::directory_iterator entry(place, error), end; !error && entry != end; entry.increment(error))
  {
    const int owner = ownerOfScratch(entry->path().filename().string());
    struct stat status = {};
    const bool isOurs = owner > 0 && !processIsAlive(owner) && lstat(entry->path().c_str(), &status) == 0 &&
                        S_ISDIR(status.st_mode) && status.st_uid == geteuid();
    if (isOurs) leftovers.push_back(entry->path());
  }
  for (const fs::path& leftover : leftovers) fs::remove_all(leftover, error);
}

/// Makes a folder that nobody else can have foreseen, and only this user can open. Throws InputError if it cannot.
std::string madeScratchFolder()
{
  std::error_code error;
  const fs::path place = fs::temp_directory_path(error);
  const char* const given = std::getenv("TMPDIR");
  if (error)
    throw InputError(std::string("TMPDIR: ") + (given ? given : "/tmp") +
                     " is no folder, a folder for temporary files expected");
  removeLeftovers(place);
  std::string path = (place / (scratchName() + std::to_string(processId()) + ".XXXXXX")).string();
  if (!mkdtemp(path.data()))
    throw InputError("TMPDIR: no folder can be made in " + place.string() + " (" + std::strerror(errno) +
                     "), a folder to write temporary files to expected");
  return path;
}

/// A temporary folder, removed with its contents at the end of its lifetime.
class ScratchFolder
{
public:
  ScratchFolder() : m_Path(madeScratchFolder()) {}
  ~ScratchFolder()
  {
    std::error_code error;
    fs::remove_all(m_Path, error);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  const std::string& path() const { return m_Path; }

private:
  std::string m_Path;
};

void runStages(const RunRequest& request, const std::string& programs, CommandLine& line, const Progress& progress)
{
  const std::vector<Stage> stages = stagesToScale(request);
  double done = 0;
  for (const Stage& stage : stages)
  {
    const double begin = done;
    done += stage.share / shareOf(stages);
    runStage(stage, programs, line, subProgress(progress, begin, done));
  }
}

/// Reads the estimate from the report of the scale stage, which has read the map.
Figures readFigures(const std::string& file)
{
  rapidjson::Document json;
  json.Parse(text::readTextFile(file).c_str());
  const auto& estimate = json["estimate"];
  Figures figures;
  figures.triangles = estimate["triangles"].GetDouble();
  figures.tetrahedra = estimate["tetrahedra"].GetDouble();
  figures.bytes = std::max(estimate["surfaceMemoryBytes"].GetDouble(), estimate["tetrahedralMemoryBytes"].GetDouble());
  const double samples = std::min(estimate["voxelFaces"].GetDouble(), samplesPerTriangle * figures.triangles);
  figures.seconds = secondsPerSample * samples + secondsPerStartingFace * estimate["startingFaces"].GetDouble() +
                    secondsPerTetrahedron * figures.tetrahedra + secondsPerVoxel * estimate["meshedVoxels"].GetDouble();
  return figures;
}

void writeFigures(const Figures& figures, const std::string& file)
{
  const auto writeMembers = [&](JsonWriter& json)
  {
    writeMember(json, "triangles", std::int64_t(figures.triangles));
    writeMember(json, "tetrahedra", std::int64_t(figures.tetrahedra));
    writeMember(json, "memoryBytes", std::int64_t(figures.bytes));
    writeMember(json, "processorSeconds", figures.seconds);
  };
  writeBytes(jsonText(writeMembers, { 3 }), file);
}

} // namespace

void estimateCommand(CommandLine& line, const std::string& programs, const std::string& xml)
{
  RunOptions given = line.givenValues();
  given.erase("estimate");
  const Progress progress = line.progress();
  Figures figures;
  try
  {
    const ScratchFolder folder; // is gone before anything is printed: the reader of that may be gone, and end this run
    const RunRequest request{ absolutePath(line.text("labelMap")), folder.path(),
                              completedOptions(given, parseModuleDescription(xml)) };
    runStages(request, programs, line, progress);
    figures = readFigures(folder.path() + "/scale.json");
  }
  catch (const Interrupted& end)
  {
    std::raise(end.signal); // handled as in every program: says so, and removes what is half written
    throw EngineError("interrupted");
  }
  line.message("memory: about " + text::rounded(figures.bytes / 1e6) + " MB at most");
  line.message("time: about " + text::rounded(figures.seconds, 2) + " s on one processor");
  const std::string file = line.outputFile("estimate");
  if (!file.empty()) writeFigures(figures, file);
  report(progress, 1, "done");
}

} // namespace surgicalmesher
