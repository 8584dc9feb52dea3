// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Progress and messages on stdout: tags, a bar, lines or objects (ProgressFormat).

#include "Arguments.h"

#include <chrono>
#include <functional>
#include <mutex>
#include <ostream>
#include <string>

namespace surgicalmesher
{

/// Returns the estimated remaining time, such as "40 s", "3 min" or "2 h 10 min", of work of which `fraction` took
/// `seconds`; empty while too little is done for an estimate.
std::string timeLeft(double fraction, double seconds);

class ProgressReport
{
public:
  /// Warnings go to `warn`, except in XML, whose reader takes other output for errors; there they go to `stream`.
  /// `quiet`: only warnings are written.
  ProgressReport(std::ostream& stream, ProgressFormat format, const std::string& title, bool quiet = false,
                 std::function<void(const std::string&)> warn = {});

  /// May be called from several threads, at any rate: besides the beginning of each stage, at most ten updates per
  /// second are written (as lines of text: one in five seconds).
  void update(double fraction, const std::string& stage);

  /// A line of text between updates.
  void message(const std::string& line);
  void warning(const std::string& line);

  /// Reports a file that is in place, in JSON only, for programs that run this one. A byte of the path that is not
  /// UTF-8 becomes a surrogate, \udcHH, as in Python's file names.
  void output(const std::string& path);

  void finish(); ///< ends the stage, or the bar's line

private:
  using Clock = std::chrono::steady_clock;

  void beginStage(const std::string& stage);
  void endStage();
  void write(double fraction);
  void drawBar(double fraction);
  void wipeBar();
  std::string left(double fraction) const;

  std::ostream& m_Stream;
  ProgressFormat m_Format;
  std::string m_Title;
  bool m_Quiet;
  std::function<void(const std::string&)> m_Warn;
  std::string m_Stage;
  bool m_InStage = false;
  double m_LastFraction = 0;
  double m_WrittenFraction = -1;
  std::size_t m_BarWidth = 0; ///< characters on the bar's line
  Clock::time_point m_Start, m_StageStart, m_LastUpdate;
  std::mutex m_Mutex;
};

} // namespace surgicalmesher
