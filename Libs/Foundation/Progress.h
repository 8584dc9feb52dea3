// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Progress of long work, and the one place where it can be cancelled.

#include <functional>
#include <string>

namespace surgicalmesher
{

/// Called with the share of the whole work done, in [0, 1], and the name of the current stage.
/// Cancel by throwing from it: every algorithm leaves its inputs untouched when that happens.
using Progress = std::function<void(double fraction, const std::string& stage)>;

inline void report(const Progress& progress, double fraction, const std::string& stage)
{
  if (progress) progress(fraction, stage);
}

/// Maps the [0, 1] of a sub-task onto [from, to] of the whole.
inline Progress subProgress(const Progress& progress, double from, double to)
{
  if (!progress) return {};
  return [=](double fraction, const std::string& stage) { progress(from + (to - from) * fraction, stage); };
}

} // namespace surgicalmesher
