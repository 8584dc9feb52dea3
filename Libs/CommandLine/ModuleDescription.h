// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A module's XML description (Slicer's ModuleDescription) as plain data.

#include <optional>
#include <string>
#include <vector>

namespace surgicalmesher
{

struct Parameter
{
  std::string type; ///< the XML element: integer, double, boolean, image, point, ...
  std::string kind; ///< the element's type attribute: label, scalar, color, ...; empty if there is none
  std::string name;
  std::string longFlag; ///< without dashes; empty if there is none
  std::string flag;     ///< one letter, without dash; empty if there is none
  int index = -1;       ///< place among the positional arguments; -1 if it is an option
  std::string label;
  std::string description;
  bool output = false; ///< whether the channel is output
  bool multiple = false;
  std::string defaultValue;
  std::vector<std::string> choices; ///< values of an enumeration
  std::optional<double> minimum, maximum;
  std::vector<std::string> extensions; ///< with their dot, lower case; the first is the usual one

  bool isInteger() const; ///< integer, integer-enumeration
  bool isNumber() const;  ///< double, float, double-enumeration, float-enumeration
  bool isEnumeration() const;
  bool isVector() const;        ///< a comma separated list: integer-vector, double-vector, float-vector, string-vector
  bool isPoint() const;         ///< point (x,y,z) and region (x,y,z,rx,ry,rz)
  bool isFile() const;          ///< any type that is passed as the name of a file or folder
  bool isReturnValue() const;   ///< a simple output, not on the command line but in the return parameter file
  std::string spelling() const; ///< how the user writes it: `--name`, or `name` for a positional argument
};

struct ParameterGroup
{
  std::string label;
  std::string description;
  bool advanced = false;
  std::vector<Parameter> parameters;
};

struct ModuleDescription
{
  std::string category, title, description, version, documentationUrl, license, contributor, acknowledgements;
  std::vector<ParameterGroup> groups;

  const Parameter* find(const std::string& name) const; ///< null if there is none
  std::vector<const Parameter*> parameters() const;     ///< in the order of the XML
  std::vector<const Parameter*> positionals() const;    ///< by index
};

/// Throws std::logic_error, with the parameter's name, for XML that is not a valid description: the XML is part of the
/// program.
ModuleDescription parseModuleDescription(const std::string& xml);

/// Returns in words what a parameter accepts: "a number from 0 to 500", "one of smaller, targets, path".
std::string expectation(const Parameter& parameter);

/// Throws UsageError unless the parameter accepts `value`. Does not check whether an input file exists; its reader
/// does.
void checkValue(const Parameter& parameter, const std::string& value);

/// Returns the text that --help prints.
std::string helpText(const ModuleDescription& description, const std::string& executable);

} // namespace surgicalmesher
