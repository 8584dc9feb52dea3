// SPDX-License-Identifier: Apache-2.0
#include "CommandLine.h"

#include "Arguments.h"
#include "Errors.h"
#include "ModuleDescription.h"
#include "OutputFiles.h"
#include "Platform.h"
#include "PrintableText.h"
#include "ProgressReport.h"
#include "Text.h"

#include <vtkLogger.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkOutputWindow.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <new>
#include <set>
#include <stdexcept>

namespace surgicalmesher
{

namespace
{

/// Replaces VTK's output window, which on Windows would open and wait for the user.
class SilentOutputWindow : public vtkOutputWindow
{
public:
  static SilentOutputWindow* New();
  vtkTypeMacro(SilentOutputWindow, vtkOutputWindow);
  void DisplayText(const char*) override {}
};
vtkStandardNewMacro(SilentOutputWindow);

void silenceVTK()
{
  vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
  vtkNew<SilentOutputWindow> window;
  vtkOutputWindow::SetInstance(window);
}

/// The number in a text that has been checked already.
double numberIn(const std::string& text)
{
  double number = 0;
  text::parseNumber(text, number);
  return number;
}

[[noreturn]] void misuse(const std::string& what) { throw std::logic_error("command line: " + what); }

} // namespace

struct CommandLine::Private
{
  ModuleDescription description;
  Arguments arguments;
  OutputFiles outputs;
  std::map<std::string, std::string> returnValues;
  std::unique_ptr<ProgressReport> progress;

  const Parameter& parameter(const std::string& name) const
  {
    const Parameter* found = description.find(name);
    if (!found) misuse("no parameter '" + name + "' in the XML");
    return *found;
  }

  const Parameter& parameter(const std::string& name, bool (*isType)(const Parameter&), const char* type) const
  {
    const Parameter& found = parameter(name);
    if (!isType(found)) misuse("parameter '" + name + "' is a " + found.type + ", not a " + type);
    return found;
  }

  std::vector<std::string> values(const Parameter& parameter) const
  {
    const auto found = arguments.values.find(parameter.name);
    if (found != arguments.values.end()) return found->second;
    if (parameter.defaultValue.empty()) return {};
    return { parameter.defaultValue };
  }

  std::string value(const Parameter& parameter) const
  {
    const std::vector<std::string> all = values(parameter);
    return all.empty() ? std::string() : all.front();
  }

  void requireNoInput(const std::string& who, const std::string& file) const;
  void claim(const std::string& who, const std::string& file);
  void claimMany(const std::string& who, const std::string& before, const std::string& after);
  void prepareOutputs();
  void echo() const;
  void writeReturnParameterFile();
  void tellOutputs() const;

