// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The commands of surgicalmesher: what runs after their options have been checked.

#include "CommandLine.h"

#include <string>
#include <vector>

namespace surgicalmesher
{

/// `programs` is the folder with the programs of the stages, `xml` the description of the command.
void meshCommand(CommandLine& line, const std::string& programs, const std::string& xml);
void estimateCommand(CommandLine& line, const std::string& programs, const std::string& xml);
void qualityCommand(CommandLine& line);
void convertCommand(CommandLine& line);
void viewCommand(CommandLine& line);

/// Returns `arguments` of the mesh command preceded by the options of the file given by --config, if any, except those
/// that `arguments` contain. With --config, a single argument without a flag is the folder.
std::vector<std::string> withConfiguration(const std::vector<std::string>& arguments, const std::string& xml);

} // namespace surgicalmesher
