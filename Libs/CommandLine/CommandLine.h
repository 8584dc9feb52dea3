// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The runtime of the command-line modules. One XML per module (Slicer's ModuleDescription) is the single source of
/// flags, types, defaults, ranges and help; a module is that text and a function:
///
///     int main(int argc, char** argv)
///     {
///       return surgicalmesher::runModule(argc, argv, surgicalmesher::moduleXML, [](CommandLine& line) { ... });
///     }
///
/// runModule answers --xml, --help and --version, parses and checks the options, hands them to the function, renames
/// the outputs into place when it returns, and turns exceptions into one line on stderr and an exit status: 0 done,
/// 1 InputError, 2 UsageError, 3 EngineError or any other failure, such as a stdout that could not be written to.
/// Outputs appear whole or not at all, and never in place of an input.
///
/// While the function runs, what libraries write to stderr is discarded, unless the environment variable
/// SURGICALMESHER_DEBUG is set.

#include "Progress.h"
#include "Vec3.h"

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
  /// Parameters are named as in the XML's <name>. Asking for a parameter that the XML lacks, or for another type than
  /// it declares, is a programming error (std::logic_error). Without a value on the command line the XML's default is
  /// returned.
  ///
  /// Whether the parameter is on the command line. Slicer passes every number and choice, including those that the user
  /// left alone: for these, the result is meaningless, and one value in their range has to mean "not used".
  bool given(const std::string& name) const;
  /// All values on the command line as typed, by parameter name: for programs that pass options on.
  const std::map<std::string, std::vector<std::string>>& givenValues() const;
  bool flag(const std::string& name) const;
  int integer(const std::string& name) const;
  double number(const std::string& name) const;
  std::string text(const std::string& name) const; ///< strings, enumerations and input files; "" if there is none
  std::vector<std::string> texts(const std::string& name) const; ///< input files with multiple="true"
  std::vector<double> numbers(const std::string& name) const;    ///< integer and double vectors
  std::vector<Vec3> points(const std::string& name) const;       ///< type point, in the XML's coordinateSystem, mm

  /// Returns the path to write output `name` to: a temporary file in the final folder, with the final extension, which
  /// is renamed into place after the module function has returned. Empty if the output was not requested. An output
  /// that was requested must be written; that its place is writable was checked before the function was called.
  std::string outputFile(const std::string& name);
  /// Returns the final names of the files of output `name`, to write by outputPath() or to name sidecars after.
  std::vector<std::string> outputNames(const std::string& name) const;
  /// Returns the temporary path for a file that the XML does not list, such as a sidecar next to an output; renamed
  /// like outputFile(). Throws InputError if it cannot be created, UsageError if it is an input. alsoWrites() finds
  /// such conflicts, and those with other outputs, before anything is read.
  std::string outputPath(const std::string& finalPath);

  /// Announces a sidecar of output `name`. Throws UsageError if it is an input, another output or another sidecar.
  void alsoWrites(const std::string& name, const std::string& finalPath);
  /// Announces any number of sidecars of output `name`, whose paths are `before`, one or more letters, digits or
  /// underscores, and `after`. Throws UsageError if an input or another output has such a path.
  void alsoWritesMany(const std::string& name, const std::string& before, const std::string& after);

  /// For an output that is written only when the input is refused, to show what is at fault: commitOutput() renames it
  /// into place at once, discardOutput() removes it.
  void commitOutput(const std::string& name);
  void discardOutput(const std::string& name);
  /// Renames a file of outputPath() into place at once, for files that are useful while the run goes on.
  void commitPath(const std::string& finalPath);

  /// Reports a file that is in place but is no output of this program, such as one of a program that this one has run:
  /// --progress json lists it at the end with the outputs.
  void tellWritten(const std::string& path);

  /// Sets a simple output parameter (channel output, no flag), which --returnparameterfile receives as `name = value`.
  void returnValue(const std::string& name, const std::string& value);

  /// Returns the progress callback, valid as long as this object. It writes what --progress asks for; by default a bar
  /// on a terminal, else XML tags if a host such as Slicer runs the module (a flag that only hosts pass, or the
  /// environment variable SLICER_HOME), else lines of text with the time left.
  Progress progress();
  /// Writes a line to stdout, clear of the progress bar.
  void message(const std::string& line);
  /// Writes "<program>: warning: <line>" to stderr, or to stdout for hosts, which take everything on stderr for errors.
  void warning(const std::string& line);
  const std::vector<std::string>& warnings() const; ///< all so far

  ~CommandLine();

private:
  friend int runModule(int, char**, const std::string&, const std::function<void(CommandLine&)>&);
  struct Private;
  explicit CommandLine(std::unique_ptr<Private> data);
  std::unique_ptr<Private> d;
};

int runModule(int argc, char** argv, const std::string& xml, const std::function<void(CommandLine&)>& module);

} // namespace surgicalmesher
