// SPDX-License-Identifier: Apache-2.0
#include "Configuration.h"

#include "Arguments.h"
#include "Descriptions.h"
#include "Errors.h"
#include "PrintableText.h"
#include "Stages.h"
#include "TextFile.h"

#include <toml++/toml.h>

#include <algorithm>
#include <filesystem>

namespace surgicalmesher
{

namespace
{

/// Returns the text of a string, number or boolean; empty for any other node.
std::string scalarText(const toml::node& node)
{
  if (const auto* text = node.as_string()) return text->get();
  if (const auto* number = node.as_integer()) return std::to_string(number->get());
  if (const auto* number = node.as_floating_point()) return text::rounded(number->get(), 17);
  if (const auto* truth = node.as_boolean()) return truth->get() ? "true" : "false";
  return {};
}

std::vector<std::string> scalarTexts(const toml::array& array)
{
  std::vector<std::string> texts;
  for (const toml::node& item : array) texts.push_back(scalarText(item));
  return texts;
}

/// Returns one value, or the values of a list.
std::vector<std::string> valuesOf(const toml::node& node, const Parameter& parameter)
{
  const toml::array* array = node.as_array();
  if (!array) return { scalarText(node) };
  const bool isOneList = parameter.isPoint() || parameter.isVector();
  const bool holdsLists = !array->empty() && array->front().is_array();
  if (isOneList && !holdsLists && !array->empty() && !array->front().is_string())
    return { text::joined(scalarTexts(*array), ",") };
  std::vector<std::string> values;
  for (const toml::node& item : *array)
  {
    const toml::array* inner = item.as_array();
    values.push_back(inner ? text::joined(scalarTexts(*inner), ",") : scalarText(item));
  }
  return values;
}

/// Whether a value is a path that depends on a folder. An output file given by name only does not: it lies in the
/// folder of the results.
bool isPath(const Parameter& parameter, const std::string& value)
{
  return parameter.isFile() || (isOutputFile(parameter.name) && std::filesystem::path(value).has_parent_path());
}

const Parameter& parameterOf(const std::string& key, const ModuleDescription& description, const std::string& file)
{
  if (const Parameter* found = description.find(key); found && key != "config") return *found;
  std::vector<std::string> names;
  for (const Parameter* parameter : description.parameters()) names.push_back(parameter->name);
  const std::string nearest = nearestWord(key, names);
  throw InputError(file + ": " + key + ": unknown key found, one of the options of surgicalmesher mesh expected" +
                   (nearest.empty() ? "" : "; did you mean " + nearest + "?"));
}

void requireAccepted(const Parameter& parameter, const std::vector<std::string>& values, const std::string& file)
{
  if (values.size() > 1 && !parameter.multiple)
    throw InputError(file + ": " + parameter.name + ": a list found, one value expected");
  for (const std::string& value : values)
  {
    if (parameter.type == "boolean" && value != "true" && value != "false")
      throw InputError(file + ": " + parameter.name + ": '" + value + "' found, true or false expected");
    try
    {
      if (parameter.type != "boolean") checkValue(parameter, value);
    }
    catch (const UsageError& error)
    {
      throw InputError(file + ": " + error.what());
    }
  }
}

/// Returns an absolute path, except for files in the folder of the results, which may be moved and copied together with
/// the configuration.
std::string pathFrom(const std::string& resultFolder, const std::string& file)
{
  const std::filesystem::path path = absolutePath(file);
  return pathInResults(path, resultFolder).value_or(path).string();
}

std::string tomlValue(const Parameter& parameter, const std::string& value, const std::string& resultFolder)
{
  if (parameter.isInteger() || parameter.isNumber() || parameter.type == "boolean") return value;
  if (parameter.isPoint()) return "[" + text::joined(text::split(value, ','), ", ") + "]";
  const std::string text = isPath(parameter, value) ? pathFrom(resultFolder, value) : value;
  if (!isUTF8(text)) throw UsageError(parameter.spelling() + ": '" + text + "' found, UTF-8 expected, as in run.toml");
  return quoted(text);
}

std::string entryOf(const Parameter& parameter, const RunOptions& options)
{
  const auto given = options.find(parameter.name);
  std::vector<std::string> values;
  if (given != options.end()) values = given->second;
  else if (!parameter.defaultValue.empty()) values = { canonicalValue(parameter, parameter.defaultValue) };
  else if (parameter.type == "boolean") values = { "false" };
  const bool isSet = !values.empty();
  for (std::string& value : values) value = tomlValue(parameter, value, options.at("folder").front());
  const std::string list = "[" + text::joined(values, ", ") + "]";
  const std::string value = parameter.multiple ? list : isSet ? values.front() : "\"\"";
  return "# " + parameter.description + "\n" + (isSet ? "" : "#") + parameter.name + " = " + value + "\n";
}

} // namespace

RunOptions readConfiguration(const std::string& file, const ModuleDescription& description)
{
  const std::string content = text::readTextFile(file);
  const std::filesystem::path folder = std::filesystem::path(absolutePath(file)).parent_path();
  toml::table table;
  try
  {
    table = toml::parse(content);
  }
  catch (const toml::parse_error& error)
  {
    throw InputError(file + ", line " + std::to_string(error.source().begin.line) + ": " +
                     std::string(error.description()) + "; TOML expected");
  }
  RunOptions options;
  for (const auto& [key, node] : table)
  {
    const Parameter& parameter = parameterOf(std::string(key.str()), description, file);
    std::vector<std::string> values = valuesOf(node, parameter);
    requireAccepted(parameter, values, file);
    for (std::string& value : values)
      if (isPath(parameter, value)) value = (folder / value).lexically_normal().string();
    if (!values.empty()) options[parameter.name] = values;
  }
  return options;
}

std::string configurationText(const RunOptions& options, const ModuleDescription& description)
{
  std::string text = "# surgicalmesher " + description.version +
                     "\n# A run is repeated by\n"
                     "#     surgicalmesher mesh --config THIS_FILE [[MAP] FOLDER]\n"
                     "# Paths are taken from the folder of this file, which is the folder of the results as well.\n";
  for (const ParameterGroup& group : description.groups)
  {
    text += "\n# ---- " + group.label + "\n\n";
    for (const Parameter& parameter : group.parameters)
    {
      if (parameter.name != "config" && parameter.name != "target") text += entryOf(parameter, options);
    }
  }
  return text;
}

} // namespace surgicalmesher
