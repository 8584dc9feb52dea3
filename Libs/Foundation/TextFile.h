// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Whole files: text to read, bytes to write.

#include "Text.h"

namespace surgicalmesher
{
namespace text
{

/// The whole file, without a byte order mark. Throws InputError if it is missing, a directory or unreadable.
std::string readTextFile(const std::string& file);

/// Throws InputError unless `file` is a regular file that can be read.
void requireReadableFile(const std::string& file);

} // namespace text

/// Writes `bytes` to `file`, and throws InputError unless all of them arrived there.
void writeBytes(const std::string& bytes, const std::string& file);

} // namespace surgicalmesher
