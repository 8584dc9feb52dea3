// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Helpers for the text of command lines, file names and lines of files. They ignore the locale: letters are those of
/// ASCII, and numbers have a decimal point.

#include <string>
#include <vector>

namespace surgicalmesher
{
namespace text
{

std::string trimmed(const std::string& text);
std::string lowerCase(std::string text);
std::string oneLine(const std::string& text); ///< every run of white space becomes one blank

/// Returns UTF-8 without control characters: they become blanks, and bytes that are not UTF-8 become question marks.
/// Makes names from one file harmless in the files that they are written to.
std::string legible(const std::string& text);

/// Escapes text for use in XML content and in double-quoted attributes.
std::string xmlEscaped(const std::string& text);

/// Returns the extension in lower case, with its dot: ".vtp".
std::string extensionOf(const std::string& file);

std::vector<std::string> split(const std::string& text, char separator); ///< empty text has no parts
std::string joined(const std::vector<std::string>& parts, const std::string& separator);

/// Lines without their ends (LF or CR LF).
std::vector<std::string> splitLines(const std::string& text);

/// Splits at blanks and tabs; a word may be in double quotes, which are dropped.
std::vector<std::string> splitWords(const std::string& line);

/// Splits at commas and trims the values; a value in double quotes may contain commas, and "" for a quote.
std::vector<std::string> splitFields(const std::string& line);

/// Whether the whole of `text` is one finite number.
bool parseNumber(const std::string& text, double& value);

/// Whether the whole of `text` is one integer in [minimum, maximum]; 3.0 and 3e0 count as integers, as tables write
/// them.
bool parseInteger(const std::string& text, long minimum, long maximum, long& value);

std::string rounded(double value, int digits = 3); ///< to that many significant digits

} // namespace text
} // namespace surgicalmesher
