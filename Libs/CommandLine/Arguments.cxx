// SPDX-License-Identifier: Apache-2.0
#include "Arguments.h"

#include "Errors.h"
#include "Text.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

namespace surgicalmesher
{

namespace
{

bool looksLikeFlag(const std::string& argument)
{
  // Negative numbers begin with a dash, too.
  return argument.size() > 1 && argument[0] == '-' && !std::isdigit(static_cast<unsigned char>(argument[1])) &&
         argument[1] != '.';
}

const char* const progressFormats = "one of xml, bar, plain, json, none";

std::string withoutDashes(const std::string& flag)
{
  const std::size_t start = flag.find_first_not_of('-');
  return start == std::string::npos ? std::string() : flag.substr(start);
}

/// Number of letters to insert, delete or replace (Levenshtein, Soviet Physics Doklady 10(8), 1966). If one word of at
/// least three letters begins the other, the rest counts as one change.
std::size_t changesBetween(const std::string& a, const std::string& b)
{
  const std::size_t common = std::min(a.size(), b.size());
  if (common >= 3 && a.compare(0, common, b, 0, common) == 0) return a.size() == b.size() ? 0 : 1;
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i)
  {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j)
    {
      const std::size_t replaced = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({ row[j] + 1, row[j - 1] + 1, replaced });
    }
  }
  return row[b.size()];
}

/// Splits at commas. A value is in quotes if it begins with one: then it may contain commas, and "" for a quote.
/// Otherwise a quote is part of a file's name.
std::vector<std::string> splitFiles(const std::string& value)
{
  std::vector<std::string> parts = text::split(value, ',');
  if (parts.size() > 1)
    for (std::string& part : parts) part = text::trimmed(part);
  const bool isQuoted =
    std::any_of(parts.begin(), parts.end(), [](const std::string& part) { return text::trimmed(part)[0] == '"'; });
  return isQuoted || parts.empty() ? text::splitFields(value) : parts;
}

/// Returns the files that a value of a list of files stands for. It is one name with a comma in it if there is such a
/// file, and also if a part of it cannot be meant as an output, for lack of an extension.
std::vector<std::string> filesIn(const Parameter& parameter, const std::string& value)
{
  std::error_code error; // a list may be longer than a name
  if (std::filesystem::exists(value, error)) return { value };
  std::vector<std::string> parts = splitFiles(value);
  const bool needsExtension = parameter.output && !parameter.extensions.empty();
  const auto isHalfAName = [](const std::string& part) { return !part.empty() && text::extensionOf(part).empty(); };
  if (needsExtension && std::any_of(parts.begin(), parts.end(), isHalfAName)) return { value };
  return parts;
}

class Parser
{
public:
  Parser(const ModuleDescription& description, const std::vector<std::string>& arguments)
    : m_Description(description), m_Arguments(arguments)
  {
  }

  Arguments parse()
  {
    std::vector<std::string> positionals;
    while (m_Next < m_Arguments.size())
    {
      const std::string argument = m_Arguments[m_Next++];
      if (argument == "--")
      {
        positionals.insert(positionals.end(), m_Arguments.begin() + m_Next, m_Arguments.end());
        break;
      }
      if (looksLikeFlag(argument)) parseFlag(argument);
      else positionals.push_back(argument);
    }
    assignPositionals(positionals);
    return m_Result;
  }

private:
  void parseFlag(const std::string& argument)
  {
    const std::size_t equals = argument.find('=');
    const std::string flag = argument.substr(0, equals);
    const std::string* attached = nullptr;
    std::string value;
    if (equals != std::string::npos)
    {
      value = argument.substr(equals + 1);
      attached = &value;
    }

    if (flag == "--echo" && !attached) m_Result.echo = true;
    else if (flag == "--quiet" && !attached) m_Result.quiet = true;
    else if (flag == "--progress") setProgress(takeValue(flag, progressFormats, attached));
    else if (flag == "--returnparameterfile") setReturnParameterFile(takeValue(flag, "a file", attached));
    else if (flag == "--processinformationaddress") setHost(takeValue(flag, "an address", attached));
    else parseParameter(findByFlag(flag), flag, attached);
  }

  void setReturnParameterFile(const std::string& file)
  {
    if (file.empty()) throw UsageError("--returnparameterfile: no value found, a file expected");
    if (!m_Result.returnParameterFile.empty()) throw UsageError("--returnparameterfile: given twice, once expected");
    m_Result.returnParameterFile = file;
    m_Result.fromHost = true;
  }

