// SPDX-License-Identifier: Apache-2.0
#include "LsDynaExport.h"

#include "Portions.h"
#include "TextFile.h"
#include "TextNumbers.h"
#include "Units.h"

#include <algorithm>
#include <map>

namespace surgicalmesher
{
namespace
{

constexpr std::size_t kElementColumns = 8; ///< per number in nodes and elements
constexpr std::size_t kColumns = 10;       ///< elsewhere
constexpr std::size_t kCoordinateColumns = 16;
constexpr std::size_t kIdsPerLine = 8;
constexpr std::size_t kShellForm = 16;
constexpr std::size_t kBeamForm = 1, kTrussForm = 3;

/// Formulation of solids with a given number of nodes, and their corners in the order of a hexahedron whose nodes may
/// coincide.
struct Solid
{
  std::size_t form;
  std::vector<int> order;
};

const std::map<std::size_t, Solid> kSolids{ { 4, { 10, { 0, 1, 2, 3, 3, 3, 3, 3 } } },
                                            { 6, { 15, { 1, 0, 3, 4, 2, 2, 5, 5 } } },
                                            { 8, { 1, { 0, 1, 2, 3, 4, 5, 6, 7 } } },
                                            { 10, { 16, { 0, 1, 2, 3, 4, 5, 6, 7, 8, 9 } } } };

/// The elements of one shape in a section.
struct Part
{
  Portion portion;
  std::int32_t material;
};

std::vector<Part> partsOf(const FiniteElementModel& model)
{
  std::vector<Part> parts;
  for (const Section& section : model.sections)
  {
    for (Portion& portion : portionsOf(model, model.elementSets[section.elementSet]))
      parts.push_back({ std::move(portion), section.material });
  }
  return parts;
}

/// Divides a face into faces of at most four nodes.
std::vector<Cell> linear(const Cell& face)
{
  if (face.size() != 6) return { face };
  return { { face[0], face[3], face[5] },
           { face[3], face[1], face[4] },
           { face[5], face[4], face[2] },
           { face[3], face[4], face[5] } };
}

std::string right(const std::string& text, std::size_t width)
{
  return std::string(width > text.size() ? width - text.size() : 0, ' ') + text;
}

std::string whole(std::size_t number, std::size_t width = kColumns) { return right(std::to_string(number), width); }
std::string real(double number) { return right(textWithin(number, kColumns), kColumns); }

/// Returns the four nodes of a face; the last node of a triangle is repeated.
std::string nodesOfFace(const Cell& face, std::size_t width)
{
  std::string text;
  for (std::size_t i = 0; i < 4; ++i) text += whole(std::size_t(face[std::min(i, face.size() - 1)]) + 1, width);
  return text;
}

void appendIds(std::string& text, const std::vector<std::int32_t>& ids)
{
  for (std::size_t i = 0; i < ids.size(); ++i)
  {
    text += whole(std::size_t(ids[i]) + 1);
    if (i + 1 == ids.size() || (i + 1) % kIdsPerLine == 0) text += "\n";
  }
}

void appendNodes(std::string& text, const std::vector<Vec3>& points)
{
  const auto coordinate = [](double x) { return right(textWithin(x, kCoordinateColumns), kCoordinateColumns); };
  text += "*NODE\n";
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const Vec3& p = points[i];
    text += whole(i + 1, kElementColumns) + coordinate(p.x) + coordinate(p.y) + coordinate(p.z) + "\n";
  }
}

/// Ten-node elements have their nodes on a separate line.
void appendSolids(std::string& text, const FiniteElementModel& model, const std::vector<Part>& parts)
{
  std::vector<std::size_t> part(model.elements.size());
  for (std::size_t p = 0; p < parts.size(); ++p)
    for (const std::int32_t e : parts[p].portion.elements) part[e] = p + 1;
  text += "*ELEMENT_SOLID\n";
  for (std::size_t e = 0; e < model.elements.size(); ++e)
  {
    const Cell& element = model.elements[e];
    text += whole(e + 1, kElementColumns) + whole(part[e], kElementColumns);
    if (element.size() == 10) text += "\n";
    for (const int corner : kSolids.at(element.size()).order)
      text += whole(std::size_t(element[corner]) + 1, kElementColumns);
    text += "\n";
  }
}

/// Returns the last element number. A second-order face becomes several shells.
std::size_t appendShells(std::string& text, const FiniteElementModel& model, std::size_t firstPart)
{
  if (!model.shells.empty()) text += "*ELEMENT_SHELL\n";
  std::size_t next = model.elements.size();
  for (std::size_t s = 0; s < model.shells.size(); ++s)
  {
    for (const Cell& cell : model.shells[s].cells)
    {
      for (const Cell& face : linear(cell))
        text += whole(++next, kElementColumns) + whole(firstPart + s, kElementColumns) +
                nodesOfFace(face, kElementColumns) + "\n";
    }
  }
  return next;
}

/// Appends beams with an orientation vector instead of a third node; trusses need none.
void appendBeams(std::string& text, const FiniteElementModel& model, std::size_t firstPart, std::size_t lastNumber)
{
  const std::vector<Vec3>& points = model.content.mesh.points;
  if (!model.beams.empty()) text += model.beams[0].isTruss ? "*ELEMENT_BEAM\n" : "*ELEMENT_BEAM_ORIENTATION\n";
  for (std::size_t b = 0; b < model.beams.size(); ++b)
  {
    for (const Cell& edge : model.beams[b].edges)
    {
      text += whole(++lastNumber, kElementColumns) + whole(firstPart + b, kElementColumns) +
              whole(std::size_t(edge[0]) + 1, kElementColumns) + whole(std::size_t(edge[1]) + 1, kElementColumns) +
              "\n";
      const Vec3 across = axisAcross(edge, points);
      if (!model.beams[b].isTruss) text += real(across.x) + real(across.y) + real(across.z) + "\n";
    }
  }
}

/// For a beam, writes the outer and inner diameters at both ends, for a truss its area. The shear area of a round
/// section is 0.9 of its area.
void appendBeamSection(std::string& text, const Beam& beam, std::size_t number)
{
  const double diameter = 2 * beam.radius;
  text += "*SECTION_BEAM\n" + whole(number) + whole(beam.isTruss ? kTrussForm : kBeamForm);
  if (beam.isTruss) text += "\n" + real(sectionArea(beam)) + "\n";
  else text += real(0.9) + whole(2) + real(1) + "\n" + real(diameter) + real(diameter) + real(0) + real(0) + "\n";
}

/// Every part has a section of its own with the same number.
void appendPart(std::string& text, const std::string& name, std::size_t number, std::int32_t material)
{
  text += "*PART\n" + name + "\n" + whole(number) + whole(number) + whole(std::size_t(material) + 1) + "\n";
}

void appendParts(std::string& text, const FiniteElementModel& model, const std::vector<Part>& parts)
{
  std::size_t next = 0;
  for (const Part& part : parts)
  {
    const Cell& element = model.elements[part.portion.elements.front()];
    appendPart(text, part.portion.name, ++next, part.material);
    text += "*SECTION_SOLID\n" + whole(next) + whole(kSolids.at(element.size()).form) + "\n";
  }
  for (const Shell& shell : model.shells)
  {
    appendPart(text, shell.name, ++next, shell.material);
    text += "*SECTION_SHELL\n" + whole(next) + whole(kShellForm) + "\n";
    for (int corner = 0; corner < 4; ++corner) text += real(shell.thickness);
    text += "\n";
  }
  for (const Beam& beam : model.beams)
  {
    appendPart(text, beam.name, ++next, beam.material);
    appendBeamSection(text, beam, next);
  }
}

/// Ogden's law with a single term of exponent 2 is the neo-Hookean law; its coefficient is the shear modulus.
void appendMaterials(std::string& text, const std::vector<Material>& materials)
{
  for (std::size_t m = 0; m < materials.size(); ++m)
  {
    const Material& material = materials[m];
    const std::string begin = "_TITLE\n" + material.name + "\n" + whole(m + 1) + real(material.density);
    const double E = material.youngsModulus;
    const double nu = std::min(material.poissonsRatio, 0.49999999); // values closer to 0.5 would be rounded to 0.5
    if (material.law == MaterialLaw::LinearElastic) text += "*MAT_ELASTIC" + begin + real(E) + real(nu) + "\n";
    else
      text +=
        "*MAT_OGDEN_RUBBER" + begin + real(nu) + whole(0) + "\n" + real(E / (2 * (1 + nu))) + "\n" + real(2) + "\n";
  }
}

void appendSets(std::string& text, const FiniteElementModel& model)
{
  const auto begin = [&](const char* keyword, const std::string& name, std::size_t number)
  { text += std::string(keyword) + "_TITLE\n" + name + "\n" + whole(number) + "\n"; };
  for (std::size_t s = 0; s < model.elementSets.size(); ++s)
  {
    begin("*SET_SOLID", model.elementSets[s].name, s + 1);
    appendIds(text, model.elementSets[s].elements);
  }
  for (std::size_t s = 0; s < model.surfaces.size(); ++s)
  {
    begin("*SET_SEGMENT", model.surfaces[s].name, s + 1);
    for (const Cell& cell : model.surfaces[s].cells)
      for (const Cell& face : linear(cell)) text += nodesOfFace(face, kColumns) + "\n";
  }
  for (std::size_t s = 0; s < model.nodeSets.size(); ++s)
  {
    begin("*SET_NODE_LIST", model.nodeSets[s].name, s + 1);
    appendIds(text, model.nodeSets[s].points);
    if (model.nodeSets[s].kind == SetKind::NullDisplacement)
      text += "*BOUNDARY_SPC_SET\n" + whole(s + 1) + whole(0) + whole(1) + whole(1) + whole(1) + "\n";
  }
}

} // namespace

void writeLsDyna(const FiniteElementModel& model, const std::string& file, const Destination& destination)
{
  const std::vector<Part> parts = partsOf(model);
  std::string text = "*KEYWORD\n$ " + frameAndUnits(model) + "\n";
  appendNodes(text, model.content.mesh.points);
  appendSolids(text, model, parts);
  const std::size_t last = appendShells(text, model, parts.size() + 1);
  appendBeams(text, model, parts.size() + model.shells.size() + 1, last);
  appendParts(text, model, parts);
  appendMaterials(text, model.materials);
  appendSets(text, model);
  writeBytes(text + "*END\n", destination(file));
}

} // namespace surgicalmesher
