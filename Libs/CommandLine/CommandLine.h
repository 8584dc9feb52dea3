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
/// the outputs into place when it returns, and turns what it throws into one line on stderr and an exit status: 0 done,
/// 1 InputError, 2 UsageError, 3 EngineError or anything else, a stdout that could not be written to among it. Outputs
/// appear whole or not at all, and never in place of an input.
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
  /// Parameters are named as in the XML's <name>. Asking for a parameter the XML lacks, or for another type than it
  /// declares, is a programming error (std::logic_error). Without a value on the command line the XML's default is
  /// returned.
  ///
  /// Slicer passes every number and choice, also those the user left alone: for them `given` tells nothing, and a value
  /// of their range has to mean "not used".
  bool given(const std::string& name) const;
  /// All that was given, as it was typed, by parameter: for programs that hand options on.
  const std::map<std::string, std::vector<std::string>>& givenValues() const;
  bool flag(const std::string& name) const;
  int integer(const std::string& name) const;
  double number(const std::string& name) const;
  std::string text(const std::string& name) const; ///< strings, enumerations and input files; "" if there is none
  std::vector<std::string> texts(const std::string& name) const; ///< input files with multiple="true"
  std::vector<double> numbers(const std::string& name) const;    ///< integer and double vectors
  std::vector<Vec3> points(const std::string& name) const;       ///< type point, in the XML's coordinateSystem, mm

  /// Where to write output `name` now: a temporary file in its final folder, with its final extension, renamed into
  /// place after the module function has returned. Empty if the output was not asked for. That the place can be written
  /// to has been checked before the function was called; an output that was asked for has to be written.
  std::string outputFile(const std::string& name);
  /// The final names of the same files, one or many: to write by outputPath(), with sidecars named after them.
  std::vector<std::string> outputNames(const std::string& name) const;
  /// The same for a file the XML doesn't list (a sidecar next to an output). Throws InputError if it can't be created,
  /// UsageError if it is an input or another output: announce sidecars before anything is read, so that this shows in
  /// time.
  std::string outputPath(const std::string& finalPath);

  /// Announces a sidecar of output `name`. Throws UsageError if it is an input, another output or another sidecar.
  void alsoWrites(const std::string& name, const std::string& finalPath);
  /// Announces any number of sidecars of output `name`, called `before`, some letters, digits or underscores, and
  /// `after`.
  void alsoWritesMany(const std::string& name, const std::string& before, const std::string& after);

  /// An output that only a refusal has, to show what is at fault: renamed into place at once, or not to be written.
  void commitOutput(const std::string& name);
  void discardOutput(const std::string& name);
  /// A file of outputPath() that is of use while the run goes on: renamed into place at once.
  void commitPath(const std::string& finalPath);

  /// A file that is in place without having been an output here, as one by a program that this one has run:
  /// --progress json tells it at the end with the others.
  void tellWritten(const std::string& path);

  /// A simple output parameter (channel output, no flag): written to --returnparameterfile as `name = value`.
  void returnValue(const std::string& name, const std::string& value);

  /// A progress bar on a terminal; elsewhere tags as Slicer reads them if a host runs the module, which passes
  /// --returnparameterfile or lives in an environment with SLICER_HOME, else lines with the time left; or what
  /// --progress asks for. Valid as long as this object.
  Progress progress();
  /// A line on stdout that keeps clear of the progress bar.
  void message(const std::string& line);
  /// A line on stderr, "<program>: warning: <line>". Hosts take what comes on stderr for errors: for them it goes to
  /// stdout.
  void warning(const std::string& line);
  const std::vector<std::string>& warnings() const; ///< so far

  ~CommandLine();

private:
  friend int runModule(int, char**, const std::string&, const std::function<void(CommandLine&)>&);
  struct Private;
  explicit CommandLine(std::unique_ptr<Private> data);
  std::unique_ptr<Private> d;
};

int runModule(int argc, char** argv, const std::string& xml, const std::function<void(CommandLine&)>& module);

} // namespace surgicalmesher
