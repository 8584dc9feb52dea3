// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What the drivers of other meshers share: they print seconds by phase, sizes, and the peak of memory as one JSON
/// object, or one line on stderr.

#include <chrono>
#include <cstddef>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace surgicalmesher
{

/// Wall-clock seconds of named phases, one after the other.
class Stopwatch
{
public:
  /// Ends the phase that began with the last call, or with construction.
  void lap(const std::string& phase)
  {
    const auto now = std::chrono::steady_clock::now();
    m_Phases.emplace_back(phase, std::chrono::duration<double>(now - m_Start).count());
    m_Start = now;
  }

  const std::vector<std::pair<std::string, double>>& phases() const { return m_Phases; }

private:
  std::chrono::steady_clock::time_point m_Start = std::chrono::steady_clock::now();
  std::vector<std::pair<std::string, double>> m_Phases;
};

/// {"program": .., "seconds": {phase: s, ..}, "points": .., "tetrahedra": .., "peakMemory": bytes}
std::string runJSON(const std::string& program, const Stopwatch& stopwatch, std::size_t points, std::size_t tetrahedra);

/// Runs `work`. The exit status: 0, or that of the error, which goes to stderr.
int runDriver(const std::function<void()>& work);

} // namespace surgicalmesher
