// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Numbers as text, independent of the locale.

#include <cstdint>
#include <string>
#include <vector>

namespace surgicalmesher
{

/// Returns the shortest decimal text that reads back as `value`; if that is longer than `length` (at least 20), the
/// value rounded to 13 digits. CalculiX reads 20 characters and ignores the rest.
std::string textOf(double value, std::size_t length = 24);

/// Returns `value` with as many digits as fit into `width` characters (at least 10), always with a decimal point:
/// fixed-column Fortran formats imply one where it is missing.
std::string textWithin(double value, std::size_t width);

/// Appends ids counted from 1, separated by commas, at most `perLine` in a line; `lineEnd` is added after every full
/// line but the last.
void appendIds(std::string& text, const std::vector<std::int32_t>& ids, std::size_t perLine,
               const std::string& lineEnd = "");

} // namespace surgicalmesher
