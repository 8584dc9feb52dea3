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

#include <algorithm>
#include <csignal>
#include <filesystem>

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

/// A temporary folder, removed with its contents at the end of its lifetime.
class ScratchFolder
{
public:
  ScratchFolder()
    : m_Path(fs::temp_directory_path() / ("surgicalmesher-" + hostName() + "-" + std::to_string(processId())))
  {
    fs::create_directory(m_Path);
  }
  ~ScratchFolder()
  {
    std::error_code error;
    fs::remove_all(m_Path, error);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  std::string path() const { return m_Path.string(); }

private:
  fs::path m_Path;
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
  const ScratchFolder folder;
  RunOptions given = line.givenValues();
  given.erase("estimate");
  const RunRequest request{ absolutePath(line.text("labelMap")), folder.path(),
                            completedOptions(given, parseModuleDescription(xml)) };
  const Progress progress = line.progress();
  try
  {
    runStages(request, programs, line, progress);
  }
  catch (const Interrupted& end)
  {
    std::error_code error;
    fs::remove_all(folder.path(), error);
    std::signal(end.signal, SIG_DFL);
    std::raise(end.signal);
  }
  const Figures figures = readFigures(folder.path() + "/scale.json");
  line.message("memory: about " + text::rounded(figures.bytes / 1e6) + " MB at most");
  line.message("time: about " + text::rounded(figures.seconds, 2) + " s on one processor");
  const std::string file = line.outputFile("estimate");
  if (!file.empty()) writeFigures(figures, file);
  report(progress, 1, "done");
}

} // namespace surgicalmesher
