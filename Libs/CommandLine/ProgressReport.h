// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Progress on stdout: XML tags as Slicer's host reads them when it is a pipe, a bar on a terminal.

#include <chrono>
#include <mutex>
#include <ostream>
#include <string>

namespace surgicalmesher
{

class ProgressReport
{
public:
  ProgressReport(std::ostream& stream, bool terminal, const std::string& title);

  /// May be called from several threads, as often as they like: at most ten updates a second are written, besides the
  /// beginning of each stage.
  void update(double fraction, const std::string& stage);

  /// A line of text between updates.
  void message(const std::string& line);

  void finish(); ///< ends the stage, or the bar's line

private:
  using Clock = std::chrono::steady_clock;

  void beginStage(const std::string& stage);
  void endStage();
  void drawBar(double fraction);

  std::ostream& m_Stream;
  bool m_Terminal;
  std::string m_Title;
  std::string m_Stage;
  bool m_InStage = false;
  double m_LastFraction = 0;
  std::size_t m_BarWidth = 0; ///< characters on the bar's line
  Clock::time_point m_StageStart, m_LastUpdate;
  std::mutex m_Mutex;
};

} // namespace surgicalmesher
