#include "CommandLine.h"

#include "Arguments.h"
#include "Errors.h"
#include "ModuleDescription.h"
#include "OutputFiles.h"
#include "Platform.h"
#include "ProgressReport.h"
#include "Text.h"

#include <vtkLogger.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkOutputWindow.h>

#include <algorithm>
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

/// On Windows VTK's own would open a window and wait for the user.
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

  void refuseToReplaceInput(const Parameter& output, const std::string& file) const;
  void prepareOutputs();
  void echo() const;
  void writeReturnParameterFile();
};

/// An output may replace an input of its own kind, as when the host works in place. Of another kind, it is a slip.
void CommandLine::Private::refuseToReplaceInput(const Parameter& output, const std::string& file) const
{
  for (const Parameter* input : description.parameters())
  {
    const bool sameKind = input->type == output.type && input->kind == output.kind;
    if (!input->isFile() || input->output || sameKind) continue;
    for (const std::string& inputFile : values(*input))
    {
      std::error_code error;
      if (!std::filesystem::equivalent(inputFile, file, error)) continue;
      throw UsageError(output.spelling() + ": '" + file + "' is an input, too; another file expected");
    }
  }
}

/// Creates the temporaries before the work begins, so that a place that can't be written to shows at once.
void CommandLine::Private::prepareOutputs()
{
  std::set<std::string> temporaries;
  for (const Parameter* parameter : description.parameters())
  {
    if (!parameter->isFile() || !parameter->output) continue;
    for (const std::string& file : values(*parameter))
    {
      refuseToReplaceInput(*parameter, file);
      if (temporaries.insert(outputs.temporary(file)).second) continue;
      throw UsageError(parameter->spelling() + ": '" + file + "' is another output, too; another file expected");
    }
  }
  if (!arguments.returnParameterFile.empty()) outputs.temporary(arguments.returnParameterFile);
}

void CommandLine::Private::echo() const
{
  for (const Parameter* parameter : description.parameters())
  {
    if (!parameter->isReturnValue()) std::cout << parameter->name << ": " << joined(values(*parameter), ", ") << "\n";
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
  // Without a return value the file has to be there all the same, and an empty one counts as not written.
  if (returnValues.empty()) file << "\n";
}

CommandLine::CommandLine(std::unique_ptr<Private> data) : d(std::move(data)) {}
CommandLine::~CommandLine() = default;

bool CommandLine::given(const std::string& name) const
{
  return d->arguments.values.count(d->parameter(name).name) != 0;
}

bool CommandLine::flag(const std::string& name) const
{
  const auto isFlag = [](const Parameter& p) { return p.type == "boolean"; };
  return d->value(d->parameter(name, isFlag, "boolean")) == "true";
}

int CommandLine::integer(const std::string& name) const
{
  const auto isInteger = [](const Parameter& p) { return p.isInteger() && !p.multiple; };
  return parseInteger(d->value(d->parameter(name, isInteger, "single integer"))).value();
}

double CommandLine::number(const std::string& name) const
{
  const auto isNumber = [](const Parameter& p) { return p.isNumber() && !p.multiple; };
  return parseNumber(d->value(d->parameter(name, isNumber, "single number"))).value();
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
  for (const std::string& item : split(d->value(d->parameter(name, isList, "vector of numbers")), ','))
  {
    result.push_back(parseNumber(item).value());
  }
  return result;
}

std::vector<Vec3> CommandLine::points(const std::string& name) const
{
  const auto isPoint = [](const Parameter& p) { return p.type == "point"; };
  std::vector<Vec3> result;
  for (const std::string& point : d->values(d->parameter(name, isPoint, "point")))
  {
    const std::vector<std::string> xyz = split(point, ',');
    result.push_back({ parseNumber(xyz[0]).value(), parseNumber(xyz[1]).value(), parseNumber(xyz[2]).value() });
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

std::vector<std::string> CommandLine::outputFiles(const std::string& name)
{
  const auto isOutput = [](const Parameter& p) { return p.isFile() && p.output && p.multiple; };
  std::vector<std::string> files = d->values(d->parameter(name, isOutput, "list of output files"));
  for (std::string& file : files) file = d->outputs.temporary(file);
  return files;
}

std::string CommandLine::outputPath(const std::string& finalPath) { return d->outputs.temporary(finalPath); }

void CommandLine::commitOutput(const std::string& name)
{
  for (const std::string& file : this->outputNames(name)) d->outputs.commit(file);
}

void CommandLine::discardOutput(const std::string& name)
{
  for (const std::string& file : this->outputNames(name)) d->outputs.discard(file);
}

void CommandLine::returnValue(const std::string& name, const std::string& value)
{
  d->parameter(
    name, [](const Parameter& p) { return p.isReturnValue(); }, "simple output");
  d->returnValues[name] = oneLine(value);
}

Progress CommandLine::progress()
{
  return [report = d->progress.get()](double fraction, const std::string& stage) { report->update(fraction, stage); };
}

void CommandLine::message(const std::string& line) { d->progress->message(line); }

namespace
{

/// Answers --xml, --help and --version. Returns false if none of them is there.
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
  const std::string executable = argc > 0 ? std::filesystem::path(argv[0]).stem().string() : std::string("module");
  std::unique_ptr<CommandLine> line;
  const auto failed = [&](int status, const std::string& message)
  {
    const std::string text = line ? line->d->outputs.withFinalNames(message) : message;
    std::cerr << executable << ": " << oneLine(text) << "\n" << std::flush;
    return status;
  };
  const auto run = [&]
  {
    const std::vector<std::string> arguments(argv + std::min(argc, 1), argv + argc);
    if (answerQuestion(arguments, xml, executable)) return;

    auto data = std::make_unique<CommandLine::Private>();
    data->description = parseModuleDescription(xml);
    data->arguments = parseArguments(data->description, arguments);
    data->progress = std::make_unique<ProgressReport>(std::cout, stdoutIsTerminal(), data->description.title);
    line.reset(new CommandLine(std::move(data)));

    installSignalHandlers();
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
  };

  try
  {
    run();
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
