// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Text from files and command lines, safe to print.

#include <cstddef>
#include <string>

namespace surgicalmesher
{

/// Bytes of the UTF-8 character that begins at byte `at` (Unicode 15, table 3-7); 0 if none does.
std::size_t utf8Length(const std::string& text, std::size_t at);

bool isUTF8(const std::string& text);

/// `text` as UTF-8 that a terminal, a log and a program can take: control characters other than white space (C0, DEL,
/// C1), characters that turn the direction of what follows, and bytes that are no UTF-8 become \xHH, byte by byte.
std::string printable(const std::string& text);

/// UTF-8 as a string of JSON or TOML, its quotes included.
std::string quoted(const std::string& text);

} // namespace surgicalmesher
