// SPDX-License-Identifier: Apache-2.0
#include "ProgressReport.h"

#include "PrintableText.h"
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

/// Replaces line ends and tabs by blanks; keeps runs of blanks, which align the columns of tables.
std::string unbroken(std::string text)
{
  std::replace_if(
    text.begin(), text.end(), [](char letter) { return letter == '\n' || letter == '\r' || letter == '\t'; }, ' ');
  return text;
}

/// Returns a path as a JSON string; see ProgressReport::output().
std::string quotedPath(const std::string& path)
{
  const char* const digits = "0123456789abcdef";
  std::string result = "\"";
  for (std::size_t at = 0; at < path.size();)
  {
    const std::size_t length = utf8Length(path, at);
    const auto byte = static_cast<unsigned char>(path[at]);
    if (length == 0) result += { '\\', 'u', 'd', 'c', digits[byte >> 4], digits[byte & 15] };
    const std::string character = quoted(path.substr(at, length));
    result.append(character, 1, character.size() - 2);
    at += std::max<std::size_t>(length, 1);
  }
  return result + "\"";
}

std::string percent(double fraction)
{
  const std::string number = std::to_string(std::lround(fraction * 100));
  return std::string(3 - number.size(), ' ') + number + " %";
}

} // namespace

std::string timeLeft(double fraction, double seconds)
{
  if (fraction < 0.03 || fraction >= 1 || seconds < 2) return {};
  const double left = seconds * (1 - fraction) / fraction;
  if (left > 1e6) return {};
  const long minutes = std::lround(left / 60);
  if (left < 55) return std::to_string(left < 10 ? std::lround(left) : 5 * std::lround(left / 5)) + " s";
  if (minutes < 60) return std::to_string(std::max(minutes, 1L)) + " min";
  const long rest = minutes % 60;
  return std::to_string(minutes / 60) + " h" + (rest ? " " + std::to_string(rest) + " min" : "");
}

ProgressReport::ProgressReport(std::ostream& stream, ProgressFormat format, const std::string& title, bool quiet,
                               std::function<void(const std::string&)> warn)
  : m_Stream(stream), m_Format(quiet ? ProgressFormat::None : format), m_Title(title), m_Quiet(quiet),
    m_Warn(std::move(warn)), m_Start(Clock::now())
{
}

void ProgressReport::update(double fraction, const std::string& stage)
{
  const std::lock_guard<std::mutex> lock(m_Mutex);
  m_LastFraction = std::clamp(fraction, 0.0, 1.0);
  if (m_Format == ProgressFormat::None) return;
  const bool newStage = !m_InStage || stage != m_Stage;
  const Clock::time_point now = Clock::now();
  const auto pause = std::chrono::milliseconds(m_Format == ProgressFormat::Plain ? 5000 : 100);
  if (!newStage && now - m_LastUpdate < pause) return;
  m_LastUpdate = now;
  if (newStage) beginStage(stage);
  write(m_LastFraction);
}

void ProgressReport::write(double fraction)
{
  m_WrittenFraction = fraction;
  const std::string rest = left(fraction);
  switch (m_Format)
  {
  case ProgressFormat::Bar: drawBar(fraction); break;
  case ProgressFormat::Xml:
    m_Stream << "<filter-progress>" << text::rounded(fraction, 10) << "</filter-progress>\n" << std::flush;
    break;
  case ProgressFormat::Plain:
    m_Stream << percent(fraction) << "  " << m_Stage << (rest.empty() ? "" : ", about " + rest + " left") << "\n"
             << std::flush;
    break;
  case ProgressFormat::Json:
    m_Stream << "{\"progress\": " << text::rounded(fraction, 10) << ", \"stage\": " << quoted(m_Stage)
             << (rest.empty() ? "" : ", \"left\": " + quoted(rest)) << "}\n"
             << std::flush;
    break;
  default: break;
  }
}

void ProgressReport::message(const std::string& line)
{
  const std::lock_guard<std::mutex> lock(m_Mutex);
  if (m_Quiet) return;
  wipeBar();
  const std::string text = unbroken(printable(line));
  m_Stream << (m_Format == ProgressFormat::Json ? "{\"message\": " + quoted(text) + "}" : text) << "\n" << std::flush;
}

void ProgressReport::warning(const std::string& line)
{
  const std::lock_guard<std::mutex> lock(m_Mutex);
  const std::string text = text::oneLine(printable(line));
  wipeBar();
  m_Stream << std::flush;
  if (m_Format == ProgressFormat::Json) m_Stream << "{\"warning\": " << quoted(text) << "}\n" << std::flush;
  if (m_Format == ProgressFormat::Xml) m_Stream << "warning: " << text << "\n" << std::flush;
  else if (m_Warn) m_Warn(text);
}

void ProgressReport::output(const std::string& path)
{
  const std::lock_guard<std::mutex> lock(m_Mutex);
  if (m_Format == ProgressFormat::Json) m_Stream << "{\"output\": " << quotedPath(path) << "}\n" << std::flush;
}

void ProgressReport::finish()
{
  const std::lock_guard<std::mutex> lock(m_Mutex);
  if (!m_InStage) return;
  if (m_Format == ProgressFormat::Bar)
  {
    drawBar(m_LastFraction);
    m_Stream << "\n" << std::flush;
    m_BarWidth = 0;
  }
  else if (m_Format == ProgressFormat::Xml || m_LastFraction != m_WrittenFraction) write(m_LastFraction);
  endStage();
}

void ProgressReport::beginStage(const std::string& stage)
{
  if (m_InStage) endStage();
  m_Stage = text::oneLine(printable(stage));
  m_InStage = true;
  m_StageStart = Clock::now();
  if (m_Format != ProgressFormat::Xml) return;
  m_Stream << "<filter-start>\n<filter-name>" << escaped(m_Title) << "</filter-name>\n<filter-comment> \""
           << escaped(m_Stage) << "\" </filter-comment>\n</filter-start>\n"
           << std::flush;
}

void ProgressReport::endStage()
{
  m_InStage = false;
  if (m_Format != ProgressFormat::Xml) return;
  const double seconds = std::chrono::duration<double>(Clock::now() - m_StageStart).count();
  m_Stream << "<filter-end>\n<filter-name>" << escaped(m_Title) << "</filter-name>\n<filter-time>"
           << text::rounded(seconds, 10) << "</filter-time>\n</filter-end>\n"
           << std::flush;
}

std::string ProgressReport::left(double fraction) const
{
  return timeLeft(fraction, std::chrono::duration<double>(Clock::now() - m_Start).count());
}

void ProgressReport::wipeBar()
{
  if (m_BarWidth) m_Stream << "\r" << std::string(m_BarWidth, ' ') << "\r";
  m_BarWidth = 0;
}

void ProgressReport::drawBar(double fraction)
{
  constexpr std::size_t cells = 30;
  const auto full = std::size_t(std::lround(fraction * cells));
  const std::string rest = left(fraction);
  std::string line = "[" + std::string(full, '#') + std::string(cells - full, '.') + "] " + percent(fraction) + " " +
                     m_Stage.substr(0, 40) + (rest.empty() ? "" : ", about " + rest + " left");
  const std::size_t width = line.size();
  // Blanks erase the rest of a longer line.
  if (width < m_BarWidth) line += std::string(m_BarWidth - width, ' ');
  m_BarWidth = width;
  m_Stream << "\r" << line << std::flush;
}

} // namespace surgicalmesher
