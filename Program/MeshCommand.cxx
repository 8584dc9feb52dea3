// SPDX-License-Identifier: Apache-2.0
// surgicalmesher mesh: runs all stages, except those whose earlier results still hold.

#include "Arguments.h"
#include "ChildProcess.h"
#include "Commands.h"
#include "Configuration.h"
#include "Errors.h"
#include "HtmlReport.h"
#include "OutputFiles.h"
#include "Platform.h"
#include "RunRecord.h"
#include "StageRun.h"
#include "TextFile.h"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <iterator>
#include <set>

namespace fs = std::filesystem;

namespace surgicalmesher
{

namespace
{

/// Makes sure that a folder exists; at the end of its lifetime, removes it if it was new and is still empty.
class ResultFolder
{
public:
  explicit ResultFolder(const std::string& path) : m_Path(path)
  {
    std::error_code error;
    if (fs::exists(path, error) && !fs::is_directory(path, error))
      throw InputError(path + ": not a folder, expected one for the results");
    m_IsNew = fs::create_directories(path, error);
    if (error) throw InputError(path + ": the folder cannot be made");
  }
  ~ResultFolder()
  {
    std::error_code error;
    if (m_IsNew && fs::is_empty(m_Path, error)) fs::remove(m_Path, error);
  }
  ResultFolder(const ResultFolder&) = delete;
  ResultFolder& operator=(const ResultFolder&) = delete;

private:
  fs::path m_Path;
  bool m_IsNew;
};

RunRequest requestOf(const CommandLine& line, const ModuleDescription& description)
{
  RunRequest request;
  request.labelMap = absolutePath(line.text("labelMap"));
  request.folder = absolutePath(line.text("folder"));
  if (request.folder.back() == '/') request.folder.pop_back();
  request.options = completedOptions(line.givenValues(), description);
  return request;
}

/// Returns the input files that are the user's, not outputs of earlier stages.
std::vector<std::string> givenFiles(const std::vector<Stage>& stages)
{
  std::vector<std::string> written, given;
  for (const Stage& stage : stages)
  {
    for (const std::string& input : stage.inputs)
    {
      if (std::find(written.begin(), written.end(), input) == written.end()) given.push_back(input);
    }
    written.insert(written.end(), stage.outputs.begin(), stage.outputs.end());
  }
  return given;
}

void requireReadable(const std::vector<std::string>& files)
{
  for (const std::string& file : files) text::requireReadableFile(file);
}

/// Files that a whole run writes.
std::vector<std::string> allOutputs(const std::vector<Stage>& stages, const fs::path& folder)
{
  std::vector<std::string> files;
  for (const Stage& stage : stages) files.insert(files.end(), stage.outputs.begin(), stage.outputs.end());
  for (const char* name : { "stages.json", "run.toml", "report.html" }) files.push_back((folder / name).string());
  return files;
}

/// Throws if a file cannot be written, for example because a folder has its name. Otherwise this could show only after
/// hours, at the last file.
void requireWritable(const std::vector<std::string>& outputs)
{
  OutputFiles attempt; // leaves nothing behind without commit()
  for (const std::string& output : outputs) attempt.temporary(output);
}

void requireInputsKept(const std::vector<std::string>& outputs, const std::vector<std::string>& given)
{
  for (const std::string& output : outputs)
  {
    for (const std::string& input : given)
    {
      if (placeOf(input) == placeOf(output))
        throw UsageError(input + " would be overwritten, expected another folder for the results");
    }
  }
}

/// Not one of the command line's outputs: this file may be the --config of the run.
void writeConfiguration(const std::string& configuration, const fs::path& folder)
{
  writeWhole(configuration, (folder / "run.toml").string());
}

/// State of the results folder while the stages run.
struct Results
{
  fs::path folder;
  std::vector<std::string> given; ///< the user's files, some of which may lie in the folder
  std::string configuration;      ///< of the current run
  RunRecord record;
  bool hasEarlier;                 ///< whether an earlier run left a record; results of the current run do not count
  std::vector<std::string> others; ///< stages of the earlier run that the current one does not have
};

void writeRecord(const Results& results, CommandLine& line)
{
  writeRunRecord(results.record, results.folder.string());
  line.tellWritten((results.folder / "stages.json").string());
}

/// Returns the files in the folder that a stage of the record has written. Files elsewhere are left out: exports to
/// other places, and whatever a record from another folder names.
std::vector<fs::path> outputsInFolder(const std::string& stage, const Results& results)
{
  std::vector<fs::path> files;
  const auto recorded = results.record.find(stage);
  if (recorded == results.record.end()) return files;
  for (const auto& output : recorded->second.outputs)
  {
    const fs::path file(output.first);
    if (file == file.filename()) files.push_back(results.folder / file);
  }
  return files;
}

/// Removes the outputs of a stage, except those at the places `kept`, and its record.
void removeOutputs(const std::string& stage, const std::set<std::string>& kept, Results& results)
{
  for (const fs::path& file : outputsInFolder(stage, results))
  {
    std::error_code error;
    if (kept.count(placeOf(file.string())) == 0) fs::remove(file, error);
  }
  results.record.erase(stage);
}

/// Removes what was made from results that have just changed (outputs of stages, and the report), so that the folder
/// never holds results that do not fit together. The files that the current run has just `written` stay, and the user's
/// files, by whatever path they were given. run.toml is not removed but replaced by the options of the current run: it
/// may have been the --config of the run, and be needed for that again.
void removeEarlier(std::vector<std::string> stages, const std::vector<std::string>& written, Results& results,
                   CommandLine& line)
{
  stages.insert(stages.end(), results.others.begin(), results.others.end());
  results.others.clear();
  if (stages.empty() || !results.hasEarlier) return;
  std::error_code error;
  fs::remove(results.folder / "report.html", error);
  if (fs::exists(results.folder / "run.toml", error)) writeConfiguration(results.configuration, results.folder);
  std::set<std::string> kept;
  for (const std::string& file : results.given) kept.insert(placeOf(file));
  for (const std::string& file : written) kept.insert(placeOf(file));
  for (const std::string& stage : stages) removeOutputs(stage, kept, results);
  writeRecord(results, line);
}

std::vector<std::string> namesOf(std::vector<Stage>::const_iterator begin, std::vector<Stage>::const_iterator end)
{
  std::vector<std::string> names;
  std::transform(begin, end, std::back_inserter(names), [](const Stage& stage) { return stage.name; });
  return names;
}

/// Returns the stages of an earlier run that this run does not have.
std::vector<std::string> othersIn(const RunRecord& record, const std::vector<Stage>& stages)
{
  std::vector<std::string> others;
  for (const auto& earlier : record)
  {
    const auto isIt = [&](const Stage& stage) { return stage.name == earlier.first; };
    if (std::none_of(stages.begin(), stages.end(), isIt)) others.push_back(earlier.first);
  }
  return others;
}

/// Returns the fingerprints of the files that a stage has written, and of no others. Keys are paths relative to the
/// folder for files in it, and absolute paths for others. A file reached through a link is recorded under the link's
/// path.
std::map<std::string, std::string> writtenBy(const Stage& stage, const std::vector<std::string>& files,
                                             const fs::path& folder)
{
  std::map<std::string, fs::path> byPlace;
  for (const std::string& output : stage.outputs) byPlace.emplace(placeOf(output), output);
  for (const std::string& file : files) byPlace.emplace(placeOf(file), file);
  std::map<std::string, std::string> written;
  for (const auto& [place, file] : byPlace)
  {
    const std::string bytes = fingerprint(file.string());
    if (!bytes.empty()) written[pathInResults(file, folder).value_or(file).string()] = bytes;
  }
  return written;
}

/// Returns when the outputs of a stage of the record were last written.
std::map<std::string, fs::file_time_type> timesOf(const std::string& stage, const Results& results)
{
  std::map<std::string, fs::file_time_type> times;
  for (const fs::path& file : outputsInFolder(stage, results))
  {
    std::error_code error;
    times[file.string()] = fs::last_write_time(file, error);
  }
  return times;
}

/// Runs a stage. When it has succeeded, removes the earlier results that it has not replaced, and those of the later
/// stages. Until then, all earlier results stay: a mistake in a command line must not cost a finished run. They also
/// stay, as a rule, if the stage fails or is interrupted, since programs write outputs under other names until all are
/// complete; a program that was ended in the moment of renaming them may have replaced some.
std::vector<std::string> runAnew(std::vector<Stage>::const_iterator stage, std::vector<Stage>::const_iterator end,
                                 const std::string& programs, Results& results, CommandLine& line,
                                 const Progress& progress)
{
  const auto before = timesOf(stage->name, results);
  try
  {
    std::vector<std::string> files = runStage(*stage, programs, line, progress);
    std::vector<std::string> written = stage->outputs;
    written.insert(written.end(), files.begin(), files.end());
    removeEarlier(namesOf(stage, end), written, results, line);
    return files;
  }
  catch (...)
  {
    if (timesOf(stage->name, results) != before) removeEarlier(namesOf(stage, end), {}, results, line);
    throw;
  }
}

/// What is known before any stage runs. Throws if a file is missing, or in the way of another.
Results resultsOf(const RunRequest& request, const std::vector<Stage>& stages, const std::string& configuration)
{
  const std::vector<std::string> given = givenFiles(stages);
  requireReadable(given);
  const std::vector<std::string> outputs = allOutputs(stages, request.folder);
  requireInputsKept(outputs, given);
  requireWritable(outputs);
  Results results{ request.folder, given, configuration, readRunRecord(request.folder), false, {} };
  results.hasEarlier = !results.record.empty();
  results.others = othersIn(results.record, stages);
  return results;
}

void addToRecord(const Stage& stage, StageRecord present, const std::vector<std::string>& files, Results& results,
                 CommandLine& line)
{
  for (const std::string& file : files) line.tellWritten(file);
  present.outputs = writtenBy(stage, files, results.folder);
  results.record[stage.name] = std::move(present);
  writeRecord(results, line);
}

/// Runs the stages whose results do not hold any more, and updates the record.
void runStages(const RunRequest& request, const std::string& configuration, const std::string& programs,
               CommandLine& line, const Progress& progress)
{
  const std::vector<Stage> stages = stagesOf(request);
  Results results = resultsOf(request, stages, configuration);
  const double all = shareOf(stages) / 0.96; // the report takes the rest
  double done = 0;
  for (auto stage = stages.begin(); stage != stages.end(); ++stage)
  {
    StageRecord present = recordOf(*stage, (fs::path(programs) / stage->program).string(), request.folder);
    const double begin = done;
    done += stage->share / all;
    const auto earlier = results.record.find(stage->name);
    if (earlier != results.record.end() && stillHolds(earlier->second, present, request.folder))
    {
      line.message(stage->name + ": nothing has changed since the last run, its results stay");
      continue;
    }
    const auto start = std::chrono::steady_clock::now();
    const std::vector<std::string> files =
      runAnew(stage, stages.end(), programs, results, line, subProgress(progress, begin, done));
    present.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    addToRecord(*stage, present, files, results, line);
  }
  removeEarlier({}, {}, results, line);
}

/// Ends this process by the signal. Who closes the pipe that this program writes to wants to hear no more.
[[noreturn]] void endBy(int signal)
{
  if (signal != SIGPIPE)
    writeToStderr("surgicalmesher mesh: interrupted; stages that were complete are kept, and the same command goes on "
                  "from there\n");
  std::signal(signal, SIG_DFL);
  std::raise(signal);
  throw EngineError("interrupted");
}

/// Whether `argument` is a flag whose value is the next argument.
bool takesNext(const std::string& argument, const ModuleDescription& description)
{
  if (argument.find('=') != std::string::npos || argument == "--quiet" || argument == "--echo") return false;
  for (const Parameter* parameter : description.parameters())
  {
    if (argument == "--" + parameter->longFlag) return parameter->type != "boolean";
  }
  return true;
}

/// Returns the arguments that are neither flags nor their values.
std::vector<std::string> positionalsIn(const std::vector<std::string>& arguments, const ModuleDescription& description)
{
  std::vector<std::string> found;
  for (std::size_t i = 0; i < arguments.size(); ++i)
  {
    if (arguments[i].rfind("--", 0) != 0) found.push_back(arguments[i]);
    else if (takesNext(arguments[i], description)) ++i;
  }
  return found;
}

/// The value of `--config`, empty without it.
std::string configurationIn(const std::vector<std::string>& arguments)
{
  for (std::size_t i = 0; i < arguments.size(); ++i)
  {
    if (arguments[i].rfind("--config=", 0) == 0) return arguments[i].substr(9);
    if (arguments[i] == "--config" && i + 1 < arguments.size()) return arguments[i + 1];
  }
  return {};
}

bool isAmong(const std::vector<std::string>& arguments, const std::string& flag)
{
  return std::any_of(arguments.begin(), arguments.end(),
                     [&](const std::string& word) { return word == flag || word.rfind(flag + "=", 0) == 0; });
}

} // namespace

std::vector<std::string> withConfiguration(const std::vector<std::string>& arguments, const std::string& xml)
{
  const std::string file = configurationIn(arguments);
  if (file.empty()) return arguments;
  if (isAmong(arguments, "--preset"))
    throw UsageError("--preset and --config are given, expected one of them: a configuration holds every option");
  const ModuleDescription description = parseModuleDescription(xml);
  RunOptions options = readConfiguration(file, description);
  if (isAmong(arguments, "--target")) options.erase("targetPoint");
  std::vector<std::string> all;
  for (const auto& [name, values] : options)
  {
    const Parameter& parameter = *description.find(name);
    const std::string flag = "--" + parameter.longFlag;
    if (parameter.index >= 0 || isAmong(arguments, flag)) continue;
    if (parameter.type == "boolean" && values.front() != (parameter.defaultValue == "true" ? "true" : "false"))
      all.push_back(flag);
    if (parameter.type == "boolean") continue;
    for (const std::string& value : values) all.push_back(std::string(flag).append("=").append(value));
  }
  const std::size_t found = positionalsIn(arguments, description).size();
  if (found < 2 && options.count("labelMap")) all.push_back(options["labelMap"].front());
  all.insert(all.end(), arguments.begin(), arguments.end());
  if (found < 1 && options.count("folder")) all.push_back(options["folder"].front());
  return all;
}

void meshCommand(CommandLine& line, const std::string& programs, const std::string& xml)
{
  const ModuleDescription description = parseModuleDescription(xml);
  const RunRequest request = requestOf(line, description);
  RunOptions options = request.options;
  options["labelMap"] = { request.labelMap };
  options["folder"] = { request.folder };
  const std::string configuration = configurationText(options, description);
  const Progress progress = line.progress();
  const ResultFolder folder(request.folder);
  try
  {
    runStages(request, configuration, programs, line, progress);
  }
  catch (const Interrupted& end)
  {
    endBy(end.signal);
  }
  report(progress, 0.96, "report");
  writeConfiguration(configuration, request.folder);
  line.tellWritten(request.folder + "/run.toml");
  writeBytes(htmlReport(request.folder, configuration), line.outputPath(request.folder + "/report.html"));
  line.message("report: " + request.folder + "/report.html");
  report(progress, 1, "done");
}

} // namespace surgicalmesher
