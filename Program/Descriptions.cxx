// SPDX-License-Identifier: Apache-2.0
#include "Descriptions.h"

#include <vtkSmartPointer.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLUtilities.h>

#include <algorithm>
#include <cctype>
#include <sstream>

namespace surgicalmesher
{

namespace
{

using Element = vtkSmartPointer<vtkXMLDataElement>;

Element parsed(const std::string& xml) { return Element::Take(vtkXMLUtilities::ReadElementFromString(xml.c_str())); }

std::string childText(vtkXMLDataElement* element, const char* name)
{
  vtkXMLDataElement* child = element->FindNestedElementWithName(name);
  return child && child->GetCharacterData() ? child->GetCharacterData() : std::string();
}

std::vector<vtkXMLDataElement*> childrenOf(vtkXMLDataElement* element)
{
  std::vector<vtkXMLDataElement*> children;
  for (int i = 0; i < element->GetNumberOfNestedElements(); ++i) children.push_back(element->GetNestedElement(i));
  return children;
}

/// Removes the hint that files can be separated by commas: a text is taken as it is, so several need the flag repeated.
void tellOfNoList(vtkXMLDataElement* description)
{
  const std::string ofFiles = " or separate files by commas";
  if (!description || !description->GetCharacterData()) return;
  std::string text = description->GetCharacterData();
  const std::size_t at = text.find(ofFiles);
  if (at == std::string::npos) return;
  text.erase(at, ofFiles.size());
  description->SetCharacterData(text.c_str(), int(text.size()));
}

void makeText(vtkXMLDataElement* output)
{
  tellOfNoList(output->FindNestedElementWithName("description"));
  output->SetName("string");
  output->RemoveAttribute("fileExtensions");
  output->RemoveNestedElement(output->FindNestedElementWithName("channel"));
}

void setText(vtkXMLDataElement* element, const std::string& text)
{
  element->SetCharacterData(text.c_str(), int(text.size()));
}

/// Whether users can give the option, and no earlier program has it.
bool isKept(vtkXMLDataElement* parameter, const std::string& name, Outputs outputs, std::set<std::string>& seen)
{
  if (!parameter->FindNestedElementWithName("longflag") || stageOptions().count(name)) return false;
  if (outputs == Outputs::LeftOut && childText(parameter, "channel") == "output") return false;
  return seen.insert(name).second;
}

/// Removes the options that users cannot give, and renames the others to their merged names; returns whether any is
/// left.
bool keepOptions(vtkXMLDataElement* group, const ModuleDescription& program, Outputs outputs,
                 std::set<std::string>& seen)
{
  bool isUsed = false;
  for (vtkXMLDataElement* parameter : childrenOf(group))
  {
    const std::string own = childText(parameter, "name");
    if (own.empty()) continue; // the group's label and description
    const std::string name = mergedName(own, program);
    const bool isOption = isKept(parameter, name, outputs, seen);
    if (!isOption) group->RemoveNestedElement(parameter);
    else if (childText(parameter, "channel") == "output") makeText(parameter);
    if (isOption && name != own)
    {
      for (const char* element : { "name", "longflag" }) setText(parameter->FindNestedElementWithName(element), name);
    }
    isUsed = isUsed || isOption;
  }
  return isUsed;
}

/// The programs in the order of their options.
const std::vector<ModuleDescription>& programs()
{
  static const std::vector<ModuleDescription> all{
    parseModuleDescription(pathScaleXML),
    parseModuleDescription(simplexMesherXML),
    parseModuleDescription(tetrahedralizerXML),
    parseModuleDescription(tissueMapperXML),
  };
  return all;
}

/// Returns the name prefixed by the program's, such as simplexMesherGradation for Simplex Mesher's gradation.
std::string nameBehindProgram(std::string name, const ModuleDescription& program)
{
  std::string own = program.title;
  own.erase(std::remove(own.begin(), own.end(), ' '), own.end());
  own[0] = char(std::tolower(own[0]));
  name[0] = char(std::toupper(name[0]));
  return own + name;
}

} // namespace

const std::set<std::string>& stageOptions()
{
  static const std::set<std::string> options{ "scale",          "edgeLength", "ambient",  "preparedLabelMap",
                                              "outputLabelMap", "report",     "channel2", "channel3" };
  return options;
}

std::string mergedName(const std::string& name, const ModuleDescription& program)
{
  for (const ModuleDescription& earlier : programs())
  {
    const Parameter* first = earlier.find(name);
    if (!first) continue;
    const bool isShared = first->defaultValue == program.find(name)->defaultValue;
    return isShared ? name : nameBehindProgram(name, program);
  }
  return name;
}

bool isOutputFile(const std::string& name)
{
  const auto isIts = [&](const ModuleDescription& program)
  {
    const std::vector<const Parameter*> all = program.parameters();
    return std::any_of(all.begin(), all.end(),
                       [&](const Parameter* parameter) {
                         return parameter->isFile() && parameter->output &&
                                mergedName(parameter->name, program) == name;
                       });
  };
  return std::any_of(programs().begin(), programs().end(), isIts);
}

std::string mergedDescription(const std::string& command, const std::vector<std::string>& programs, Outputs outputs)
{
  const Element merged = parsed(command);
  std::set<std::string> seen;
  for (const std::string& xml : programs)
  {
    const Element elements = parsed(xml);
    const ModuleDescription program = parseModuleDescription(xml);
    for (vtkXMLDataElement* group : childrenOf(elements))
    {
      if (std::string(group->GetName()) != "parameters" || !keepOptions(group, program, outputs, seen)) continue;
      vtkXMLDataElement* label = group->FindNestedElementWithName("label");
      setText(label, program.title + ": " + label->GetCharacterData());
      merged->AddNestedElement(group);
    }
  }
  std::ostringstream text;
  vtkXMLUtilities::FlattenElement(merged, text);
  return text.str() + "\n";
}

} // namespace surgicalmesher
