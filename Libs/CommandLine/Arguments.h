// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The arguments of a module, parsed and checked against its description.

#include "ModuleDescription.h"

#include <map>
#include <string>
#include <vector>

namespace surgicalmesher
{

struct Arguments
{
  std::map<std::string, std::vector<std::string>> values; ///< by parameter name; only what was given
  std::string returnParameterFile;                        ///< empty if not asked for
  bool echo = false;
};

/// Parses the arguments after the program's name: `--flag value`, `--flag=value`, `-f value`, positional arguments in
/// any place, `--` before positional arguments that begin with a dash. A boolean flag takes no value and inverts its
/// default. A file parameter with multiple="true" also takes a comma separated list, in which a name with a comma
/// stands in double quotes. Besides the module's own flags, --returnparameterfile FILE, --echo and
/// --processinformationaddress ADDRESS (not used) are known, as to every command-line module. Throws UsageError for an
/// unknown flag, a missing, surplus or repeated value, and a value its parameter does not accept.
Arguments parseArguments(const ModuleDescription& description, const std::vector<std::string>& arguments);

} // namespace surgicalmesher
