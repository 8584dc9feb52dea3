// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Record of the results of earlier runs in a folder (stages.json), and whether they still hold. Files in the folder
/// are recorded by their names, so that the record stays valid when the folder is moved or copied.

#include "Stages.h"

namespace surgicalmesher
{

struct StageRecord
{
  std::string program;                        ///< MD5 of the program's bytes
  std::vector<std::string> arguments;         ///< without the number of threads, which does not affect the results
  std::map<std::string, std::string> inputs;  ///< MD5 of the bytes by file
  std::map<std::string, std::string> outputs; ///< likewise
  double seconds = 0;                         ///< duration of the stage
};

using RunRecord = std::map<std::string, StageRecord>; ///< by name of the stage

/// Reads the record of a folder; empty if there is none or it is not valid JSON.
RunRecord readRunRecord(const std::string& folder);
void writeRunRecord(const RunRecord& record, const std::string& folder);

/// MD5 of a file's bytes, in hexadecimal; empty if it can't be read.
std::string fingerprint(const std::string& file);

/// Returns the record of a stage that is about to run, without outputs. Inputs outside of `folder` include the files
/// that a header names as its data, and the files beside them with the same name up to the first dot, which may hold
/// their data, except those whose extension rules this out, such as logs.
StageRecord recordOf(const Stage& stage, const std::string& program, const std::string& folder);

/// Whether `earlier` was run with the same program, arguments and inputs as `present`, and its outputs are unchanged.
bool stillHolds(const StageRecord& earlier, const StageRecord& present, const std::string& folder);

} // namespace surgicalmesher
