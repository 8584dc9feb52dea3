// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Runs one stage.

#include "CommandLine.h"
#include "Stages.h"

namespace surgicalmesher
{

/// Runs the stage's program, which lies in `programs`; its messages and warnings are passed to `line`. Returns the
/// absolute paths of all files that it wrote, including those that accompany an output. Throws the error with which the
/// program ended, or Interrupted (ChildProcess.h).
std::vector<std::string> runStage(const Stage& stage, const std::string& programs, CommandLine& line,
                                  const Progress& progress);

} // namespace surgicalmesher
