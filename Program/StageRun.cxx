// SPDX-License-Identifier: Apache-2.0
#include "StageRun.h"

#include "ChildProcess.h"
#include "Errors.h"
#include "Text.h"

#include <rapidjson/document.h>

#include <filesystem>

namespace surgicalmesher
{

namespace
{

/// Restores the bytes of a path reported by a program. Bytes that are not UTF-8 are reported as surrogates \udcHH
/// (ProgressReport.h), which RapidJSON converts to three bytes like any character: the last eight bits are the byte.
std::string pathIn(const std::string& text)
{
  std::string path;
  for (std::size_t at = 0; at < text.size(); ++at)
  {
    const bool isSurrogate = at + 2 < text.size() && text[at] == '\xed' && (text[at + 1] & 0xfe) == 0xb2;
    path += isSurrogate ? char((text[at + 1] & 3) << 6 | (text[at + 2] & 0x3f)) : text[at];
    if (isSurrogate) at += 2;
  }
  return path;
}

/// Handles a line of a program's --progress json. Files that it reports as written are added to `files`.
void handOn(const std::string& text, const Stage& stage, CommandLine& line, const Progress& progress,
            std::vector<std::string>& files)
{
  rapidjson::Document json;
  json.Parse(text.c_str());
  if (json.HasParseError() || !json.IsObject()) return;
  if (json.HasMember("progress") && json["progress"].IsNumber() && json.HasMember("stage"))
    report(progress, json["progress"].GetDouble(), stage.name + ": " + json["stage"].GetString());
  if (json.HasMember("message")) line.message(stage.name + ": " + json["message"].GetString());
  if (json.HasMember("warning")) line.warning(json["warning"].GetString());
  if (json.HasMember("output")) files.push_back(pathIn(json["output"].GetString()));
}

/// The last line that is no warning, without the program's name.
std::string reasonIn(const std::string& errors, const Stage& stage)
{
  std::string reason;
  for (const std::string& text : text::splitLines(errors))
  {
    if (!text.empty() && text.find(": warning: ") == std::string::npos) reason = text;
  }
  const std::string prefix = stage.program + ": ";
  return reason.rfind(prefix, 0) == 0 ? reason.substr(prefix.size()) : reason;
}

} // namespace

std::vector<std::string> runStage(const Stage& stage, const std::string& programs, CommandLine& line,
                                  const Progress& progress)
{
  std::vector<std::string> arguments = stage.arguments;
  arguments.insert(arguments.begin(), "--progress=json");
  report(progress, 0, stage.name);
  std::vector<std::string> files;
  const ChildOutcome outcome = runChild((std::filesystem::path(programs) / stage.program).string(), arguments,
                                        [&](const std::string& text) { handOn(text, stage, line, progress, files); });
  if (outcome.status == 0) return files;
  const std::string reason = reasonIn(outcome.errors, stage);
  if (outcome.status == 1) throw InputError(reason);
  if (outcome.status == 2) throw UsageError(reason);
  throw EngineError("stage " + stage.name + ": " +
                    (reason.empty() ? "ended with status " + std::to_string(outcome.status) : reason));
}

} // namespace surgicalmesher
