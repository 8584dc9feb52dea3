// SPDX-License-Identifier: Apache-2.0
#include "AbaqusExport.h"

#include "TextFile.h"
#include "TextNumbers.h"
#include "Units.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace surgicalmesher
{
namespace
{

constexpr std::size_t kNumberLength = 20; ///< length of a data field that CalculiX reads
constexpr std::size_t kIdsPerLine = 16;

/// Abaqus's number of the face opposite each corner: S1 has the corners 1-2-3, S2 1-4-2, S3 2-4-3, S4 3-4-1.
constexpr int kFaceNumber[4] = { 3, 4, 2, 1 };

int faceNumber(const Cell& element, int face)
{
  return element.size() == 4 || element.size() == 10 ? kFaceNumber[face] : face + 1;
}

std::string number(double value) { return textOf(value, kNumberLength); }

/// Appends one card for the cells of each type that occurs; each cell with its number, counted from `first`, and its
/// nodes.
void appendCells(std::string& text, const std::vector<Cell>& cells, std::size_t first, const std::string& set,
                 const std::map<std::size_t, std::string>& types)
{
  for (const auto& [size, type] : types)
  {
    bool begun = false;
    for (std::size_t i = 0; i < cells.size(); ++i)
    {
      if (cells[i].size() != size) continue;
      if (!begun) text += "*ELEMENT, TYPE=" + type + ", ELSET=" + set + "\n";
      begun = true;
      text += std::to_string(first + i);
      for (const std::int32_t id : cells[i]) text += ", " + std::to_string(id + 1);
      text += "\n";
    }
  }
}

void appendNodes(std::string& text, const std::vector<Vec3>& points)
{
  text += "*NODE, NSET=all_nodes\n";
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const Vec3& p = points[i];
    text += std::to_string(i + 1) + ", " + number(p.x) + ", " + number(p.y) + ", " + number(p.z) + "\n";
  }
}

void appendElements(std::string& text, const FiniteElementModel& model)
{
  appendCells(text, model.elements, 1, "all_elements",
              { { 4, "C3D4" }, { 6, "C3D6" }, { 8, "C3D8" }, { 10, "C3D10" } });
  std::size_t first = model.elements.size() + 1;
  for (const Shell& shell : model.shells)
  {
    appendCells(text, shell.cells, first, shell.name, { { 3, "S3" }, { 4, "S4" }, { 6, "S6" } });
    first += shell.cells.size();
  }
  for (const Beam& beam : model.beams)
  {
    appendCells(text, beam.edges, first, beam.name, { { 2, beam.isTruss ? "T3D2" : "B31" } });
    first += beam.edges.size();
  }
}

void appendSets(std::string& text, const FiniteElementModel& model)
{
  for (const ElementSet& set : model.elementSets)
  {
    text += "*ELSET, ELSET=" + set.name + "\n";
    appendIds(text, set.elements, kIdsPerLine);
  }
  for (const NodeSet& set : model.nodeSets)
  {
    text += "*NSET, NSET=" + set.name + "\n";
    appendIds(text, set.points, kIdsPerLine);
  }
  for (const SurfaceSet& set : model.surfaces)
  {
    text += "*SURFACE, NAME=" + set.name + ", TYPE=ELEMENT\n";
    for (const auto& [element, face] : set.faces)
    {
      text += std::to_string(element + 1) + ", S" + std::to_string(faceNumber(model.elements[element], face)) + "\n";
    }
  }
}

/// Neo-Hooke: U = C10 (I1 - 3) + (J - 1)^2 / D1, where C10 is half the shear modulus and D1 two over the bulk modulus.
void appendMaterial(std::string& text, const Material& material)
{
  const double E = material.youngsModulus, nu = material.poissonsRatio;
  text += "*MATERIAL, NAME=" + material.name + "\n";
  if (material.law == MaterialLaw::LinearElastic) text += "*ELASTIC\n" + number(E) + ", " + number(nu) + "\n";
  else text += "*HYPERELASTIC, NEO HOOKE\n" + number(E / (4 * (1 + nu))) + ", " + number(6 * (1 - 2 * nu) / E) + "\n";
  text += "*DENSITY\n" + number(material.density) + "\n";
}

/// Returns the axis or diagonal whose smallest angle to the edges is largest, to orient the sides of a section.
Vec3 acrossAll(const Beam& beam, const std::vector<Vec3>& points)
{
  Vec3 best;
  double least = 2;
  for (int n = 1; n < 27; ++n)
  {
    Vec3 direction{ double((n + 1) % 3 - 1), double((n / 3 + 1) % 3 - 1), double((n / 9 + 1) % 3 - 1) };
    direction = direction / norm(direction);
    double most = 0;
    for (const Cell& edge : beam.edges)
    {
      const Vec3 along = points[edge[1]] - points[edge[0]];
      most = std::max(most, std::abs(dot(direction, along)) / norm(along));
    }
    if (most < least) least = most, best = direction;
  }
  return best;
}

/// Uses a square section with the same second moment of area: for round sections, Abaqus reads the radius and CalculiX
/// the diameter.
void appendBeamSection(std::string& text, const Beam& beam, const FiniteElementModel& model)
{
  const std::string of = ", ELSET=" + beam.name + ", MATERIAL=" + model.materials[beam.material].name;
  if (beam.isTruss)
  {
    text += "*SOLID SECTION" + of + "\n" + number(sectionArea(beam)) + "\n";
    return;
  }
  const std::string side = number(std::pow(12 * secondMomentOfArea(beam), 0.25));
  const Vec3 across = acrossAll(beam, model.content.mesh.points);
  text += "*BEAM SECTION" + of + ", SECTION=RECT\n" + side + ", " + side + "\n" + number(across.x) + ", " +
          number(across.y) + ", " + number(across.z) + "\n";
}

void appendSections(std::string& text, const FiniteElementModel& model)
{
  for (const Material& material : model.materials) appendMaterial(text, material);
  for (const Section& section : model.sections)
  {
    text += "*SOLID SECTION, ELSET=" + model.elementSets[section.elementSet].name +
            ", MATERIAL=" + model.materials[section.material].name + "\n";
  }
  for (const Shell& shell : model.shells)
  {
    text += "*SHELL SECTION, ELSET=" + shell.name + ", MATERIAL=" + model.materials[shell.material].name + "\n" +
            number(shell.thickness) + "\n";
  }
  for (const Beam& beam : model.beams) appendBeamSection(text, beam, model);
}

void appendClamps(std::string& text, const FiniteElementModel& model)
{
  for (const NodeSet& set : model.nodeSets)
  {
    if (set.kind == SetKind::NullDisplacement) text += "*BOUNDARY\n" + set.name + ", 1, 3\n";
  }
}

} // namespace

void writeAbaqus(const FiniteElementModel& model, const std::string& file, const Destination& destination)
{
  std::string text = "*HEADING\n" + frameAndUnits(model) + "\n";
  appendNodes(text, model.content.mesh.points);
  appendElements(text, model);
  appendSets(text, model);
  appendSections(text, model);
  appendClamps(text, model);
  writeBytes(text, destination(file));
}

} // namespace surgicalmesher
