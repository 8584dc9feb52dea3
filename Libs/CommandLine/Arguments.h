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
  Unset, ///< as suits what reads it
  Xml,   ///< tags, as Slicer and other hosts of command-line modules read them
  Bar,   ///< one line that changes, for terminals
  Plain, ///< lines of text, for logs
  Json,  ///< one object per line, for programs
  None
};

struct Arguments
{
  std::map<std::string, std::vector<std::string>> values; ///< by parameter name; only what was given
  std::string returnParameterFile;                        ///< empty if not asked for
  bool fromHost = false; ///< flags are there that only a host of command-line modules passes
  bool echo = false;
  bool quiet = false;
  ProgressFormat progress = ProgressFormat::Unset;
};

/// Parses the arguments after the program's name: `--flag value`, `--flag=value`, `-f value`, positional arguments in
/// any place, `--` before positional arguments that begin with a dash. A boolean flag takes no value and inverts its
/// default. A file parameter with multiple="true" also takes a comma separated list, in which a name with a comma
/// stands in double quotes. Besides the module's own flags, --returnparameterfile FILE, --echo and
/// --processinformationaddress ADDRESS (not used) are known, as to every command-line module, and --progress FORMAT and
/// --quiet. Throws UsageError for an unknown flag (with the nearest known one, if it is near), a missing, surplus or
/// repeated value, and a value its parameter does not accept.
Arguments parseArguments(const ModuleDescription& description, const std::vector<std::string>& arguments);

/// Of words, the one that takes the fewest changes to become `wanted`; empty if these are many.
std::string nearestWord(const std::string& wanted, const std::vector<std::string>& known);

} // namespace surgicalmesher