  void setHost(const std::string&) { m_Result.fromHost = true; }

  void setProgress(const std::string& format)
  {
    const std::map<std::string, ProgressFormat> formats{ { "xml", ProgressFormat::Xml },
                                                         { "bar", ProgressFormat::Bar },
                                                         { "plain", ProgressFormat::Plain },
                                                         { "json", ProgressFormat::Json },
                                                         { "none", ProgressFormat::None } };
    const auto found = formats.find(format);
    if (found == formats.end())
      throw UsageError("--progress: '" + format + "' found, " + progressFormats + " expected");
    m_Result.progress = found->second;
  }

  /// Returns "; did you mean --targets?" for the nearest known flag; empty if none is near.
  std::string nearestFlag(const std::string& flag) const
  {
    std::vector<std::string> known{ "help", "version", "xml", "returnparameterfile", "echo", "quiet", "progress" };
    for (const Parameter* parameter : m_Description.parameters()) known.push_back(parameter->longFlag);
    const std::string nearest = nearestWord(withoutDashes(flag), known);
    return nearest.empty() ? "" : "; did you mean --" + nearest + "?";
  }

  const Parameter& findByFlag(const std::string& flag) const
  {
    for (const Parameter* parameter : m_Description.parameters())
    {
      const bool isLong = !parameter->longFlag.empty() && flag == "--" + parameter->longFlag;
      const bool isShort = !parameter->flag.empty() && flag == "-" + parameter->flag;
      if (isLong || isShort) return *parameter;
    }
    throw UsageError(flag + ": unknown flag found, one of those that --help lists expected" + nearestFlag(flag));
  }

  std::string takeValue(const std::string& flag, const std::string& expected, const std::string* attached)
  {
    if (attached) return *attached;
    if (m_Next >= m_Arguments.size() || looksLikeFlag(m_Arguments[m_Next]))
    {
      throw UsageError(flag + ": no value found, " + expected + " expected");
    }
    return m_Arguments[m_Next++];
  }

  void parseParameter(const Parameter& parameter, const std::string& flag, const std::string* attached)
  {
    if (parameter.type == "boolean")
    {
      if (attached) throw UsageError(flag + ": value '" + *attached + "' found, none expected");
      store(parameter, parameter.defaultValue == "true" ? "false" : "true");
    }
    else
    {
      store(parameter, takeValue(flag, expectation(parameter), attached));
    }
  }

  void assignPositionals(const std::vector<std::string>& given)
  {
    const std::vector<const Parameter*> wanted = m_Description.positionals();
    if (given.size() < wanted.size())
    {
      const Parameter& missing = *wanted[given.size()];
      throw UsageError(missing.name + ": argument not found, " + expectation(missing) + " expected");
    }
    for (std::size_t i = 0; i < given.size(); ++i)
    {
      const bool surplus = i >= wanted.size() && (wanted.empty() || !wanted.back()->multiple);
      if (surplus)
      {
        throw UsageError("'" + given[i] + "': surplus argument found, " + std::to_string(wanted.size()) +
                         " without a flag expected");
      }
      store(*wanted[std::min(i, wanted.size() - 1)], given[i]);
    }
  }

  void store(const Parameter& parameter, const std::string& value)
  {
    std::vector<std::string>& values = m_Result.values[parameter.name];
    if (!values.empty() && !parameter.multiple) throw UsageError(parameter.spelling() + ": given twice, once expected");
    const bool isList = parameter.multiple && parameter.isFile();
    for (const std::string& part : isList ? filesIn(parameter, value) : std::vector<std::string>{ value })
    {
      checkValue(parameter, part);
      values.push_back(part);
    }
  }

  const ModuleDescription& m_Description;
  const std::vector<std::string>& m_Arguments;
  std::size_t m_Next = 0;
  Arguments m_Result;
};

} // namespace

std::string nearestWord(const std::string& wanted, const std::vector<std::string>& known)
{
  std::string nearest;
  std::size_t fewest = std::min<std::size_t>(wanted.size() / 3 + 1, 5);
  for (const std::string& word : known)
  {
    if (word.empty()) continue;
    const std::size_t changes = changesBetween(text::lowerCase(wanted), text::lowerCase(word));
    if (changes > fewest || (changes == fewest && !nearest.empty())) continue;
    nearest = word;
    fewest = changes;
  }
  return nearest;
}

Arguments parseArguments(const ModuleDescription& description, const std::vector<std::string>& arguments)
{
  return Parser(description, arguments).parse();
}

} // namespace surgicalmesher
