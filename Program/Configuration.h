// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Options in TOML: read from a user's file, and written so that a run can be repeated.

#include "RunOptions.h"

namespace surgicalmesher
{

/// Reads the options in a file, one key each: texts, numbers, true or false, and lists of these; points are lists of
/// three numbers. Relative paths refer to the folder of the file. Throws InputError with the file's name for invalid
/// TOML, an unknown key (suggesting the most similar one), and a value that its option does not accept.
RunOptions readConfiguration(const std::string& file, const ModuleDescription& description);

/// Returns every option of `description` in order, each with its description as a comment, for a file in the folder of
/// the results (option `folder`). Paths in that folder are relative to it, others absolute. Options with neither a
/// value nor a default are commented out. Throws UsageError for texts that are not UTF-8, which TOML cannot hold.
std::string configurationText(const RunOptions& options, const ModuleDescription& description);

} // namespace surgicalmesher
