// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Small text files, line by line: what the readers of tables and markups share.

#include <string>
#include <vector>

namespace surgicalmesher
{
namespace text
{

/// The whole file, without a byte order mark. Throws InputError if it is missing, a directory or unreadable.
std::string readTextFile(const std::string& file);

/// Lines without their ends (LF or CR LF).
std::vector<std::string> splitLines(const std::string& text);

/// Words between blanks; a word may be in double quotes, which are dropped.
std::vector<std::string> splitWords(const std::string& line);

/// Fields of one line of comma-separated values, trimmed; a field in double quotes may hold commas, and "" for a quote.
std::vector<std::string> splitFields(const std::string& line);

/// UTF-8 without control characters: these become blanks, and bytes that are no UTF-8 question marks. Names from files
/// then do no harm in the files they go to.
std::string legible(const std::string& text);

std::string trimmed(const std::string& text);
std::string lowerCase(std::string text);

/// Whether the whole of `text` is one finite number, written with a decimal point whatever the locale.
bool parseNumber(const std::string& text, double& value);

/// Whether the whole of `text` is one integer in [minimum, maximum].
bool parseInteger(const std::string& text, long minimum, long maximum, long& value);

/// Throws InputError unless `file` is a regular file that can be read.
void requireReadableFile(const std::string& file);

} // namespace text
} // namespace surgicalmesher
