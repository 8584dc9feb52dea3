// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What earlier runs left in a folder, and whether it still holds: stages.json. Files in the folder are told by their
/// names there, so that a folder that is moved or copied keeps its record.

#include "Stages.h"

namespace surgicalmesher
{

struct StageRecord
{
  std::string program;                        ///< MD5 of the program's bytes
  std::vector<std::string> arguments;         ///< without the number of threads, which changes no byte
  std::map<std::string, std::string> inputs;  ///< MD5 of the bytes by file
  std::map<std::string, std::string> outputs; ///< likewise
  double seconds = 0;                         ///< that it took
};

using RunRecord = std::map<std::string, StageRecord>; ///< by the stage's name

/// Of a folder without a record, or with one that is no JSON, nothing.
RunRecord readRunRecord(const std::string& folder);
void writeRunRecord(const RunRecord& record, const std::string& folder);

/// MD5 of a file's bytes, in hexadecimal; empty if it can't be read.
std::string fingerprint(const std::string& file);

/// What a stage is about to be run with. Beside a file outside of `folder`, all that shares its name up to the first
/// dot counts, too, as it may hold its data, but for what the last extension says is none, as a log.
StageRecord recordOf(const Stage& stage, const std::string& program, const std::string& folder);

/// Whether `earlier` was run with the same as `present`, and all that it wrote is as it was.
bool stillHolds(const StageRecord& earlier, const StageRecord& present, const std::string& folder);

} // namespace surgicalmesher
