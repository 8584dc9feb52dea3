// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Small functions on text: of command lines, files' names and files' lines. Letters are ASCII's, numbers have a decimal
/// point, whatever the locale.

#include <string>
#include <vector>

namespace surgicalmesher
{
namespace text
{

std::string trimmed(const std::string& text);
std::string lowerCase(std::string text);
std::string oneLine(const std::string& text); ///< every run of white space becomes one blank

/// UTF-8 without control characters: these become blanks, and bytes that are no UTF-8 question marks. Names from files
/// then do no harm in the files they go to.
std::string legible(const std::string& text);

/// For the text and the attributes of XML.
std::string xmlEscaped(const std::string& text);

/// Lower case, with its dot: ".vtp".
std::string extensionOf(const std::string& file);

std::vector<std::string> split(const std::string& text, char separator); ///< empty text: no part
std::string joined(const std::vector<std::string>& parts, const std::string& separator);

/// Lines without their ends (LF or CR LF).
std::vector<std::string> splitLines(const std::string& text);

/// Words between blanks; a word may be in double quotes, which are dropped.
std::vector<std::string> splitWords(const std::string& line);

/// Values between commas, trimmed; a value in double quotes may hold commas, and "" for a quote.
std::vector<std::string> splitFields(const std::string& line);

/// Whether the whole of `text` is one finite number.
bool parseNumber(const std::string& text, double& value);

/// Whether the whole of `text` is one integer in [minimum, maximum]; 3.0 and 3e0 are, as tables have them.
bool parseInteger(const std::string& text, long minimum, long maximum, long& value);

std::string rounded(double value, int digits = 3); ///< to that many significant digits

} // namespace text
} // namespace surgicalmesher
