// SPDX-License-Identifier: Apache-2.0
#pragma once
/// One stage, run.

#include "CommandLine.h"
#include "Stages.h"

namespace surgicalmesher
{

/// Runs the stage's program, which lies in `programs`; its messages and warnings become those of `line`. Returns the
/// absolute paths of all files that it wrote, also those that go with an output. Throws the error that the program
/// ended with, and Interrupted (ChildProcess.h).
std::vector<std::string> runStage(const Stage& stage, const std::string& programs, CommandLine& line,
                                  const Progress& progress);

} // namespace surgicalmesher
