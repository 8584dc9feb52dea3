// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Numbers as text, the same in every locale.

#include <cstdint>
#include <string>
#include <vector>

namespace surgicalmesher
{

/// The shortest decimal text that reads back as `value`; where that is longer than `length` (at least 20), the 13
/// leading digits: CalculiX reads 20 characters and ignores the rest.
std::string textOf(double value, std::size_t length = 24);

/// As many of its digits as `width` characters take (at least 10), and always a point, without which columns of Fortran
/// suppose one.
std::string textWithin(double value, std::size_t width);

/// Appends ids, counted from 1, with commas between them and at most `perLine` in a line; `lineEnd` goes on after a
/// full line that isn't the last.
void appendIds(std::string& text, const std::vector<std::int32_t>& ids, std::size_t perLine,
               const std::string& lineEnd = "");

} // namespace surgicalmesher
