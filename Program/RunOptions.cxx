// SPDX-License-Identifier: Apache-2.0
#include "RunOptions.h"

#include "Errors.h"
#include "Text.h"

#include <algorithm>
#include <filesystem>
#include <system_error>

namespace surgicalmesher
{

namespace
{

std::string shortestNumber(const std::string& text)
{
  double value = 0, again = 0;
  if (!text::parseNumber(text::trimmed(text), value)) return text;
  for (int digits = 6; digits < 17; ++digits)
  {
    std::string shorter = text::rounded(value, digits);
    if (text::parseNumber(shorter, again) && again == value) return shorter;
  }
  return text::rounded(value, 17);
}

} // namespace

std::string absolutePath(const std::string& path)
{
  if (path.empty()) throw InputError("'' found, name of a file or folder expected");
  std::error_code error;
  const std::filesystem::path absolute = std::filesystem::absolute(path, error);
  if (error == std::errc::no_such_file_or_directory)
    throw InputError(path + ": relative to a working directory that is not there any more, another expected");
  if (error)
    throw InputError(path + ": relative to a working directory that cannot be told (" + error.message() +
                     "), an absolute path expected");
  return absolute.lexically_normal().string();
}

std::string canonicalValue(const Parameter& parameter, const std::string& value)
{
  if (parameter.isInteger() || parameter.isNumber()) return shortestNumber(value);
  if (!parameter.isPoint() && (!parameter.isVector() || parameter.type == "string-vector")) return value;
  std::vector<std::string> numbers = text::split(value, ',');
  for (std::string& number : numbers) number = shortestNumber(number);
  return text::joined(numbers, ",");
}

bool isDefault(const Parameter& parameter, const std::vector<std::string>& values)
{
  const auto isTheDefault = [&](const std::string& value)
  { return canonicalValue(parameter, value) == canonicalValue(parameter, parameter.defaultValue); };
  return std::all_of(values.begin(), values.end(), isTheDefault);
}

RunOptions presetOptions(const std::string& preset)
{
  if (preset == "draft")
    return { { "minimumEdgeLength", { "2" } }, { "maximumEdgeLength", { "12" } }, { "minimumIslandVolume", { "30" } } };
  if (preset == "fine")
    return { { "minimumEdgeLength", { "0.5" } }, { "maximumEdgeLength", { "4" } }, { "spacing", { "1" } } };
  if (preset == "simulation") return { { "minimumIslandVolume", { "30" } }, { "minimumCavityVolume", { "30" } } };
  return {};
}

RunOptions completedOptions(const RunOptions& given, const ModuleDescription& description)
{
  RunOptions options;
  for (const auto& [name, values] : given)
  {
    const Parameter& parameter = *description.find(name);
    std::vector<std::string>& all = options[name == "target" ? "targetPoint" : name];
    for (const std::string& value : values) all.push_back(canonicalValue(parameter, value));
  }
  const auto preset = options.find("preset");
  if (preset == options.end()) return options;
  options.merge(presetOptions(preset->second.front()));
  return options;
}

} // namespace surgicalmesher
