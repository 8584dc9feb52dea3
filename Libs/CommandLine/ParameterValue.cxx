// SPDX-License-Identifier: Apache-2.0
// What a parameter accepts: in words, and as a check.
#include "Errors.h"
#include "ModuleDescription.h"
#include "Text.h"

#include <algorithm>
#include <filesystem>

namespace surgicalmesher
{

namespace
{

std::string range(const Parameter& parameter)
{
  if (parameter.minimum && parameter.maximum)
  {
    return " from " + formatNumber(*parameter.minimum) + " to " + formatNumber(*parameter.maximum);
  }
  if (parameter.minimum) return " of at least " + formatNumber(*parameter.minimum);
  return parameter.maximum ? " of at most " + formatNumber(*parameter.maximum) : std::string();
}

bool inRange(const Parameter& parameter, double value)
{
  return (!parameter.minimum || value >= *parameter.minimum) && (!parameter.maximum || value <= *parameter.maximum);
}

bool isInteger(const Parameter& parameter, const std::string& text)
{
  const std::optional<int> value = parseInteger(text);
  return value && inRange(parameter, *value);
}

bool isNumber(const Parameter& parameter, const std::string& text)
{
  const std::optional<double> value = parseNumber(text);
  return value && inRange(parameter, *value);
}

bool isNumberList(const Parameter& parameter, const std::string& text,
                  bool (*isItem)(const Parameter&, const std::string&))
{
  const std::vector<std::string> items = split(text, ',');
  return !items.empty() &&
         std::all_of(items.begin(), items.end(), [&](const std::string& item) { return isItem(parameter, item); });
}

bool isPoint(const Parameter& parameter, const std::string& text)
{
  const std::size_t coordinates = parameter.type == "region" ? 6 : 3;
  return split(text, ',').size() == coordinates && isNumberList(parameter, text, isNumber);
}

bool hasExtension(const Parameter& parameter, const std::string& file)
{
  const std::string name = lowerCase(std::filesystem::path(file).filename().string());
  return std::any_of(parameter.extensions.begin(), parameter.extensions.end(),
                     [&](const std::string& extension) {
                       return name.size() > extension.size() &&
                              name.compare(name.size() - extension.size(), name.npos, extension) == 0;
                     });
}

bool accepts(const Parameter& parameter, const std::string& value)
{
  if (parameter.isEnumeration())
  {
    return std::find(parameter.choices.begin(), parameter.choices.end(), value) != parameter.choices.end();
  }
  if (parameter.isInteger()) return isInteger(parameter, value);
  if (parameter.isNumber()) return isNumber(parameter, value);
  if (parameter.type == "integer-vector") return isNumberList(parameter, value, isInteger);
  if (parameter.type == "double-vector" || parameter.type == "float-vector")
  {
    return isNumberList(parameter, value, isNumber);
  }
  if (parameter.isPoint()) return isPoint(parameter, value);
  if (!parameter.isFile()) return true;
  return !value.empty() && (!parameter.output || parameter.extensions.empty() || hasExtension(parameter, value));
}

} // namespace

std::string expectation(const Parameter& parameter)
{
  if (parameter.isEnumeration()) return "one of " + joined(parameter.choices, ", ");
  if (parameter.isInteger()) return "an integer" + range(parameter);
  if (parameter.isNumber()) return "a number" + range(parameter);
  if (parameter.type == "integer-vector") return "integers" + range(parameter) + ", separated by commas";
  if (parameter.type == "string-vector") return "texts, separated by commas";
  if (parameter.isVector()) return "numbers" + range(parameter) + ", separated by commas";
  if (parameter.type == "point") return "x,y,z";
  if (parameter.type == "region") return "x,y,z and three radii, separated by commas";
  if (parameter.type == "directory") return "a folder";
  if (!parameter.isFile()) return "a text";
  return parameter.extensions.empty() ? "a file" : "a file (" + joined(parameter.extensions, ", ") + ")";
}

void checkValue(const Parameter& parameter, const std::string& value)
{
  if (accepts(parameter, value)) return;
  throw UsageError(parameter.spelling() + ": '" + value + "' found, " + expectation(parameter) + " expected");
}

} // namespace surgicalmesher
