// SPDX-License-Identifier: Apache-2.0
#include "ShellChoices.h"

#include "Errors.h"
#include "TextFile.h"
#include "TissueMapIO.h"

#include <optional>

namespace surgicalmesher
{
namespace
{

/// Parses one shell; returns nothing if the text is no shell. Names may contain colons.
std::optional<ShellChoice> findShell(const std::string& text, const TissueTable& names, const std::set<Label>& present)
{
  ShellChoice choice;
  const auto isTissue = [&](const std::string& name, Label& label)
  { return findTissue(name, names, label) && present.count(label) > 0; };
  if (isTissue(text, choice.label)) return choice;
  for (std::size_t colon = text.find(':'); colon != text.npos; colon = text.find(':', colon + 1))
  {
    const std::string neighbour = text.substr(colon + 1);
    Label other = 0;
    const bool known = neighbour == "outside" || neighbour == "0" || isTissue(neighbour, other);
    if (!known || !isTissue(text.substr(0, colon), choice.label)) continue;
    choice.neighbour = other;
    return choice;
  }
  return {};
}

} // namespace

std::vector<ShellChoice> shellChoices(const std::vector<std::string>& texts, const TissueTable& names,
                                      const std::set<Label>& present, double thickness)
{
  std::vector<ShellChoice> choices;
  if (texts.empty())
  {
    for (const auto& [label, tissue] : names)
      if (tissue.isShell && present.count(label) > 0) choices.push_back({ label, -1, thickness });
  }
  for (const std::string& text : texts)
  {
    const bool isOne = findShell(text, names, present).has_value();
    for (const std::string& shell : isOne ? std::vector<std::string>{ text } : text::splitFields(text))
    {
      const std::optional<ShellChoice> choice = findShell(shell, names, present);
      if (!choice)
        throw UsageError("--shell: \"" + shell +
                         "\" found, TISSUE or TISSUE:NEIGHBOUR with labels of the mesh's tissues, or names that one of "
                         "them has alone, expected");
      choices.push_back(*choice);
      choices.back().thickness = thickness;
    }
  }
  return choices;
}

} // namespace surgicalmesher
