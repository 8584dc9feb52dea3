// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Names that every format accepts.
///
/// One grammar for all: an ASCII letter, then letters, digits and underscores (no two in a row, none at the end), at
/// most 80 characters (CalculiX), different from all others in upper case, too (Abaqus and CalculiX fold).

#include <cstddef>
#include <set>
#include <string>

namespace surgicalmesher
{

constexpr std::size_t kLongestName = 80;

/// `text` (UTF-8) in that grammar: Latin letters lose their accents, anything else becomes an underscore, leading
/// digits get an `n` before them; a text longer than `length` keeps its head and its tail, where left and right differ.
/// Empty if no letter or digit is left.
std::string validName(const std::string& text, std::size_t length = kLongestName);

/// `text` with bytes that are no UTF-8 taken as Latin-1: what JSON and XML can carry.
std::string validUtf8(const std::string& text);

/// Names given out so far.
class SetNames
{
public:
  explicit SetNames(std::size_t longest = kLongestName) : m_Longest(longest) {}

  /// The valid name of `text`, or of `fallback` if none is left, with _2, _3 ... at its end if it is taken.
  std::string unique(const std::string& text, const std::string& fallback = "unnamed");

private:
  std::size_t m_Longest;
  std::set<std::string> m_Taken; ///< upper case
};

} // namespace surgicalmesher
