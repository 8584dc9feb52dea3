// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Text from files and command lines, safe to print.

#include <cstddef>
#include <string>

namespace surgicalmesher
{

/// Length in bytes of the UTF-8 character that begins at byte `at` (Unicode 15, table 3-7); 0 if none begins there.
std::size_t utf8Length(const std::string& text, std::size_t at);

bool isUTF8(const std::string& text);

/// Returns `text` as UTF-8 that is safe for terminals, logs and programs: control characters other than white space
/// (C0, DEL, C1), characters that change the writing direction, and bytes that are not UTF-8 become \xHH, byte by byte.
std::string printable(const std::string& text);

/// Returns UTF-8 text as a JSON or TOML string, including the quotes.
std::string quoted(const std::string& text);

} // namespace surgicalmesher
