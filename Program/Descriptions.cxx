// SPDX-License-Identifier: Apache-2.0
#include "Descriptions.h"

#include <vtkSmartPointer.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLUtilities.h>

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

void makeText(vtkXMLDataElement* output)
{
  output->SetName("string");
  output->RemoveAttribute("fileExtensions");
  output->RemoveNestedElement(output->FindNestedElementWithName("channel"));
}

/// Takes away what is not the user's to give here; whether anything is left.
bool keepOptions(vtkXMLDataElement* group, std::set<std::string>& seen)
{
  bool isUsed = false;
  for (vtkXMLDataElement* parameter : childrenOf(group))
  {
    const std::string name = childText(parameter, "name");
    if (name.empty()) continue; // the group's label and description
    const bool isOption = parameter->FindNestedElementWithName("longflag") && !stageOptions().count(name);
    if (!isOption || !seen.insert(name).second) group->RemoveNestedElement(parameter);
    else
    {
      isUsed = true;
      if (childText(parameter, "channel") == "output") makeText(parameter);
    }
  }
  return isUsed;
}

} // namespace

const std::set<std::string>& stageOptions()
{
  static const std::set<std::string> options{ "scale",          "edgeLength", "ambient",  "preparedLabelMap",
                                              "outputLabelMap", "report",     "channel2", "channel3" };
  return options;
}

std::string mergedDescription(const std::string& command, const std::vector<std::string>& programs)
{
  const Element merged = parsed(command);
  std::set<std::string> seen;
  for (const std::string& xml : programs)
  {
    const Element program = parsed(xml);
    for (vtkXMLDataElement* group : childrenOf(program))
    {
      if (std::string(group->GetName()) != "parameters" || !keepOptions(group, seen)) continue;
      vtkXMLDataElement* label = group->FindNestedElementWithName("label");
      const std::string title = childText(program, "title") + ": " + label->GetCharacterData();
      label->SetCharacterData(title.c_str(), int(title.size()));
      merged->AddNestedElement(group);
    }
  }
  std::ostringstream text;
  vtkXMLUtilities::FlattenElement(merged, text);
  return text.str() + "\n";
}

} // namespace surgicalmesher
