// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Reading and writing of whole files.

#include "Text.h"

namespace surgicalmesher
{
namespace text
{

/// Returns the whole file without a byte order mark. Throws InputError if it is missing, no regular file, or
/// unreadable.
std::string readTextFile(const std::string& file);

/// Throws InputError unless `file` is a regular file that can be read.
void requireReadableFile(const std::string& file);

} // namespace text

/// Writes `bytes` to `file`. Throws InputError if not all of them could be written.
void writeBytes(const std::string& bytes, const std::string& file);

} // namespace surgicalmesher
