#pragma once
/// The runtime of the command-line modules. One XML per module (Slicer's ModuleDescription) is the single source of flags,
/// types, defaults, ranges and help; a module is that text and a function:
///
///     int main(int argc, char** argv)
///     {
///       return surgicalmesher::runModule(argc, argv, xml, [](CommandLine& line) { ... });
///     }
///
/// runModule answers --xml, --help and --version, parses and checks the options, hands them to the function, renames the
/// outputs into place when it returns, and turns what it throws into one line on stderr and an exit status:
/// 0 done, 1 InputError, 2 UsageError, 3 EngineError or anything else. Outputs appear whole or not at all.

#include "Progress.h"

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace surgicalmesher
{

class CommandLine
{
public:
  /// Parameters are named as in the XML's <name>. Asking for a parameter the XML lacks, or for another type than it
  /// declares, is a programming error (std::logic_error). Without a value on the command line the XML's default is returned.
  bool given(const std::string& name) const;
  bool flag(const std::string& name) const;
  int integer(const std::string& name) const;
  double number(const std::string& name) const;
  std::string text(const std::string& name) const;              ///< strings, enumerations and input files
  std::vector<std::string> texts(const std::string& name) const; ///< parameters with multiple="true"

  /// Where to write output `name` now: a temporary file in its final folder, with its final extension, renamed into
  /// place after the module function has returned. Throws InputError if the folder can't be written to. Empty if the
  /// output was not asked for.
  std::string outputFile(const std::string& name);
  std::vector<std::string> outputFiles(const std::string& name); ///< multiple="true"
  /// The same for a file the XML doesn't list (a sidecar next to an output).
  std::string outputPath(const std::string& finalPath);

  /// A simple output parameter (channel output, no file): written to --returnparameterfile as `name = value`.
  void returnValue(const std::string& name, const std::string& value);

  /// XML tags as Slicer reads them when stdout is a pipe, a progress bar on a terminal.
  Progress progress();

  ~CommandLine();

private:
  friend int runModule(int, char**, const std::string&, const std::function<void(CommandLine&)>&);
  CommandLine();
  struct Private;
  std::unique_ptr<Private> d;
};

int runModule(int argc, char** argv, const std::string& xml, const std::function<void(CommandLine&)>& module);

} // namespace surgicalmesher
