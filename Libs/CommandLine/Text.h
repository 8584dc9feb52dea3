// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Small functions on text. Numbers are read in the C locale and only if the whole text is one.

#include <optional>
#include <string>
#include <vector>

namespace surgicalmesher
{

std::string trimmed(const std::string& text);
std::string lowerCase(std::string text);
std::string oneLine(const std::string& text);                            ///< every run of white space becomes one blank
std::vector<std::string> split(const std::string& text, char separator); ///< empty text: no part
/// Splits at commas outside double quotes, and drops the quotes: how a list of file names is passed in one argument.
std::vector<std::string> splitQuoted(const std::string& text);
std::string joined(const std::vector<std::string>& parts, const std::string& separator);

std::optional<int> parseInteger(const std::string& text);
std::optional<double> parseNumber(const std::string& text); ///< finite
std::string formatNumber(double value);                     ///< shortest form that keeps ten digits

} // namespace surgicalmesher
