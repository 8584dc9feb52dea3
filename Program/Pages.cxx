// SPDX-License-Identifier: Apache-2.0
// Manual pages and completions for bash, from the descriptions that --help is made of. Run by the build, not installed.
// usage: surgicalmesher-pages FOLDER PROGRAM=XML...

#include "Descriptions.h"
#include "TextFile.h"

#include <filesystem>
#include <iostream>

using namespace surgicalmesher;

namespace
{

struct Page
{
  std::string name;    ///< file name, such as surgicalmesher-mesh
  std::string command; ///< as typed, such as surgicalmesher mesh
  ModuleDescription description;
};

/// Escapes what is special to roff: dashes, backslashes, and a point or an apostrophe at the start.
std::string roff(const std::string& text)
{
  std::string result;
  for (const char letter : text)
  {
    if (letter == '-' || letter == '\\') result += letter == '-' ? "\\-" : "\\e";
    else result += letter;
  }
  return result.empty() || (result.front() != '.' && result.front() != '\'') ? result : "\\&" + result;
}

std::string manualEntry(const Parameter& parameter)
{
  if (parameter.isReturnValue()) return {};
  std::string details = parameter.type == "boolean" ? "" : expectation(parameter);
  if (!parameter.defaultValue.empty()) details += (details.empty() ? "" : "; ") + ("default " + parameter.defaultValue);
  return ".TP\n.B " + roff(parameter.spelling()) + "\n" + roff(parameter.description) +
         (details.empty() ? "" : " [" + roff(details) + "]") + "\n";
}

std::string manualPage(const Page& page)
{
  const ModuleDescription& about = page.description;
  std::string text = ".TH " + roff(page.name) + " 1 \"\" \"SurgicalMesher " + about.version + "\"\n.SH NAME\n" +
                     roff(page.name) + " \\- " + roff(about.title) + "\n.SH SYNOPSIS\n.B " + roff(page.command) +
                     "\n[options]";
  for (const Parameter* parameter : about.positionals())
    text += " " + roff(parameter->name) + (parameter->multiple ? " ..." : "");
  text += "\n.SH DESCRIPTION\n" + roff(about.description) + "\n";
  for (const ParameterGroup& group : about.groups)
  {
    std::string entries;
    for (const Parameter& parameter : group.parameters) entries += manualEntry(parameter);
    if (!entries.empty()) text += ".SH \"" + roff(group.label) + "\"\n" + roff(group.description) + ".\n" + entries;
  }
  return text + ".SH \"EXIT STATUS\"\n0 done, 1 the input is at fault, 2 the command line is at fault, 3 the engine "
                "failed, memory ran out, or what was printed on stdout could not be written.\n";
}

/// Returns the manual page of surgicalmesher itself, which refers to those of its commands.
std::string overview(const std::vector<Page>& pages)
{
  std::string text = ".TH surgicalmesher 1 \"\" \"SurgicalMesher " + pages.front().description.version +
                     "\"\n.SH NAME\nsurgicalmesher \\- from label map to finite elements\n.SH SYNOPSIS\n"
                     ".B surgicalmesher\nCOMMAND ...\n.SH COMMANDS\n";
  for (const Page& page : pages)
    text += ".TP\n.BR " + roff(page.name) + " (1)\n" + roff(page.description.description) + "\n";
  return text;
}

std::string flagsOf(const ModuleDescription& description)
{
  std::string flags = "--help --version --progress --quiet";
  for (const Parameter* parameter : description.parameters())
    if (!parameter->longFlag.empty()) flags += " --" + parameter->longFlag;
  return flags;
}

/// Returns the shell cases that complete the choices of a flag, one case for each flag.
std::string casesOf(const ModuleDescription& description)
{
  std::string cases;
  for (const Parameter* parameter : description.parameters())
  {
    if (parameter->choices.empty() || parameter->longFlag.empty()) continue;
    std::string words;
    for (const std::string& choice : parameter->choices)
      if (choice.find(' ') == std::string::npos) words += (words.empty() ? "" : " ") + choice;
    cases += "      --" + parameter->longFlag + ") COMPREPLY=($(compgen -W '" + words + "' -- \"$word\")); return ;;\n";
  }
  return cases;
}

std::string caseOf(const Page& page, const std::string& pattern)
{
  return "  " + pattern + ")\n    case $before in\n" + casesOf(page.description) +
         "    esac\n    if [[ $word == -* ]]; then COMPREPLY=($(compgen -W '" + flagsOf(page.description) +
         "' -- \"$word\")); fi ;;\n";
}

/// Returns the completion of a program, or of all commands of surgicalmesher; where no word fits, files are completed.
std::string completion(const std::string& program, const std::string& cases)
{
  std::string function = "_" + program;
  return "# bash completion of " + program + "\n" + function + "()\n{\n  local word=${COMP_WORDS[COMP_CWORD]} " +
         "before=${COMP_WORDS[COMP_CWORD-1]}\n  COMPREPLY=()\n  case ${COMP_WORDS[1]} in\n" + cases +
         "  esac\n}\ncomplete -o default -F " + function + " " + program + "\n";
}

std::vector<Page> commandPages()
{
  const std::vector<std::pair<std::string, std::string>> commands{
    { "mesh", mergedDescription(meshXML, { pathScaleXML, simplexMesherXML, tetrahedralizerXML, tissueMapperXML }) },
    { "estimate", mergedDescription(estimateXML, { pathScaleXML, tissueMapperXML }, Outputs::LeftOut) },
    { "quality", qualityXML },
    { "convert", convertXML },
    { "view", viewXML }
  };
  std::vector<Page> pages;
  for (const auto& [name, xml] : commands)
    pages.push_back({ "surgicalmesher-" + name, "surgicalmesher " + name, parseModuleDescription(xml) });
  return pages;
}

} // namespace

int main(int argc, char** argv)
{
  if (argc < 2) return 2;
  const std::filesystem::path folder = argv[1];
  std::filesystem::create_directories(folder / "man1");
  std::filesystem::create_directories(folder / "completions");
  const auto writeManual = [&](const Page& page)
  { writeBytes(manualPage(page), (folder / "man1" / (page.name + ".1")).string()); };
  const std::string all = "surgicalmesher";
  std::string cases, names;
  for (const Page& page : commandPages())
  {
    const std::string name = page.command.substr(all.size() + 1);
    writeManual(page);
    cases += caseOf(page, name);
    names += (names.empty() ? "" : " ") + name;
  }
  writeBytes(overview(commandPages()), (folder / "man1" / (all + ".1")).string());
  cases += "  *) COMPREPLY=($(compgen -W '" + names + " --help --version' -- \"$word\")) ;;\n";
  writeBytes(completion(all, cases), (folder / "completions" / all).string());
  for (int i = 2; i < argc; ++i)
  {
    const std::string word = argv[i];
    const std::string name = word.substr(0, word.find('='));
    const Page page{ name, name, parseModuleDescription(text::readTextFile(word.substr(name.size() + 1))) };
    writeManual(page);
    writeBytes(completion(name, caseOf(page, "*")), (folder / "completions" / name).string());
  }
  return 0;
}
