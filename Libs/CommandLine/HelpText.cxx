// SPDX-License-Identifier: Apache-2.0
// The answer to --help, made from the description alone.
#include "ModuleDescription.h"

#include <sstream>

namespace surgicalmesher
{

namespace
{

constexpr std::size_t lineWidth = 100;

std::string wrapped(const std::string& text, std::size_t indent)
{
  const std::string margin(indent, ' ');
  std::istringstream words(text);
  std::string result, line = margin;
  for (std::string word; words >> word;)
  {
    if (line.size() > indent && line.size() + 1 + word.size() > lineWidth)
    {
      result += line + "\n";
      line = margin;
    }
    line += (line.size() > indent ? " " : "") + word;
  }
  return result + line + "\n";
}

std::string placeholder(const Parameter& parameter)
{
  if (parameter.type == "boolean") return "";
  if (parameter.type == "directory") return " FOLDER";
  if (parameter.isFile()) return " FILE";
  if (parameter.type == "point") return " X,Y,Z";
  if (parameter.isEnumeration()) return " CHOICE";
  if (parameter.isInteger()) return " INTEGER";
  if (parameter.isNumber()) return " NUMBER";
  return parameter.isVector() || parameter.isPoint() ? " LIST" : " TEXT";
}

std::string entry(const Parameter& parameter)
{
  std::string head = "  " + parameter.spelling();
  if (!parameter.longFlag.empty() && !parameter.flag.empty()) head += ", -" + parameter.flag;
  if (parameter.index < 0) head += placeholder(parameter);
  if (parameter.multiple) head += " ...";

  std::string details = parameter.type == "boolean" ? "" : expectation(parameter);
  if (!parameter.defaultValue.empty()) details += (details.empty() ? "" : "; ") + ("default " + parameter.defaultValue);
  return head + "\n" + wrapped(parameter.description + (details.empty() ? "" : " [" + details + "]"), 6);
}

std::string synopsis(const ModuleDescription& description, const std::string& executable)
{
  std::string line = "Usage: " + executable + " [options]";
  for (const Parameter* parameter : description.positionals())
  {
    line += " " + parameter->name + (parameter->multiple ? " ..." : "");
  }
  return line + "\n";
}

const char* const commonOptions = R"(
Every module
  --help, -h
      Print this text.
  --version
      Print the version.
  --xml
      Print the description that this text is made from.
  --returnparameterfile FILE
      Write the returned values as lines of name = value.
  --echo
      Print the values of all parameters first.
  --progress CHOICE
      How progress is written on stdout: xml (as Slicer reads it), bar, plain (lines with the time left), json (an
      object per line), none. Default: a bar on a terminal, xml for a host of modules, else plain.
  --quiet
      Write nothing on stdout. Warnings and errors go to stderr all the same.
  --processinformationaddress ADDRESS
      Accepted and not used.

Exit status: 0 done, 1 the input is at fault, 2 the command line is at fault, 3 the engine failed, memory
ran out, or what was printed on stdout could not be written.
)";

} // namespace

std::string helpText(const ModuleDescription& description, const std::string& executable)
{
  std::string text = description.title + " " + description.version + "\n" + wrapped(description.description, 0) + "\n" +
                     synopsis(description, executable);
  for (const ParameterGroup& group : description.groups)
  {
    text += "\n" + group.label + "\n";
    for (const Parameter& parameter : group.parameters)
    {
      if (!parameter.isReturnValue()) text += entry(parameter);
    }
  }
  std::string returned;
  for (const Parameter* parameter : description.parameters())
  {
    if (parameter->isReturnValue()) returned += "  " + parameter->name + "\n" + wrapped(parameter->description, 6);
  }
  if (!returned.empty()) text += "\nReturned values\n" + returned;
  return text + commonOptions;
}

} // namespace surgicalmesher
