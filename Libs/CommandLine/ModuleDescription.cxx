// SPDX-License-Identifier: Apache-2.0
#include "ModuleDescription.h"

#include "Errors.h"
#include "Text.h"

#include <vtkSmartPointer.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLUtilities.h>

#include <algorithm>
#include <limits>
#include <set>
#include <stdexcept>

namespace surgicalmesher
{

namespace
{

bool isOneOf(const std::string& word, std::initializer_list<const char*> words)
{
  return std::find(words.begin(), words.end(), word) != words.end();
}

[[noreturn]] void refuse(const std::string& what) { throw std::logic_error("module description: " + what); }

std::string childText(vtkXMLDataElement* element, const char* name)
{
  vtkXMLDataElement* child = element->FindNestedElementWithName(name);
  return child && child->GetCharacterData() ? text::trimmed(child->GetCharacterData()) : std::string();
}

std::string attribute(vtkXMLDataElement* element, const char* name)
{
  const char* value = element->GetAttribute(name);
  return value ? value : "";
}

std::string withoutDashes(const std::string& flag)
{
  const std::size_t start = flag.find_first_not_of('-');
  return start == std::string::npos ? std::string() : flag.substr(start);
}

std::optional<double> limit(vtkXMLDataElement* constraints, const char* name)
{
  const std::string text = constraints ? childText(constraints, name) : std::string();
  if (text.empty()) return {};
  double value = 0;
  if (!text::parseNumber(text, value)) refuse(std::string(name) + " '" + text + "' is not a number");
  return value;
}

Parameter readParameter(vtkXMLDataElement* element)
{
  Parameter parameter;
  parameter.type = element->GetName();
  parameter.kind = attribute(element, "type");
  parameter.name = childText(element, "name");
  parameter.longFlag = withoutDashes(childText(element, "longflag"));
  parameter.flag = withoutDashes(childText(element, "flag"));
  parameter.label = childText(element, "label");
  parameter.description = childText(element, "description");
  parameter.output = childText(element, "channel") == "output";
  parameter.multiple = attribute(element, "multiple") == "true";
  parameter.defaultValue = childText(element, "default");
  const std::string index = childText(element, "index");
  if (long number = -1; !index.empty())
  {
    text::parseInteger(index, 0, std::numeric_limits<int>::max(), number);
    parameter.index = int(number);
  }
  vtkXMLDataElement* constraints = element->FindNestedElementWithName("constraints");
  parameter.minimum = limit(constraints, "minimum");
  parameter.maximum = limit(constraints, "maximum");
  for (const std::string& extension : text::split(attribute(element, "fileExtensions"), ','))
  {
    parameter.extensions.push_back(text::lowerCase(text::trimmed(extension)));
  }
  for (int i = 0; i < element->GetNumberOfNestedElements(); ++i)
  {
    vtkXMLDataElement* child = element->GetNestedElement(i);
    if (std::string(child->GetName()) == "element")
      parameter.choices.push_back(text::trimmed(child->GetCharacterData()));
  }
  return parameter;
}

void checkParameter(const Parameter& parameter)
{
  const bool known = parameter.isInteger() || parameter.isNumber() || parameter.isEnumeration() ||
                     parameter.isVector() || parameter.isPoint() || parameter.isFile() ||
                     isOneOf(parameter.type, { "boolean", "string" });
  if (!known) refuse("unknown type '" + parameter.type + "'");
  if (parameter.name.empty()) refuse("a parameter of type " + parameter.type + " has no name");
  const std::string who = "parameter '" + parameter.name + "' ";
  if (parameter.label.empty() || parameter.description.empty()) refuse(who + "lacks a label or a description");
  if (parameter.longFlag.empty() && parameter.flag.empty() && parameter.index < 0 && !parameter.isReturnValue())
  {
    refuse(who + "has neither a longflag, a flag nor an index");
  }
  if (parameter.isEnumeration() && parameter.choices.empty()) refuse(who + "has no element to choose from");
  if (parameter.type == "boolean")
  {
    if (!isOneOf(parameter.defaultValue, { "", "true", "false" }))
      refuse(who + "has a default other than true or false");
    if (parameter.index >= 0) refuse(who + "is a boolean with an index");
  }
  else if (!parameter.defaultValue.empty())
  {
    try
    {
      checkValue(parameter, parameter.defaultValue);
    }
    catch (const UsageError& error)
    {
      refuse(std::string("default of ") + error.what());
    }
  }
  else if (parameter.index < 0 && (parameter.isInteger() || parameter.isNumber() || parameter.isEnumeration()))
  {
    refuse(who + "has no default");
  }
}

void checkUnique(const ModuleDescription& description)
{
  std::set<std::string> seen;
  for (const Parameter* parameter : description.parameters())
  {
    const bool flagless = parameter->longFlag.empty();
    if (!seen.insert("name " + parameter->name).second ||
        (!flagless && !seen.insert("--" + parameter->longFlag).second) ||
        (!parameter->flag.empty() && !seen.insert("-" + parameter->flag).second))
    {
      refuse("two parameters share the name or the flag of '" + parameter->name + "'");
    }
  }
  const std::vector<const Parameter*> positionals = description.positionals();
  for (std::size_t i = 0; i < positionals.size(); ++i)
  {
    if (positionals[i]->index != int(i)) refuse("the indices of positional arguments are not 0, 1, ...");
    if (positionals[i]->multiple && i + 1 < positionals.size())
      refuse("only the last positional argument can be multiple");
  }
}

ParameterGroup readGroup(vtkXMLDataElement* element)
{
  ParameterGroup group;
  group.label = childText(element, "label");
  group.description = childText(element, "description");
  group.advanced = attribute(element, "advanced") == "true";
  for (int i = 0; i < element->GetNumberOfNestedElements(); ++i)
  {
    vtkXMLDataElement* child = element->GetNestedElement(i);
    if (isOneOf(child->GetName(), { "label", "description" })) continue;
    group.parameters.push_back(readParameter(child));
  }
  return group;
}

} // namespace

bool Parameter::isInteger() const { return isOneOf(type, { "integer", "integer-enumeration" }); }
bool Parameter::isNumber() const
{
  return isOneOf(type, { "double", "float", "double-enumeration", "float-enumeration" });
}
bool Parameter::isEnumeration() const
{
  return isOneOf(type, { "string-enumeration", "integer-enumeration", "double-enumeration", "float-enumeration" });
}
bool Parameter::isVector() const
{
  return isOneOf(type, { "integer-vector", "double-vector", "float-vector", "string-vector" });
}
bool Parameter::isPoint() const { return isOneOf(type, { "point", "region" }); }
bool Parameter::isFile() const
{
  return isOneOf(type, { "file", "directory", "image", "geometry", "table", "transform", "measurement", "pointfile" });
}
bool Parameter::isReturnValue() const { return output && !isFile() && index < 0 && longFlag.empty() && flag.empty(); }
std::string Parameter::spelling() const
{
  if (!longFlag.empty()) return "--" + longFlag;
  return flag.empty() ? name : "-" + flag;
}

const Parameter* ModuleDescription::find(const std::string& name) const
{
  for (const Parameter* parameter : parameters())
  {
    if (parameter->name == name) return parameter;
  }
  return nullptr;
}

std::vector<const Parameter*> ModuleDescription::parameters() const
{
  std::vector<const Parameter*> all;
  for (const ParameterGroup& group : groups)
  {
    for (const Parameter& parameter : group.parameters) all.push_back(&parameter);
  }
  return all;
}

std::vector<const Parameter*> ModuleDescription::positionals() const
{
  std::vector<const Parameter*> indexed;
  for (const Parameter* parameter : parameters())
  {
    if (parameter->index >= 0) indexed.push_back(parameter);
  }
  std::sort(indexed.begin(), indexed.end(), [](auto a, auto b) { return a->index < b->index; });
  return indexed;
}

ModuleDescription parseModuleDescription(const std::string& xml)
{
  const auto root = vtkSmartPointer<vtkXMLDataElement>::Take(vtkXMLUtilities::ReadElementFromString(xml.c_str()));
  if (!root || std::string(root->GetName()) != "executable") refuse("not XML with the root element 'executable'");

  ModuleDescription description;
  description.category = childText(root, "category");
  description.title = childText(root, "title");
  description.description = childText(root, "description");
  description.version = childText(root, "version");
  description.documentationUrl = childText(root, "documentation-url");
  description.license = childText(root, "license");
  description.contributor = childText(root, "contributor");
  description.acknowledgements = childText(root, "acknowledgements");
  for (int i = 0; i < root->GetNumberOfNestedElements(); ++i)
  {
    vtkXMLDataElement* child = root->GetNestedElement(i);
    if (std::string(child->GetName()) == "parameters") description.groups.push_back(readGroup(child));
  }
  if (description.title.empty() || description.version.empty()) refuse("title or version is missing");
  for (const Parameter* parameter : description.parameters()) checkParameter(*parameter);
  checkUnique(description);
  return description;
}

} // namespace surgicalmesher
