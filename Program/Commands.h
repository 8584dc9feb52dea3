// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The commands of surgicalmesher: what runs after their options have been checked.

#include "CommandLine.h"

#include <string>
#include <vector>

namespace surgicalmesher
{

/// `programs` is the folder of the programs that stages are, `xml` the command's own description.
void meshCommand(CommandLine& line, const std::string& programs, const std::string& xml);
void estimateCommand(CommandLine& line, const std::string& programs, const std::string& xml);
void qualityCommand(CommandLine& line);
void convertCommand(CommandLine& line);
void viewCommand(CommandLine& line);

/// `arguments` of the mesh command with the options of its --config before them, if there is one, but for those that
/// the command line has. A single argument without a flag then is the folder.
std::vector<std::string> withConfiguration(const std::vector<std::string>& arguments, const std::string& xml);

} // namespace surgicalmesher
