// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The arguments of a module, parsed and checked against its description.

#include "ModuleDescription.h"

#include <map>
#include <string>
#include <vector>

namespace surgicalmesher
{

/// How progress and messages are written on stdout.
enum class ProgressFormat
{
  Unset, ///< chosen by CommandLine::progress()
  Xml,   ///< tags, as Slicer and other hosts of command-line modules read them
  Bar,   ///< one line that changes, for terminals
  Plain, ///< lines of text, for logs
  Json,  ///< one object per line, for programs
  None
};

struct Arguments
{
  std::map<std::string, std::vector<std::string>> values; ///< by parameter name; only parameters that were given
  std::string returnParameterFile;                        ///< empty if not requested
  bool fromHost = false; ///< a flag was given that only hosts of command-line modules pass
  bool echo = false;
  bool quiet = false;
  ProgressFormat progress = ProgressFormat::Unset;
};

/// Parses the arguments after the program's name: `--flag value`, `--flag=value`, `-f value`, positional arguments in
/// any place, `--` before positional arguments that begin with a dash. A boolean flag takes no value and inverts its
/// default. A file parameter with multiple="true" also takes a comma-separated list, in which names that contain commas
/// are in double quotes, unless a file has the whole value as its name. Besides the module's own flags, every module
/// accepts --returnparameterfile FILE, --echo, --processinformationaddress ADDRESS (the address is not used),
/// --progress FORMAT and --quiet. Throws UsageError for an unknown flag (suggesting the nearest known one, if it is
/// near), a missing, surplus or repeated value, and a value that its parameter does not accept.
Arguments parseArguments(const ModuleDescription& description, const std::vector<std::string>& arguments);

/// Returns the word of `known` with the smallest edit distance from `wanted`, ignoring case; empty if none is near.
std::string nearestWord(const std::string& wanted, const std::vector<std::string>& known);

} // namespace surgicalmesher
