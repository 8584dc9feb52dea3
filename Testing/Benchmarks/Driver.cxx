// SPDX-License-Identifier: Apache-2.0
#include "Driver.h"

#include "Errors.h"

#include <rapidjson/stringbuffer.h>
#include <rapidjson/writer.h>

#include <sys/resource.h>

#include <iostream>

namespace surgicalmesher
{
namespace
{

std::uint64_t peakMemory()
{
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return std::uint64_t(usage.ru_maxrss) * 1024;
}

} // namespace

std::string runJSON(const std::string& program, const Stopwatch& stopwatch, std::size_t points, std::size_t tetrahedra)
{
  rapidjson::StringBuffer buffer;
  rapidjson::Writer<rapidjson::StringBuffer> json(buffer);
  json.SetMaxDecimalPlaces(3);
  json.StartObject();
  json.Key("program");
  json.String(program.c_str());
  json.Key("seconds");
  json.StartObject();
  for (const auto& [phase, seconds] : stopwatch.phases())
  {
    json.Key(phase.c_str());
    json.Double(seconds);
  }
  json.EndObject();
  json.Key("points");
  json.Uint64(points);
  json.Key("tetrahedra");
  json.Uint64(tetrahedra);
  json.Key("peakMemory");
  json.Uint64(peakMemory());
  json.EndObject();
  return buffer.GetString();
}

int runDriver(const std::function<void()>& work)
{
  try
  {
    work();
    return 0;
  }
  catch (const Error& error)
  {
    std::cerr << error.what() << '\n';
    return error.exitStatus();
  }
  catch (const std::exception& error)
  {
    std::cerr << error.what() << '\n';
    return 3;
  }
}

} // namespace surgicalmesher
