// SPDX-License-Identifier: Apache-2.0
// Progress as the host reads it, and as a bar.
#include "ProgressReport.h"

#include <gtest/gtest.h>

#include <chrono>
#include <regex>
#include <sstream>

using namespace surgicalmesher;

namespace
{

int count(const std::string& text, const std::string& pattern)
{
  const std::regex regex(pattern);
  return int(std::distance(std::sregex_iterator(text.begin(), text.end(), regex), std::sregex_iterator()));
}

} // namespace

TEST(ProgressReport, namesEveryStageOnceInTags)
{
  std::ostringstream stream;
  ProgressReport progress(stream, ProgressFormat::Xml, "Module");
  progress.update(0, "One <1>");
  progress.update(0.5, "Two");
  progress.update(1, "Two");
  progress.finish();
  const std::string text = stream.str();
  EXPECT_EQ(count(text,
                  "<filter-start>\n<filter-name>Module</filter-name>\n<filter-comment> \"[^<]*\" </filter-comment>\n"
                  "</filter-start>\n"),
            2);
  EXPECT_EQ(count(text, "<filter-end>\n<filter-name>Module</filter-name>\n<filter-time>[0-9.e-]+</filter-time>\n"
                        "</filter-end>\n"),
            2);
  EXPECT_EQ(count(text, "\"One &lt;1>\""), 1);
  EXPECT_EQ(count(text, "<filter-progress>0.5</filter-progress>\n"), 1);
  EXPECT_EQ(count(text, "<filter-progress>1</filter-progress>\n<filter-end>"), 1);
  progress.finish();
  EXPECT_EQ(stream.str(), text);
}

TEST(ProgressReport, writesAtMostTenTimesASecond)
{
  std::ostringstream stream;
  ProgressReport progress(stream, ProgressFormat::Xml, "Module");
  const auto start = std::chrono::steady_clock::now();
  constexpr int updates = 200000;
  for (int i = 0; i < updates; ++i) progress.update(double(i) / updates, "Stage");
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  EXPECT_LE(count(stream.str(), "<filter-progress>"), 1 + 10 * seconds);
}

TEST(ProgressReport, staysWithinZeroAndOne)
{
  std::ostringstream stream;
  ProgressReport progress(stream, ProgressFormat::Xml, "Module");
  progress.update(-1, "a");
  progress.update(2, "b");
  progress.finish();
  EXPECT_EQ(count(stream.str(), "<filter-progress>(0|1)</filter-progress>"), 3);
}

TEST(ProgressReport, drawsOneLineThatEndsWithANewlineOnATerminal)
{
  std::ostringstream stream;
  ProgressReport progress(stream, ProgressFormat::Bar, "Module");
  progress.update(0, "A stage with a long name");
  progress.update(1, "Short");
  progress.finish();
  const std::string text = stream.str();
  EXPECT_EQ(count(text, "\n"), 1);
  EXPECT_EQ(text.back(), '\n');
  const std::string last = text.substr(text.rfind('\r') + 1);
  EXPECT_EQ(last.substr(0, 44), "[##############################] 100 % Short");
  EXPECT_EQ(count(text, "<"), 0);
}

TEST(ProgressReport, messagesStandOnLinesOfTheirOwn)
{
  std::ostringstream stream;
  ProgressReport progress(stream, ProgressFormat::Bar, "Module");
  progress.update(0.1, "Stage");
  progress.message("12 triangles");
  progress.update(0.2, "Other");
  progress.finish();
  EXPECT_EQ(count(stream.str(), "\r12 triangles\n\r\\["), 1);
}

TEST(ProgressReport, tellsTheTimeLeftOnceItIsKnown)
{
  EXPECT_EQ(timeLeft(0.5, 1), "");
  EXPECT_EQ(timeLeft(0.01, 10), "");
  EXPECT_EQ(timeLeft(1, 10), "");
  EXPECT_EQ(timeLeft(0.5, 4), "4 s");
  EXPECT_EQ(timeLeft(0.5, 41), "40 s");
  EXPECT_EQ(timeLeft(0.25, 60), "3 min");
  EXPECT_EQ(timeLeft(0.1, 800), "2 h");
  EXPECT_EQ(timeLeft(0.1, 850), "2 h 8 min");
}

TEST(ProgressReport, pathsOfAnyBytesAreJson)
{
  std::ostringstream stream;
  ProgressReport progress(stream, ProgressFormat::Json, "Module");
  progress.output("/a \"b\"/m\xfcller\xc3\xbc\n.vtp\xe2\x80");
  EXPECT_EQ(stream.str(), "{\"output\": \"/a \\\"b\\\"/m\\udcfcller\xc3\xbc\\u000a.vtp\\udce2\\udc80\"}\n");
}

TEST(ProgressReport, plainLinesComeOncePerStageAndSeldomWithin)
{
  std::ostringstream stream;
  ProgressReport progress(stream, ProgressFormat::Plain, "Module");
  for (int i = 0; i < 100; ++i) progress.update(i / 200.0, "One");
  progress.update(0.5, "Two");
  progress.message("12 triangles");
  progress.finish();
  EXPECT_EQ(count(stream.str(), "[^\n]*\n"), 3);
  EXPECT_EQ(count(stream.str(), "  0 %  One\n"), 1);
  EXPECT_EQ(count(stream.str(), " 50 %  Two\n12 triangles\n"), 1);
}
