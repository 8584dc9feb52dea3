// SPDX-License-Identifier: Apache-2.0
#include "NastranExport.h"

#include "TextFile.h"
#include "TextNumbers.h"
#include "Units.h"

#include <algorithm>
#include <map>

namespace surgicalmesher
{
namespace
{

constexpr std::size_t kWide = 16; ///< columns of a field in the large-field format (asterisk)
constexpr std::size_t kNarrow = 8;
constexpr std::size_t kFieldsPerLine = 8;

/// Solids and faces by their number of nodes.
const std::map<std::size_t, std::string> kSolids{ { 4, "CTETRA" }, { 6, "CPENTA" }, { 8, "CHEXA" }, { 10, "CTETRA" } };
const std::map<std::size_t, std::string> kFaces{ { 3, "CTRIA3" }, { 4, "CQUAD4" }, { 6, "CTRIA6" } };

std::string field(const std::string& text, std::size_t width)
{
  return text + std::string(width > text.size() ? width - text.size() : 0, ' ');
}

std::string wide(double value) { return field(textWithin(value, kWide), kWide); }

/// Appends a card in the small-field format, on as many lines as needed.
void appendCard(std::string& text, const std::string& name, const std::vector<std::string>& fields)
{
  text += field(name, kNarrow);
  for (std::size_t i = 0; i < fields.size(); ++i)
  {
    // Gmsh requires the mark at the end of the line
    if (i > 0 && i % kFieldsPerLine == 0) text += "+\n" + field("+", kNarrow);
    text += field(fields[i], kNarrow);
  }
  text += "\n";
}

void appendNodes(std::string& text, const std::vector<Vec3>& points)
{
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const Vec3& p = points[i];
    text += "GRID*   " + field(std::to_string(i + 1), kWide) + field("", kWide) + wide(p.x) + wide(p.y) + "\n*       " +
            wide(p.z) + "\n";
  }
}

void appendElement(std::string& text, const std::string& name, std::size_t number, std::size_t property,
                   const Cell& cell)
{
  std::vector<std::string> fields{ std::to_string(number), std::to_string(property) };
  for (const std::int32_t id : cell) fields.push_back(std::to_string(id + 1));
  appendCard(text, name, fields);
}

void appendBar(std::string& text, std::size_t number, std::size_t property, const Beam& beam, const Cell& edge,
               const std::vector<Vec3>& points)
{
  std::vector<std::string> fields{ std::to_string(number), std::to_string(property), std::to_string(edge[0] + 1),
                                   std::to_string(edge[1] + 1) };
  const Vec3 across = axisAcross(edge, points);
  if (!beam.isTruss)
    for (int axis = 0; axis < 3; ++axis) fields.push_back(textWithin(across[axis], kNarrow));
  appendCard(text, beam.isTruss ? "CROD" : "CBAR", fields);
}

/// Property numbers: sections first, then shells, then curves.
void appendElements(std::string& text, const FiniteElementModel& model)
{
  std::vector<std::size_t> property(model.elements.size());
  for (std::size_t s = 0; s < model.sections.size(); ++s)
  {
    for (const std::int32_t e : model.elementSets[model.sections[s].elementSet].elements) property[e] = s + 1;
  }
  for (std::size_t e = 0; e < model.elements.size(); ++e)
    appendElement(text, kSolids.at(model.elements[e].size()), e + 1, property[e], model.elements[e]);
  std::size_t next = model.elements.size();
  for (std::size_t s = 0; s < model.shells.size(); ++s)
  {
    for (const Cell& cell : model.shells[s].cells)
      appendElement(text, kFaces.at(cell.size()), ++next, model.sections.size() + s + 1, cell);
  }
  for (std::size_t b = 0; b < model.beams.size(); ++b)
  {
    const std::size_t number = model.sections.size() + model.shells.size() + b + 1;
    for (const Cell& edge : model.beams[b].edges)
      appendBar(text, ++next, number, model.beams[b], edge, model.content.mesh.points);
  }
}

/// Appends the property of a round section. A rod has only a torsional constant.
void appendBarProperty(std::string& text, std::size_t number, const Beam& beam)
{
  const double moment = secondMomentOfArea(beam);
  const std::string begin =
    field(std::to_string(number), kWide) + field(std::to_string(beam.material + 1), kWide) + wide(sectionArea(beam));
  text += "$ " + beam.name + "\n";
  if (beam.isTruss) text += "PROD*   " + begin + wide(0) + "\n*\n"; // large-field cards have an even number of lines
  else text += "PBAR*   " + begin + wide(moment) + "\n*       " + wide(moment) + wide(2 * moment) + "\n";
}

void appendProperties(std::string& text, const FiniteElementModel& model)
{
  std::size_t next = 0;
  for (const Section& section : model.sections)
  {
    text += "$ " + model.elementSets[section.elementSet].name + "\n";
    appendCard(text, "PSOLID", { std::to_string(++next), std::to_string(section.material + 1) });
  }
  for (const Shell& shell : model.shells)
  {
    const std::string material = field(std::to_string(shell.material + 1), kWide);
    text += "$ " + shell.name + "\nPSHELL* " + field(std::to_string(++next), kWide) + material + wide(shell.thickness) +
            material + "\n*       " + field("", kWide) + material + "\n";
  }
  for (const Beam& beam : model.beams) appendBarProperty(text, ++next, beam);
  for (std::size_t m = 0; m < model.materials.size(); ++m)
  {
    const Material& material = model.materials[m];
    text += "$ " + material.name + "\nMAT1*   " + field(std::to_string(m + 1), kWide) + wide(material.youngsModulus) +
            field("", kWide) + wide(material.poissonsRatio) + "\n*       " + wide(material.density) + "\n";
  }
}

void appendNodeSets(std::string& text, const FiniteElementModel& model)
{
  for (std::size_t s = 0; s < model.nodeSets.size(); ++s)
  {
    std::vector<std::string> ids;
    for (const std::int32_t id : model.nodeSets[s].points) ids.push_back(std::to_string(id + 1));
    text += "$ " + model.nodeSets[s].name + "\n";
    if (model.nodeSets[s].kind == SetKind::NullDisplacement)
    {
      std::vector<std::string> clamp{ "1", "123" };
      clamp.insert(clamp.end(), ids.begin(), ids.end());
      appendCard(text, "SPC1", clamp);
    }
    ids.insert(ids.begin(), std::to_string(s + 1));
    appendCard(text, "SET1", ids);
  }
}

} // namespace

void writeNastran(const FiniteElementModel& model, const std::string& file, const Destination& destination)
{
  const bool isHeld = std::any_of(model.nodeSets.begin(), model.nodeSets.end(),
                                  [](const NodeSet& set) { return set.kind == SetKind::NullDisplacement; });
  std::string text = "$ " + frameAndUnits(model) + "\nSOL 101\nCEND\n" + (isHeld ? "SPC = 1\n" : "") + "BEGIN BULK\n";
  appendNodes(text, model.content.mesh.points);
  appendElements(text, model);
  appendProperties(text, model);
  appendNodeSets(text, model);
  writeBytes(text + "ENDDATA\n", destination(file));
}

} // namespace surgicalmesher
