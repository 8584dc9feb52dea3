// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The options of a run as values by name, from wherever they come: presets, a configuration file, the command line.

#include "ModuleDescription.h"

#include <map>
#include <string>
#include <vector>

namespace surgicalmesher
{

/// Values by parameter name, as a command line has them.
using RunOptions = std::map<std::string, std::vector<std::string>>;

/// The absolute path, without "." and "..". Throws InputError for an empty path, and for a relative one if the working
/// directory cannot be told: it may have been deleted.
std::string absolutePath(const std::string& path);

/// The same value always in the same letters: numbers as short as they can be.
std::string canonicalValue(const Parameter& parameter, const std::string& value);

/// Whether an option says no more than the program would assume without it.
bool isDefault(const Parameter& parameter, const std::vector<std::string>& values);

/// What a preset sets: draft, default, fine or simulation.
RunOptions presetOptions(const std::string& preset);

/// `given` in canonical letters, completed by its preset; targets all as targetPoint.
RunOptions completedOptions(const RunOptions& given, const ModuleDescription& description);

} // namespace surgicalmesher
