// SPDX-License-Identifier: Apache-2.0
// surgicalmesher: the program that runs all stages from label map to finite elements, and commands to use the results.

#include "Arguments.h"
#include "Commands.h"
#include "Descriptions.h"
#include "Errors.h"
#include "Platform.h"
#include "PrintableText.h"
#include "Text.h"

#include <vtksys/SystemTools.hxx>

#include <algorithm>
#include <exception>
#include <filesystem>
#include <iostream>
#include <new>

using namespace surgicalmesher;

namespace
{

struct Command
{
  std::string name, arguments, summary;
  std::string xml;
  void (*run)(CommandLine& line, const std::string& programs, const std::string& xml);
};

const std::vector<Command>& commands()
{
  static const std::vector<Command> all{
    { "mesh", "MAP FOLDER", "from label map, or image and training points, to mesh, exports and report",
      mergedDescription(meshXML, { pathScaleXML, simplexMesherXML, tetrahedralizerXML, tissueMapperXML }),
      meshCommand },
    { "estimate", "MAP", "triangles, tetrahedra, memory and time, before anything is meshed",
      mergedDescription(estimateXML, { pathScaleXML, tissueMapperXML }, Outputs::LeftOut), estimateCommand },
    { "quality", "MESH", "measures of tetrahedra, hexahedra and wedges, by tissue", qualityXML,
      [](CommandLine& line, const std::string&, const std::string&) { qualityCommand(line); } },
    { "convert", "MESH FILE...", "a mesh in the formats of solvers", convertXML,
      [](CommandLine& line, const std::string&, const std::string&) { convertCommand(line); } },
    { "view", "MESH PNG", "a picture of a surface or a mesh, without a display", viewXML,
      [](CommandLine& line, const std::string&, const std::string&) { viewCommand(line); } },
  };
  return all;
}

std::string padded(const std::string& text, std::size_t width) { return text + std::string(width - text.size(), ' '); }

std::string usage()
{
  std::string text = "Usage: surgicalmesher COMMAND ...\n\n";
  for (const Command& command : commands())
    text += "  " + padded(command.name, 10) + padded(command.arguments, 14) + command.summary + "\n";
  return text +
         "\nsurgicalmesher COMMAND --help tells all options of a command; surgicalmesher --version the version.\n";
}

const Command& commandNamed(const std::string& name)
{
  std::vector<std::string> names;
  for (const Command& command : commands())
  {
    if (name == command.name) return command;
    names.push_back(command.name);
  }
  const std::string nearest = nearestWord(name, names);
  throw UsageError("'" + name + "': unknown command found, one of " + text::joined(names, ", ") + " expected" +
                   (nearest.empty() ? "" : "; did you mean " + nearest + "?"));
}

std::string folderOf(const std::filesystem::path& program)
{
  std::error_code failed;
  const std::filesystem::path real = std::filesystem::canonical(program, failed);
  return (failed ? program : real).parent_path().string();
}

/// Returns the folder of this program, to which the other programs are installed as well. Whoever starts a program may
/// give it any name, so that the system's own record comes first; that is of the loader if the loader runs the program.
std::string folderOfPrograms(const char* self)
{
  std::error_code none;
  std::string running = folderOf("/proc/self/exe");
  if (std::filesystem::exists(std::filesystem::path(running) / "SurgicalPathScaleCLI", none)) return running;
  std::string path, error;
  vtksys::SystemTools::FindProgramPath(self, path, error);
  return folderOf(path);
}

int run(const std::string& self, const std::vector<std::string>& arguments)
{
  const Command& command = commandNamed(arguments.front());
  const std::string programs = folderOfPrograms(self.c_str());
  std::vector<std::string> words(arguments.begin() + 1, arguments.end());
  if (command.run == meshCommand) words = withConfiguration(words, command.xml);
  words.insert(words.begin(), "surgicalmesher " + command.name);
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  return runModule(int(pointers.size()), pointers.data(), command.xml,
                   [&](CommandLine& line) { command.run(line, programs, command.xml); });
}

int answer(int argc, char** argv)
{
  const std::vector<std::string> arguments(argv + std::min(argc, 1), argv + argc);
  const std::string first = arguments.empty() ? "--help" : arguments.front();
  if (first == "--version") std::cout << "surgicalmesher " << parseModuleDescription(meshXML).version << "\n";
  else if (first == "--help" || first == "-h") std::cout << usage();
  else return run(argv[0], arguments);
  requireStdoutWritten();
  return arguments.empty() ? 2 : 0;
}

int failed(int status, const std::string& message)
{
  std::cerr << "surgicalmesher: " << text::oneLine(printable(message)) << "\n";
  return status;
}

} // namespace

int main(int argc, char** argv)
{
  try
  {
    openStandardStreams();
    keepStatusOfChildren();
    return answer(argc, argv);
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
}
