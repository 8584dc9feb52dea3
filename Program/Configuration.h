// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Options in TOML: read from a file that a user wrote, written so that a run can be repeated.

#include "RunOptions.h"

namespace surgicalmesher
{

/// The options in a file, one key each: texts, numbers, true and false, and lists of these; points are lists of three
/// numbers. Paths are taken from the folder of the file. Throws InputError, with the file's name, for what is no
/// TOML, an unknown key (with the nearest known one), and a value that its option does not accept.
RunOptions readConfiguration(const std::string& file, const ModuleDescription& description);

/// Every option of `description`, in its order and with its description as a comment, for a file in the folder of the
/// results, option `folder`: paths there are relative to it, others absolute. Options without a value and a default are
/// comments. Throws UsageError for what is not UTF-8, which TOML can't hold.
std::string configurationText(const RunOptions& options, const ModuleDescription& description);

} // namespace surgicalmesher
