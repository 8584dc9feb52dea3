// SPDX-License-Identifier: Apache-2.0
#include "RunRecord.h"

#include "Errors.h"
#include "HeaderData.h"
#include "JsonReport.h"
#include "OutputFiles.h"
#include "TextFile.h"

#include <rapidjson/document.h>
#include <vtksys/MD5.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>

namespace fs = std::filesystem;

namespace surgicalmesher
{

namespace
{

std::string recordFile(const std::string& folder) { return (fs::path(folder) / "stages.json").string(); }

std::map<std::string, std::string> textsOf(const rapidjson::Value& stage, const char* key)
{
  std::map<std::string, std::string> texts;
  if (!stage.HasMember(key) || !stage[key].IsObject()) return texts;
  for (const auto& member : stage[key].GetObject())
  {
    if (member.value.IsString()) texts[member.name.GetString()] = member.value.GetString();
  }
  return texts;
}

StageRecord readStage(const rapidjson::Value& stage)
{
  StageRecord record;
  if (!stage.IsObject()) return record;
  if (stage.HasMember("program") && stage["program"].IsString()) record.program = stage["program"].GetString();
  record.inputs = textsOf(stage, "inputs");
  record.outputs = textsOf(stage, "outputs");
  if (stage.HasMember("seconds") && stage["seconds"].IsNumber()) record.seconds = stage["seconds"].GetDouble();
  if (stage.HasMember("arguments") && stage["arguments"].IsArray())
  {
    for (const auto& word : stage["arguments"].GetArray())
      if (word.IsString()) record.arguments.emplace_back(word.GetString());
  }
  return record;
}

void writeTexts(JsonWriter& json, const char* key, const std::map<std::string, std::string>& texts)
{
  writeObject(json, key,
              [&]
              {
                for (const auto& [name, text] : texts) writeMember(json, name.c_str(), text);
              });
}

/// Returns the name up to the first dot: "map" of "map.nii.gz".
std::string stemOf(const fs::path& file)
{
  const std::string name = file.filename().string();
  return name.substr(0, name.find('.', 1));
}

/// Returns a path, or a flag with one as its value, without the path of the folder before it.
std::string insideFolder(std::string text, const std::string& folder)
{
  std::size_t begin = text.rfind("--", 0) == 0 ? text.find('=') + 1 : 0;
  if (begin < text.size() && text[begin] == '"') ++begin;
  const std::string before = folder + "/";
  return text.compare(begin, before.size(), before) == 0 ? text.erase(begin, before.size()) : text;
}

/// A file's last extension, without compression: ".raw" of "map.01.raw.gz".
std::string kindOf(const fs::path& file)
{
  const std::string last = text::lowerCase(file.extension().string());
  return last == ".gz" || last == ".bz2" ? text::lowerCase(file.stem().extension().string()) : last;
}

/// Whether a file certainly holds no image data. A header can refer to its data by any name, and a missed change of the
/// data would leave a mesh of an older image. Text may be data (ASCII data of NRRD); mesh formats are listed because
/// --export may have written them there.
bool isNoData(const fs::path& file)
{
  static const std::set<std::string> kinds{ ".log",  ".out",  ".err",  ".json",  ".toml", ".yaml", ".yml",
                                            ".csv",  ".tsv",  ".html", ".pdf",   ".md",   ".png",  ".jpg",
                                            ".svg",  ".sh",   ".py",   ".slurm", ".vtu",  ".vtp",  ".stl",
                                            ".ply",  ".feb",  ".inp",  ".k",     ".cdb",  ".bdf",  ".msh",
                                            ".msh2", ".mesh", ".exo",  ".xdmf",  ".h5" };
  return kinds.count(kindOf(file)) != 0;
}

/// The file, and those beside it that share its name and may hold its data.
std::vector<std::string> withSiblings(const std::string& file)
{
  std::vector<std::string> files{ file };
  std::error_code error;
  for (fs::directory_iterator entry(fs::path(file).parent_path(), error), end; !error && entry != end;
       entry.increment(error))
  {
    const bool isSibling =
      entry->is_regular_file(error) && stemOf(entry->path()) == stemOf(file) && !isNoData(entry->path());
    if (isSibling) files.push_back(entry->path().string());
  }
  return files;
}

} // namespace

std::string fingerprint(const std::string& file)
{
  std::ifstream stream(file, std::ios::binary);
  if (!stream) return {};
  vtksysMD5* md5 = vtksysMD5_New();
  vtksysMD5_Initialize(md5);
  std::vector<char> buffer(1 << 20);
  while (stream.read(buffer.data(), std::streamsize(buffer.size())), stream.gcount() > 0)
    vtksysMD5_Append(md5, reinterpret_cast<const unsigned char*>(buffer.data()), int(stream.gcount()));
  std::string digest(32, ' ');
  vtksysMD5_FinalizeHex(md5, digest.data());
  vtksysMD5_Delete(md5);
  return digest;
}

StageRecord recordOf(const Stage& stage, const std::string& program, const std::string& folder)
{
  StageRecord record;
  record.program = fingerprint(program);
  for (const std::string& word : stage.arguments)
  {
    if (word.rfind("--threads=", 0) != 0) record.arguments.push_back(insideFolder(word, folder));
  }
  for (const std::string& input : stage.inputs)
  {
    const bool isOwn = fs::path(input).parent_path() == fs::path(folder);
    std::vector<std::string> files = isOwn ? std::vector<std::string>{ input } : withSiblings(input);
    for (const std::string& file : dataFilesOf(input)) files.push_back(file);
    for (const std::string& file : files) record.inputs[insideFolder(file, folder)] = fingerprint(file);
  }
  return record;
}

bool stillHolds(const StageRecord& earlier, const StageRecord& present, const std::string& folder)
{
  if (earlier.program != present.program || earlier.arguments != present.arguments || earlier.inputs != present.inputs)
    return false;
  const auto isWhole = [&](const auto& output)
  { return fingerprint((fs::path(folder) / output.first).string()) == output.second; };
  return !earlier.outputs.empty() && std::all_of(earlier.outputs.begin(), earlier.outputs.end(), isWhole);
}

RunRecord readRunRecord(const std::string& folder)
{
  RunRecord record;
  std::error_code error;
  if (!fs::exists(recordFile(folder), error)) return record;
  rapidjson::Document json;
  json.Parse(text::readTextFile(recordFile(folder)).c_str());
  if (json.HasParseError() || !json.IsObject()) return record;
  for (const auto& stage : json.GetObject()) record[stage.name.GetString()] = readStage(stage.value);
  return record;
}

void writeRunRecord(const RunRecord& record, const std::string& folder)
{
  const auto writeStages = [&](JsonWriter& json)
  {
    for (const auto& [name, stage] : record)
    {
      writeObject(json, name.c_str(),
                  [&, &stage = stage]
                  {
                    writeMember(json, "program", stage.program);
                    writeMember(json, "arguments", stage.arguments);
                    writeTexts(json, "inputs", stage.inputs);
                    writeTexts(json, "outputs", stage.outputs);
                    writeMember(json, "seconds", stage.seconds);
                  });
    }
  };
  writeWhole(jsonText(writeStages), recordFile(folder));
}

} // namespace surgicalmesher
