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

/// "40 s", "3 min", "2 h 10 min": how long a work goes on of which `fraction` took `seconds`; empty while too little of
/// it is done to tell.
std::string timeLeft(double fraction, double seconds);

class ProgressReport
{
public:
  /// Warnings go to `warn`, but in XML, whose reader takes all that comes elsewhere for errors. Quiet: nothing is
  /// written but warnings.
  ProgressReport(std::ostream& stream, ProgressFormat format, const std::string& title, bool quiet = false,
                 std::function<void(const std::string&)> warn = {});

  /// May be called from several threads, as often as they like: at most ten updates a second are written (as lines: one
  /// in five seconds), besides the beginning of each stage.
  void update(double fraction, const std::string& stage);

  /// A line of text between updates.
  void message(const std::string& line);
  void warning(const std::string& line);

  /// A file that is in place, told in JSON only: programs that run others have to know. A byte of its path that is no
  /// UTF-8 is a surrogate, \udcHH, as Python has it in paths.
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
