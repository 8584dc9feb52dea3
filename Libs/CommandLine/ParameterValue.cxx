// SPDX-License-Identifier: Apache-2.0
// The values that a parameter accepts: in words, and as a check.
#include "Errors.h"
#include "ModuleDescription.h"
#include "Text.h"

#include <algorithm>
#include <filesystem>
#include <limits>

namespace surgicalmesher
{

namespace
{

std::string range(const Parameter& parameter)
{
  if (parameter.minimum && parameter.maximum)
  {
    return " from " + text::rounded(*parameter.minimum, 10) + " to " + text::rounded(*parameter.maximum, 10);
  }
  if (parameter.minimum) return " of at least " + text::rounded(*parameter.minimum, 10);
  return parameter.maximum ? " of at most " + text::rounded(*parameter.maximum, 10) : std::string();
}

bool inRange(const Parameter& parameter, double value)
{
  return (!parameter.minimum || value >= *parameter.minimum) && (!parameter.maximum || value <= *parameter.maximum);
}

/// Accepts digits only: unlike tables, command lines do not write 3.0 for 3.
bool isInteger(const Parameter& parameter, const std::string& text)
{
  using Limits = std::numeric_limits<int>;
  long value = 0;
  return text.find_first_of(".eE") == std::string::npos &&
         text::parseInteger(text, Limits::min(), Limits::max(), value) && inRange(parameter, double(value));
}

bool isNumber(const Parameter& parameter, const std::string& text)
{
  double value = 0;
  return text::parseNumber(text, value) && inRange(parameter, value);
}

bool isNumberList(const Parameter& parameter, const std::string& text,
                  bool (*isItem)(const Parameter&, const std::string&))
{
  const std::vector<std::string> items = text::split(text, ',');
  return !items.empty() &&
         std::all_of(items.begin(), items.end(), [&](const std::string& item) { return isItem(parameter, item); });
}

bool isPoint(const Parameter& parameter, const std::string& text)
{
  const std::size_t coordinates = parameter.type == "region" ? 6 : 3;
  return text::split(text, ',').size() == coordinates && isNumberList(parameter, text, isNumber);
}

bool hasExtension(const Parameter& parameter, const std::string& file)
{
  const std::string name = text::lowerCase(std::filesystem::path(file).filename().string());
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
  if (parameter.isEnumeration()) return "one of " + text::joined(parameter.choices, ", ");
  if (parameter.isInteger()) return "an integer" + range(parameter);
  if (parameter.isNumber()) return "a number" + range(parameter);
  if (parameter.type == "integer-vector") return "integers" + range(parameter) + ", separated by commas";
  if (parameter.type == "string-vector") return "texts, separated by commas";
  if (parameter.isVector()) return "numbers" + range(parameter) + ", separated by commas";
  if (parameter.type == "point") return "x,y,z";
  if (parameter.type == "region") return "x,y,z and three radii, separated by commas";
  if (parameter.type == "directory") return "a folder";
  if (!parameter.isFile()) return "a text";
  return parameter.extensions.empty() ? "a file" : "a file (" + text::joined(parameter.extensions, ", ") + ")";
}

void checkValue(const Parameter& parameter, const std::string& value)
{
  if (accepts(parameter, value)) return;
  throw UsageError(parameter.spelling() + ": '" + value + "' found, " + expectation(parameter) + " expected");
}

} // namespace surgicalmesher