  std::map<std::string, std::string> claims; ///< the parameter that writes a file, by the file's place
  struct ManyFiles
  {
    std::string who;
    std::filesystem::path folder;
    std::string before, after; ///< parts of the file name
    bool include(const std::string& place) const;
  };
  std::vector<ManyFiles> manyFiles;
  std::vector<std::string> warnings;
  std::set<std::string> toldWritten;
};

namespace
{

bool areTheSame(const std::string& a, const std::string& b)
{
  std::error_code error;
  return std::filesystem::equivalent(a, b, error) || placeOf(a) == placeOf(b);
}

/// The input files on the command line. Input folders are left out, since outputs may go into them.
std::vector<std::string> inputFiles(const ModuleDescription& description, const Arguments& arguments)
{
  std::vector<std::string> files;
  for (const auto& [name, values] : arguments.values)
  {
    const Parameter& parameter = *description.find(name);
    if (!parameter.isFile() || parameter.output || parameter.type == "directory") continue;
    files.insert(files.end(), values.begin(), values.end());
  }
  return files;
}

[[noreturn]] void refuseOutput(const std::string& who, const std::string& file, const std::string& what)
{
  throw UsageError(who + ": '" + file + "' is " + what + ", too; another file expected");
}

} // namespace

bool CommandLine::Private::ManyFiles::include(const std::string& place) const
{
  const std::filesystem::path path(place);
  const std::string name = path.filename().string();
  if (path.parent_path() != folder || name.size() <= before.size() + after.size()) return false;
  if (name.compare(0, before.size(), before) != 0) return false;
  if (name.compare(name.size() - after.size(), after.size(), after) != 0) return false;
  return std::all_of(name.begin() + before.size(), name.end() - after.size(),
                     [](unsigned char letter) { return std::isalnum(letter) || letter == '_'; });
}

void CommandLine::Private::requireNoInput(const std::string& who, const std::string& file) const
{
  for (const std::string& input : inputFiles(description, arguments))
  {
    if (areTheSame(input, file)) refuseOutput(who, file, "an input");
  }
}

void CommandLine::Private::claim(const std::string& who, const std::string& file)
{
  requireNoInput(who, file);
  const std::string place = placeOf(file);
  const bool isNew = claims.emplace(place, who).second;
  if (!isNew) refuseOutput(who, file, "an output of " + claims.at(place));
  for (const ManyFiles& many : manyFiles)
  {
    if (many.include(place)) refuseOutput(who, file, "one that " + many.who + " may write");
  }
}

void CommandLine::Private::claimMany(const std::string& who, const std::string& before, const std::string& after)
{
  const std::filesystem::path path(placeOf(before + "?"));
  const std::string name = path.filename().string();
  const ManyFiles many{ who, path.parent_path(), name.substr(0, name.size() - 1), after };
  const auto refuse = [&](const std::string& file, const std::string& what)
  {
    throw UsageError(who + ": one file per tissue, " + many.before + "..." + after + ", may be written to '" + file +
                     "', which is " + what + "; another name expected");
  };
  for (const std::string& input : inputFiles(description, arguments))
  {
    if (many.include(placeOf(input))) refuse(input, "an input");
    std::error_code error;
    for (std::filesystem::directory_iterator entry(many.folder, error), end; !error && entry != end;
         entry.increment(error))
    {
      const std::string file = entry->path().string();
      if (many.include(file) && areTheSame(input, file)) refuse(input, "an input");
    }
  }
  for (const auto& [place, other] : claims)
  {
    if (many.include(place)) refuse(place, "an output of " + other);
  }
  manyFiles.push_back(many);
}

/// Creates the temporary files before the work begins, so that a place that cannot be written to is reported at once.
void CommandLine::Private::prepareOutputs()
{
  std::vector<std::string> files;
  const auto add = [&](const std::string& who, const std::string& file)
  {
    claim(who, file);
    files.push_back(file);
  };
  for (const Parameter* parameter : description.parameters())
  {
    if (!parameter->isFile() || !parameter->output) continue;
    for (const std::string& file : values(*parameter)) add(parameter->spelling(), file);
  }
  if (!arguments.returnParameterFile.empty()) add("--returnparameterfile", arguments.returnParameterFile);
  for (const std::string& file : files) outputs.temporary(file);
}

void CommandLine::Private::echo() const
{
  for (const Parameter* parameter : description.parameters())
  {
    if (!parameter->isReturnValue())
      std::cout << parameter->name << ": " << text::joined(values(*parameter), ", ") << "\n";
  }
  std::cout << std::flush;
}

void CommandLine::Private::writeReturnParameterFile()
{
  if (arguments.returnParameterFile.empty()) return;
  std::ofstream file(outputs.temporary(arguments.returnParameterFile));
  for (const Parameter* parameter : description.parameters())
  {
    if (!parameter->isReturnValue()) continue;
    const auto returned = returnValues.find(parameter->name);
    if (returned == returnValues.end()) throw EngineError("no value for " + parameter->name + " was returned");
    file << parameter->name << " = " << returned->second << "\n";
  }
  // The file must exist even without return values, and an empty file counts as not written.
  if (returnValues.empty()) file << "\n";
}

void CommandLine::Private::tellOutputs() const
{
  for (const std::string& file : toldWritten) progress->output(file);
  for (const std::string& file : outputs.committed()) progress->output(file);
}

CommandLine::CommandLine(std::unique_ptr<Private> data) : d(std::move(data)) {}
CommandLine::~CommandLine() = default;

bool CommandLine::given(const std::string& name) const
{
  return d->arguments.values.count(d->parameter(name).name) != 0;
}

const std::map<std::string, std::vector<std::string>>& CommandLine::givenValues() const { return d->arguments.values; }

bool CommandLine::flag(const std::string& name) const
{
  const auto isFlag = [](const Parameter& p) { return p.type == "boolean"; };
  return d->value(d->parameter(name, isFlag, "boolean")) == "true";
}

int CommandLine::integer(const std::string& name) const
{
  const auto isInteger = [](const Parameter& p) { return p.isInteger() && !p.multiple; };
  return int(numberIn(d->value(d->parameter(name, isInteger, "single integer"))));
}

double CommandLine::number(const std::string& name) const
{
  const auto isNumber = [](const Parameter& p) { return p.isNumber() && !p.multiple; };
  return numberIn(d->value(d->parameter(name, isNumber, "single number")));
}

std::string CommandLine::text(const std::string& name) const
{
  const auto isText = [](const Parameter& p)
  { return !p.multiple && !p.output && (p.isFile() || p.type == "string" || p.type == "string-enumeration"); };
  return d->value(d->parameter(name, isText, "single text or input file"));
}

std::vector<std::string> CommandLine::texts(const std::string& name) const
{
  const auto isList = [](const Parameter& p)
  { return !p.output && p.multiple && (p.isFile() || p.type == "string" || p.type == "string-enumeration"); };
  return d->values(d->parameter(name, isList, "list of texts or input files"));
}

std::vector<double> CommandLine::numbers(const std::string& name) const
{
  const auto isList = [](const Parameter& p) { return p.isVector() && p.type != "string-vector" && !p.multiple; };
  std::vector<double> result;
  for (const std::string& item : text::split(d->value(d->parameter(name, isList, "vector of numbers")), ','))
  {
    result.push_back(numberIn(item));
  }
  return result;
}

std::vector<Vec3> CommandLine::points(const std::string& name) const
{
  const auto isPoint = [](const Parameter& p) { return p.type == "point"; };
  std::vector<Vec3> result;
  for (const std::string& point : d->values(d->parameter(name, isPoint, "point")))
  {
    const std::vector<std::string> xyz = text::split(point, ',');
    result.push_back({ numberIn(xyz[0]), numberIn(xyz[1]), numberIn(xyz[2]) });
  }
  return result;
}

std::string CommandLine::outputFile(const std::string& name)
{
  const auto isOutput = [](const Parameter& p) { return p.isFile() && p.output && !p.multiple; };
  const std::string file = d->value(d->parameter(name, isOutput, "single output file"));
  return file.empty() ? file : d->outputs.temporary(file);
}

std::vector<std::string> CommandLine::outputNames(const std::string& name) const
{
  const auto isOutput = [](const Parameter& p) { return p.isFile() && p.output; };
  return d->values(d->parameter(name, isOutput, "output file"));
}

std::string CommandLine::outputPath(const std::string& finalPath)
{
  d->requireNoInput("output", finalPath);
  return d->outputs.temporary(finalPath);
}

void CommandLine::alsoWrites(const std::string& name, const std::string& finalPath)
{
  d->claim(d->parameter(name).spelling(), finalPath);
}

void CommandLine::alsoWritesMany(const std::string& name, const std::string& before, const std::string& after)
{
  d->claimMany(d->parameter(name).spelling(), before, after);
}

void CommandLine::commitOutput(const std::string& name)
{
  for (const std::string& file : this->outputNames(name)) d->outputs.commit(file);
}

void CommandLine::discardOutput(const std::string& name)
{
  for (const std::string& file : this->outputNames(name)) d->outputs.discard(file);
}

void CommandLine::commitPath(const std::string& finalPath) { d->outputs.commit(finalPath); }

void CommandLine::tellWritten(const std::string& path) { d->toldWritten.insert(path); }

void CommandLine::returnValue(const std::string& name, const std::string& value)
{
  d->parameter(
    name, [](const Parameter& p) { return p.isReturnValue(); }, "simple output");
  d->returnValues[name] = text::oneLine(value);
}

Progress CommandLine::progress()
{
  return [report = d->progress.get()](double fraction, const std::string& stage) { report->update(fraction, stage); };
}

void CommandLine::message(const std::string& line) { d->progress->message(line); }

void CommandLine::warning(const std::string& line)
{
  d->warnings.push_back(line);
  d->progress->warning(line);
}

const std::vector<std::string>& CommandLine::warnings() const { return d->warnings; }

namespace
{

ProgressFormat progressFormat(const Arguments& arguments)
{
  if (arguments.progress != ProgressFormat::Unset) return arguments.progress;
  const bool hasHost = arguments.fromHost || std::getenv("SLICER_HOME");
  if (stdoutIsTerminal()) return ProgressFormat::Bar;
  return hasHost ? ProgressFormat::Xml : ProgressFormat::Plain;
}

/// Answers --xml, --help and --version. Returns false if none of them is given.
bool answerQuestion(const std::vector<std::string>& arguments, const std::string& xml, const std::string& executable)
{
  for (const std::string& argument : arguments)
  {
    if (argument == "--") return false;
    if (argument == "--xml") std::cout << xml;
    else if (argument == "--help" || argument == "-h") std::cout << helpText(parseModuleDescription(xml), executable);
    else if (argument == "--version") std::cout << executable << " " << parseModuleDescription(xml).version << "\n";
    else continue;
    std::cout << std::flush;
    return true;
  }
  return false;
}

} // namespace

int runModule(int argc, char** argv, const std::string& xml, const std::function<void(CommandLine&)>& module)
{
  openStandardStreams();
  keepStatusOfChildren();
  const std::string executable = argc > 0 ? std::filesystem::path(argv[0]).stem().string() : std::string("module");
  std::unique_ptr<CommandLine> line;
  const auto failed = [&](int status, const std::string& message)
  {
    const std::string text = line ? line->d->outputs.withFinalNames(message) : message;
    std::cerr << executable << ": " << text::oneLine(printable(text)) << "\n" << std::flush;
    return status;
  };
  const auto run = [&]
  {
    const std::vector<std::string> arguments(argv + std::min(argc, 1), argv + argc);
    if (answerQuestion(arguments, xml, executable)) return;

    auto data = std::make_unique<CommandLine::Private>();
    data->description = parseModuleDescription(xml);
    data->arguments = parseArguments(data->description, arguments);
    useLargePages();
    const auto warn = [&executable](const std::string& text)
    { writeToStderr(executable + ": warning: " + text + "\n"); };
    data->progress = std::make_unique<ProgressReport>(std::cout, progressFormat(data->arguments),
                                                      data->description.title, data->arguments.quiet, warn);
    line.reset(new CommandLine(std::move(data)));

    installSignalHandlers(executable);
    returnFreedMemory();
    const QuietStderr quiet;
    silenceVTK();
    if (line->d->arguments.echo) line->d->echo();
    line->d->prepareOutputs();
    try
    {
      module(*line);
    }
    catch (...)
    {
      line->d->progress->finish();
      throw;
    }
    line->d->writeReturnParameterFile();
    line->d->outputs.commit();
    line->d->progress->finish();
    line->d->tellOutputs();
  };

  try
  {
    run();
    requireStdoutWritten();
    return 0;
  }
  catch (const Error& error)
  {
    return failed(error.exitStatus(), error.what());
  }
  catch (const std::bad_alloc&)
  {
    return failed(3, "out of memory");
  }
  catch (const std::exception& error)
  {
    return failed(3, error.what());
  }
  catch (...)
  {
    return failed(3, "unknown failure of a library");
  }
}

} // namespace surgicalmesher
