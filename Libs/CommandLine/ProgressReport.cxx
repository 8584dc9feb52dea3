// SPDX-License-Identifier: Apache-2.0
#include "ProgressReport.h"

#include "Text.h"

#include <algorithm>
#include <cmath>

namespace surgicalmesher
{

namespace
{

std::string escaped(const std::string& text)
{
  std::string result;
  for (const char letter : text)
  {
    if (letter == '<') result += "&lt;";
    else if (letter == '&') result += "&amp;";
    else result += letter;
  }
  return result;
}

} // namespace

ProgressReport::ProgressReport(std::ostream& stream, bool terminal, const std::string& title)
  : m_Stream(stream), m_Terminal(terminal), m_Title(title)
{
}

void ProgressReport::update(double fraction, const std::string& stage)
{
  const std::lock_guard<std::mutex> lock(m_Mutex);
  m_LastFraction = std::clamp(fraction, 0.0, 1.0);
  const bool newStage = !m_InStage || stage != m_Stage;
  const Clock::time_point now = Clock::now();
  if (!newStage && now - m_LastUpdate < std::chrono::milliseconds(100)) return;
  m_LastUpdate = now;
  if (newStage) beginStage(stage);
  if (m_Terminal) drawBar(m_LastFraction);
  else m_Stream << "<filter-progress>" << formatNumber(m_LastFraction) << "</filter-progress>\n" << std::flush;
}

void ProgressReport::message(const std::string& line)
{
  const std::lock_guard<std::mutex> lock(m_Mutex);
  if (m_Terminal && m_BarWidth) m_Stream << "\r" << std::string(m_BarWidth, ' ') << "\r";
  m_BarWidth = 0;
  m_Stream << line << "\n" << std::flush;
}

void ProgressReport::finish()
{
  const std::lock_guard<std::mutex> lock(m_Mutex);
  if (!m_InStage) return;
  if (m_Terminal)
  {
    drawBar(m_LastFraction);
    m_Stream << "\n" << std::flush;
    m_BarWidth = 0;
    m_InStage = false;
    return;
  }
  m_Stream << "<filter-progress>" << formatNumber(m_LastFraction) << "</filter-progress>\n";
  endStage();
}

void ProgressReport::beginStage(const std::string& stage)
{
  if (m_InStage && !m_Terminal) endStage();
  m_Stage = stage;
  m_InStage = true;
  m_StageStart = Clock::now();
  if (m_Terminal) return;
  m_Stream << "<filter-start>\n<filter-name>" << escaped(m_Title) << "</filter-name>\n<filter-comment> \""
           << escaped(stage) << "\" </filter-comment>\n</filter-start>\n"
           << std::flush;
}

void ProgressReport::endStage()
{
  const double seconds = std::chrono::duration<double>(Clock::now() - m_StageStart).count();
  m_Stream << "<filter-end>\n<filter-name>" << escaped(m_Title) << "</filter-name>\n<filter-time>"
           << formatNumber(seconds) << "</filter-time>\n</filter-end>\n"
           << std::flush;
  m_InStage = false;
}

void ProgressReport::drawBar(double fraction)
{
  constexpr std::size_t cells = 30;
  const auto full = std::size_t(std::lround(fraction * cells));
  const std::string percent = std::to_string(std::lround(fraction * 100));
  std::string line = "[" + std::string(full, '#') + std::string(cells - full, '.') + "] " +
                     std::string(3 - percent.size(), ' ') + percent + " % " + m_Stage.substr(0, 40);
  const std::size_t width = line.size();
  // Blanks wipe what is left of a longer stage name.
  if (width < m_BarWidth) line += std::string(m_BarWidth - width, ' ');
  m_BarWidth = width;
  m_Stream << "\r" << line << std::flush;
}

} // namespace surgicalmesher
