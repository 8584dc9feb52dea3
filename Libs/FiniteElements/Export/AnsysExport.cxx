// SPDX-License-Identifier: Apache-2.0
#include "AnsysExport.h"

#include "SetNames.h"
#include "TextFile.h"
#include "TextNumbers.h"
#include "Units.h"

#include <map>
#include <numeric>

namespace surgicalmesher
{
namespace
{

constexpr std::size_t kLongestComponent = 32;
constexpr std::size_t kNodeColumns = 9, kIdColumns = 10;
constexpr std::size_t kIdsPerLine = 8; ///< in components, and in the first line of an element's nodes
constexpr std::size_t kCoordinateColumns = 21;

/// An element type and the order of its nodes; some elements are degenerate forms of types with more nodes.
struct Type
{
  int number;
  std::vector<int> order;
};

const std::map<std::size_t, Type> kSolids{ { 4, { 285, { 0, 1, 2, 3 } } },
                                           { 6, { 185, { 0, 1, 2, 2, 3, 4, 5, 5 } } },
                                           { 8, { 185, { 0, 1, 2, 3, 4, 5, 6, 7 } } },
                                           { 10, { 187, { 0, 1, 2, 3, 4, 5, 6, 7, 8, 9 } } } };
const std::map<std::size_t, Type> kFaces{ { 3, { 181, { 0, 1, 2, 2 } } },
                                          { 4, { 181, { 0, 1, 2, 3 } } },
                                          { 6, { 281, { 0, 1, 2, 2, 3, 4, 2, 5 } } } };
const Type kBeam{ 188, { 0, 1 } }, kTruss{ 180, { 0, 1 } };

const Type& typeOf(const Beam& beam) { return beam.isTruss ? kTruss : kBeam; }

std::string right(const std::string& text, std::size_t width)
{
  return std::string(width > text.size() ? width - text.size() : 0, ' ') + text;
}

std::string whole(std::size_t number, std::size_t width) { return right(std::to_string(number), width); }

/// The numbers of the element types that occur, counted from 1, by Ansys's own numbers.
using Types = std::map<int, std::size_t>;

Types typesOf(const FiniteElementModel& model)
{
  Types types;
  for (const Cell& element : model.elements) types[kSolids.at(element.size()).number];
  for (const Shell& shell : model.shells)
    for (const Cell& cell : shell.cells) types[kFaces.at(cell.size()).number];
  for (const Beam& beam : model.beams) types[typeOf(beam).number];
  std::size_t next = 0;
  for (auto& [type, number] : types) number = ++next;
  return types;
}

void appendTypes(std::string& text, const Types& types)
{
  for (const auto& [type, number] : types) text += "ET," + std::to_string(number) + "," + std::to_string(type) + "\n";
}

void appendNodes(std::string& text, const std::vector<Vec3>& points)
{
  const auto coordinate = [](double x) { return right(textWithin(x, kCoordinateColumns - 1), kCoordinateColumns); };
  const std::string count = std::to_string(points.size());
  text += "NBLOCK,6,SOLID," + count + "," + count + "\n(3i9,6e21.13e3)\n";
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const Vec3& p = points[i];
    text += whole(i + 1, kNodeColumns) + whole(0, kNodeColumns) + whole(0, kNodeColumns) + coordinate(p.x) +
            coordinate(p.y) + coordinate(p.z) + "\n";
  }
  text += "N,R5.3,LOC,       -1,\n";
}

/// The fields of an element's line before its nodes.
struct Head
{
  std::size_t number, type, material, section;
};

void appendElement(std::string& text, const Head& head, const std::vector<int>& order, const Cell& cell)
{
  for (const std::size_t field :
       { head.material, head.type, std::size_t(1), head.section, std::size_t(0), std::size_t(0), std::size_t(0),
         std::size_t(0), order.size(), std::size_t(0), head.number })
    text += whole(field, kNodeColumns);
  for (std::size_t i = 0; i < order.size(); ++i)
  {
    if (i == kIdsPerLine) text += "\n";
    text += whole(std::size_t(cell[order[i]]) + 1, kNodeColumns);
  }
  text += "\n";
}

/// Section numbers: 1 is undefined, as solids need no section; then follow those of shells, then those of curves.
std::size_t sectionOfShell(std::size_t shell) { return shell + 2; }
std::size_t sectionOfBeam(const FiniteElementModel& model, std::size_t beam)
{
  return sectionOfShell(model.shells.size()) + beam;
}

void appendElements(std::string& text, const FiniteElementModel& model, const Types& types)
{
  std::vector<std::size_t> material(model.elements.size());
  for (const Section& section : model.sections)
    for (const std::int32_t e : model.elementSets[section.elementSet].elements)
      material[e] = std::size_t(section.material) + 1;
  std::size_t count = model.elements.size();
  for (const Shell& shell : model.shells) count += shell.cells.size();
  for (const Beam& beam : model.beams) count += beam.edges.size();
  text += "EBLOCK,19,SOLID," + std::to_string(count) + "," + std::to_string(count) + "\n(19i9)\n";
  std::size_t next = 0;
  for (const Cell& element : model.elements)
  {
    const Type& type = kSolids.at(element.size());
    appendElement(text, { next + 1, types.at(type.number), material[next], 1 }, type.order, element);
    ++next;
  }
  for (std::size_t s = 0; s < model.shells.size(); ++s)
  {
    for (const Cell& cell : model.shells[s].cells)
    {
      const Type& type = kFaces.at(cell.size());
      appendElement(text,
                    { ++next, types.at(type.number), std::size_t(model.shells[s].material) + 1, sectionOfShell(s) },
                    type.order, cell);
    }
  }
  for (std::size_t b = 0; b < model.beams.size(); ++b)
  {
    const Beam& beam = model.beams[b];
    const Type& type = typeOf(beam);
    for (const Cell& edge : beam.edges)
      appendElement(text, { ++next, types.at(type.number), std::size_t(beam.material) + 1, sectionOfBeam(model, b) },
                    type.order, edge);
  }
  text += right("-1", kNodeColumns) + "\n";
}

/// For a neo-Hookean material, the constants are the shear modulus and two over the bulk modulus.
void appendMaterials(std::string& text, const std::vector<Material>& materials)
{
  for (std::size_t m = 0; m < materials.size(); ++m)
  {
    const Material& material = materials[m];
    const std::string number = std::to_string(m + 1);
    const double E = material.youngsModulus, nu = material.poissonsRatio;
    text += "/COM, " + material.name + "\n";
    if (material.law == MaterialLaw::LinearElastic)
      text += "MP,EX," + number + "," + textOf(E) + "\nMP,PRXY," + number + "," + textOf(nu) + "\n";
    else
      text += "TB,HYPER," + number + ",1,2,NEO\nTBDATA,1," + textOf(E / (2 * (1 + nu))) + "," +
              textOf(6 * (1 - 2 * nu) / E) + "\n";
    text += "MP,DENS," + number + "," + textOf(material.density) + "\n";
  }
}

void appendSections(std::string& text, const FiniteElementModel& model)
{
  for (std::size_t s = 0; s < model.shells.size(); ++s)
  {
    text += "SECTYPE," + std::to_string(sectionOfShell(s)) + ",SHELL,," + validName(model.shells[s].name, 8) +
            "\nSECDATA," + textOf(model.shells[s].thickness) + "," + std::to_string(model.shells[s].material + 1) +
            "\n";
  }
  for (std::size_t b = 0; b < model.beams.size(); ++b) // the radius of a beam, the area of a truss
  {
    const Beam& beam = model.beams[b];
    text += "SECTYPE," + std::to_string(sectionOfBeam(model, b)) + (beam.isTruss ? ",LINK,," : ",BEAM,CSOLID,") +
            validName(beam.name, 8) + "\nSECDATA," + textOf(beam.isTruss ? sectionArea(beam) : beam.radius) + "\n";
  }
}

void appendComponent(std::string& text, const std::string& name, const char* kind, const std::vector<std::int32_t>& ids)
{
  text += "CMBLOCK," + name + "," + kind + "," + whole(ids.size(), kIdColumns) + "\n(8i10)\n";
  for (std::size_t i = 0; i < ids.size(); ++i)
  {
    text += whole(std::size_t(ids[i]) + 1, kIdColumns);
    if (i + 1 == ids.size() || (i + 1) % kIdsPerLine == 0) text += "\n";
  }
}

void appendComponents(std::string& text, const FiniteElementModel& model)
{
  SetNames names(kLongestComponent);
  for (const ElementSet& set : model.elementSets) appendComponent(text, names.unique(set.name), "ELEM", set.elements);
  std::int32_t next = static_cast<std::int32_t>(model.elements.size());
  for (const Shell& shell : model.shells)
  {
    std::vector<std::int32_t> ids;
    for (std::size_t i = 0; i < shell.cells.size(); ++i) ids.push_back(next++);
    appendComponent(text, names.unique(shell.name), "ELEM", ids);
  }
  for (const Beam& beam : model.beams)
  {
    std::vector<std::int32_t> ids(beam.edges.size());
    std::iota(ids.begin(), ids.end(), next);
    next += static_cast<std::int32_t>(ids.size());
    appendComponent(text, names.unique(beam.name), "ELEM", ids);
  }
  for (const NodeSet& set : model.nodeSets)
  {
    const std::string name = names.unique(set.name);
    appendComponent(text, name, "NODE", set.points);
    if (set.kind == SetKind::NullDisplacement)
      text += "CMSEL,S," + name + ",NODE\nD,ALL,UX,0\nD,ALL,UY,0\nD,ALL,UZ,0\nALLSEL,ALL\n";
  }
}

} // namespace

void writeAnsys(const FiniteElementModel& model, const std::string& file, const Destination& destination)
{
  const Types types = typesOf(model);
  std::string text = "/COM, " + frameAndUnits(model) + "\n/PREP7\n";
  appendTypes(text, types);
  appendMaterials(text, model.materials);
  appendSections(text, model);
  appendNodes(text, model.content.mesh.points);
  appendElements(text, model, types);
  appendComponents(text, model);
  writeBytes(text + "FINISH\n", destination(file));
}

} // namespace surgicalmesher
