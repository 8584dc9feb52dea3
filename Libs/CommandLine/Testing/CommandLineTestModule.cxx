// SPDX-License-Identifier: Apache-2.0
// A module that ends in every way a module can end.
#include "CommandLine.h"
#include "CommandLineTestModuleXML.h"
#include "Errors.h"

#include <vtkObject.h>

#include <chrono>
#include <fstream>
#include <iostream>
#include <new>
#include <thread>

using namespace surgicalmesher;

namespace
{

std::string content(const CommandLine& line)
{
  std::string all;
  for (int i = 0; i < line.integer("count"); ++i) all += line.text("text") + "\n";
  for (const std::string& file : line.texts("list")) all += file + "\n";
  if (line.given("start")) all += "from " + line.text("start") + "\n";
  for (const Vec3& p : line.points("point")) all += std::to_string(p.x + p.y + p.z) + "\n";
  double sum = line.number("length") + line.number("ratio") + line.integer("power");
  for (const double weight : line.numbers("weights")) sum += weight;
  for (const double index : line.numbers("indices")) sum += index;
  return all + std::to_string(sum) + (line.flag("on") ? " on" : "") + (line.flag("off") ? " off" : "") + "\n";
}

void write(const std::string& text, const std::string& file)
{
  std::ofstream stream(file, std::ios::binary);
  stream << text << std::flush;
  if (!stream) throw InputError(file + ": can't be written");
}

void waitForever()
{
  for (;;) std::this_thread::sleep_for(std::chrono::hours(1));
}

void chatter()
{
  std::cerr << "a library says something\n";
  std::fprintf(stderr, "and something else\n");
  vtkGenericWarningMacro("and VTK, too");
}

/// Until the stack is used up.
int recurse(volatile int depth)
{
  volatile char frame[4096];
  frame[0] = char(depth);
  return depth == 0 ? 0 : recurse(depth + 1) + frame[0];
}

void announceSidecars(CommandLine& line)
{
  const std::string result = line.outputNames("result").front();
  line.alsoWrites("result", result + ".json");
  line.alsoWritesMany("result", result.substr(0, result.rfind('.')) + ".part_", ".vtp");
}

void act(CommandLine& line, const std::string& what)
{
  if (what == "inputError") throw InputError(line.text("input") + ": nothing found, something expected");
  if (what == "usageError") throw UsageError("--act: 'usageError' found, something else expected");
  if (what == "engineError") throw EngineError("stage two: gave up at (1, 2, 3) mm");
  if (what == "outOfMemory") throw std::bad_alloc();
  if (what == "longException") throw std::runtime_error("first line\n  second line\n");
  if (what == "number") throw 42;
  if (what == "chatter") chatter();
  if (what == "recurse") std::cout << recurse(1) << std::flush;
  if (what == "warn")
  {
    line.message("a \"message\"");
    line.warning("something \x1b odd");
  }
  if (what == "unknownName") line.text(line.text("folder") + "?");
  if (what == "wrongType") line.integer("text");
  if (what == "wait")
  {
    line.message("waiting");
    waitForever();
  }
}

void run(CommandLine& line)
{
  const std::string what = line.text("act");
  const Progress progress = line.progress();
  report(progress, 0, "Writing <all>");
  if (what == "sidecars") announceSidecars(line);
  const std::string text = content(line);
  if (what != "forget") write(text, line.outputFile("result"));
  if (line.given("extra")) write(text, line.outputFile("extra"));
  act(line, what);
  for (int i = 0; i <= 100000; ++i) report(progress, i / 1e5, "Ending");
  if (what != "noReturnValue") line.returnValue("written", std::to_string(text.size()));
}

} // namespace

int main(int argc, char** argv) { return runModule(argc, argv, moduleXML, run); }
