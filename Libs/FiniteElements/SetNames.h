// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Set names that every export format accepts.
///
/// All formats use one grammar: an ASCII letter, then letters, digits and underscores (no two in a row, none at the
/// end), at most 80 characters (CalculiX). Names are distinct even without regard to case (Abaqus and CalculiX fold
/// case).

#include <cstddef>
#include <set>
#include <string>

namespace surgicalmesher
{

constexpr std::size_t kLongestName = 80;

/// Returns `text` (UTF-8) converted to this grammar: Latin letters lose their accents, other characters become
/// underscores, and leading digits get the prefix `n`. A text longer than `length` keeps its head and its tail, since
/// names of left and right structures often differ there. Returns an empty string if no letter or digit is left.
std::string validName(const std::string& text, std::size_t length = kLongestName);

/// Returns `text` as valid UTF-8 for JSON and XML; bytes that are not UTF-8 are taken as Latin-1.
std::string validUtf8(const std::string& text);

/// Generator of distinct names.
class SetNames
{
public:
  explicit SetNames(std::size_t longest = kLongestName) : m_Longest(longest) {}

  /// Returns the valid name of `text`, or of `fallback` if that is empty, with the suffix _2, _3 ... if it is already
  /// taken.
  std::string unique(const std::string& text, const std::string& fallback = "unnamed");

private:
  std::size_t m_Longest;
  std::set<std::string> m_Taken; ///< upper case
};

} // namespace surgicalmesher
