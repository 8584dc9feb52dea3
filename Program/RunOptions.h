// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The options of a run as values by name, whatever their source: presets, a configuration file, or the command line.

#include "ModuleDescription.h"

#include <map>
#include <string>
#include <vector>

namespace surgicalmesher
{

/// Values by parameter name, spelled as on the command line.
using RunOptions = std::map<std::string, std::vector<std::string>>;

/// Returns the absolute path without "." and "..". Throws InputError for an empty path, and for a relative path if the
/// working directory cannot be determined, for example because it was deleted.
std::string absolutePath(const std::string& path);

/// Returns a unique spelling of the value: numbers in their shortest form.
std::string canonicalValue(const Parameter& parameter, const std::string& value);

/// Whether the values are the option's default.
bool isDefault(const Parameter& parameter, const std::vector<std::string>& values);

/// What a preset sets: draft, default, fine or simulation.
RunOptions presetOptions(const std::string& preset);

/// Returns the options in canonical spelling, completed by their preset; all targets become values of targetPoint.
RunOptions completedOptions(const RunOptions& given, const ModuleDescription& description);

} // namespace surgicalmesher
