// SPDX-License-Identifier: Apache-2.0
#include "FebioExport.h"

#include "Portions.h"
#include "TextFile.h"
#include "TextNumbers.h"
#include "Units.h"

#include <numeric>
#include <set>

namespace surgicalmesher
{
namespace
{

constexpr std::size_t kIdsPerLine = 16;

/// <tag id="n">a,b,c</tag>, ids counted from 1.
void appendRow(std::string& text, const std::string& tag, const Cell& cell, std::size_t number)
{
  text += "      <" + tag + " id=\"" + std::to_string(number) + "\">";
  const char* separator = "";
  for (const std::int32_t id : cell)
  {
    text += separator + std::to_string(id + 1);
    separator = ",";
  }
  text += "</" + tag + ">\n";
}

std::string typeOfFace(const Cell& face) { return face.size() == 3 ? "tri3" : face.size() == 6 ? "tri6" : "quad4"; }

std::string beamMaterialName(const Beam& beam) { return beam.name + "_material"; }

/// FEBio stores the section of a beam in its material. The shear area of a round section is 0.9 of its area.
void appendBeamMaterial(std::string& text, const Beam& beam, const FiniteElementModel& model, std::size_t id)
{
  const Material& material = model.materials[beam.material];
  const auto line = [&](const char* tag, double value)
  { text += std::string("      <") + tag + ">" + textOf(value) + "</" + tag + ">\n"; };
  const double area = sectionArea(beam), moment = secondMomentOfArea(beam);
  text += "    <material id=\"" + std::to_string(id) + "\" name=\"" + beamMaterialName(beam) + "\" type=\"" +
          (beam.isTruss ? "linear truss" : "linear-beam") + "\">\n";
  line("density", material.density);
  line("E", material.youngsModulus);
  if (beam.isTruss) line("v", material.poissonsRatio);
  else
  {
    line("G", material.youngsModulus / (2 * (1 + material.poissonsRatio)));
    line("A", area);
    line("A1", 0.9 * area);
    line("A2", 0.9 * area);
    line("I1", moment);
    line("I2", moment);
  }
  text += "    </material>\n";
}

void appendMaterials(std::string& text, const FiniteElementModel& model)
{
  text += "  <Material>\n";
  for (std::size_t i = 0; i < model.materials.size(); ++i)
  {
    const Material& material = model.materials[i];
    const char* law = material.law == MaterialLaw::NeoHookean ? "neo-Hookean" : "isotropic elastic";
    text += "    <material id=\"" + std::to_string(i + 1) + "\" name=\"" + material.name + "\" type=\"" + law + "\">\n";
    text += "      <density>" + textOf(material.density) + "</density>\n";
    text += "      <E>" + textOf(material.youngsModulus) + "</E>\n";
    text += "      <v>" + textOf(material.poissonsRatio) + "</v>\n    </material>\n";
  }
  for (std::size_t i = 0; i < model.beams.size(); ++i)
    appendBeamMaterial(text, model.beams[i], model, model.materials.size() + i + 1);
  text += "  </Material>\n";
}

void appendNodes(std::string& text, const std::vector<Vec3>& points)
{
  text += "    <Nodes name=\"all_nodes\">\n";
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const Vec3& p = points[i];
    text += "      <node id=\"" + std::to_string(i + 1) + "\">" + textOf(p.x) + "," + textOf(p.y) + "," + textOf(p.z) +
            "</node>\n";
  }
  text += "    </Nodes>\n";
}

/// Appends the parts; every element belongs to exactly one, that of its section, shell or curve.
void appendParts(std::string& text, const FiniteElementModel& model)
{
  for (const Section& section : model.sections)
  {
    for (const Portion& part : portionsOf(model, model.elementSets[section.elementSet]))
    {
      text += "    <Elements type=\"" + part.shape + "\" name=\"" + part.name + "\">\n";
      for (const std::int32_t e : part.elements) appendRow(text, "elem", model.elements[e], e + 1);
      text += "    </Elements>\n";
    }
  }
  std::size_t next = model.elements.size();
  for (const Shell& shell : model.shells)
  {
    for (const Portion& part : portionsOf(shell))
    {
      text += "    <Elements type=\"" + part.shape + "\" name=\"" + part.name + "\">\n";
      for (const std::int32_t i : part.elements) appendRow(text, "elem", shell.cells[i], next + i + 1);
      text += "    </Elements>\n";
    }
    next += shell.cells.size();
  }
  for (const Beam& beam : model.beams)
  {
    text += "    <Elements type=\"line2\" name=\"" + beam.name + "\">\n";
    for (const Cell& edge : beam.edges) appendRow(text, "elem", edge, ++next);
    text += "    </Elements>\n";
  }
}

void appendElementSet(std::string& text, const std::string& name, const std::vector<std::int32_t>& elements)
{
  text += "    <ElementSet name=\"" + name + "\">\n";
  appendIds(text, elements, kIdsPerLine, ",");
  text += "    </ElementSet>\n";
}

/// Appends the element sets, and the shells of several parts; what is one part is already an element set of its name.
void appendElementSets(std::string& text, const FiniteElementModel& model)
{
  std::set<std::int32_t> parts;
  for (const Section& section : model.sections)
  {
    if (portionsOf(model, model.elementSets[section.elementSet]).size() == 1) parts.insert(section.elementSet);
  }
  for (std::size_t i = 0; i < model.elementSets.size(); ++i)
  {
    const ElementSet& set = model.elementSets[i];
    if (parts.count(static_cast<std::int32_t>(i)) == 0) appendElementSet(text, set.name, set.elements);
  }
  auto next = static_cast<std::int32_t>(model.elements.size());
  for (const Shell& shell : model.shells)
  {
    std::vector<std::int32_t> elements(shell.cells.size());
    std::iota(elements.begin(), elements.end(), next);
    if (portionsOf(shell).size() > 1) appendElementSet(text, shell.name, elements);
    next += static_cast<std::int32_t>(elements.size());
  }
}

void appendSets(std::string& text, const FiniteElementModel& model)
{
  for (const NodeSet& set : model.nodeSets)
  {
    text += "    <NodeSet name=\"" + set.name + "\">\n";
    appendIds(text, set.points, kIdsPerLine, ",");
    text += "    </NodeSet>\n";
  }
  for (const SurfaceSet& set : model.surfaces)
  {
    text += "    <Surface name=\"" + set.name + "\">\n";
    for (std::size_t i = 0; i < set.cells.size(); ++i) appendRow(text, typeOfFace(set.cells[i]), set.cells[i], i + 1);
    text += "    </Surface>\n";
  }
  appendElementSets(text, model);
}

void appendDomains(std::string& text, const FiniteElementModel& model)
{
  const auto attributes = [&](const std::string& name, std::int32_t material)
  { return " name=\"" + name + "\" mat=\"" + model.materials[material].name + "\""; };
  text += "  <MeshDomains>\n";
  for (const Section& section : model.sections)
  {
    for (const Portion& part : portionsOf(model, model.elementSets[section.elementSet]))
      text += "    <SolidDomain" + attributes(part.name, section.material) + "/>\n";
  }
  for (const Shell& shell : model.shells)
  {
    for (const Portion& part : portionsOf(shell))
      text += "    <ShellDomain" + attributes(part.name, shell.material) + ">\n      <shell_thickness>" +
              textOf(shell.thickness) + "</shell_thickness>\n    </ShellDomain>\n";
  }
  for (const Beam& beam : model.beams)
  {
    text += "    <BeamDomain name=\"" + beam.name + "\" mat=\"" + beamMaterialName(beam) + "\" type=\"" +
            (beam.isTruss ? "linear-truss" : "linear-beam") + "\"";
    if (!beam.isTruss) text += "/>\n";
    else
    {
      text +=
        ">\n      <cross_sectional_area>" + textOf(sectionArea(beam)) + "</cross_sectional_area>\n    </BeamDomain>\n";
    }
  }
  text += "  </MeshDomains>\n";
}

void appendClamps(std::string& text, const FiniteElementModel& model)
{
  for (const NodeSet& set : model.nodeSets)
  {
    if (set.kind != SetKind::NullDisplacement) continue;
    text += "  <Boundary>\n    <bc name=\"null_displacement\" type=\"zero displacement\" node_set=\"" + set.name +
            "\">\n      <x_dof>1</x_dof>\n      <y_dof>1</y_dof>\n      <z_dof>1</z_dof>\n    </bc>\n  </Boundary>\n";
  }
}

} // namespace

void writeFebio(const FiniteElementModel& model, const std::string& file, const Destination& destination)
{
  std::string text = "<?xml version=\"1.0\" encoding=\"ISO-8859-1\"?>\n<febio_spec version=\"4.0\">\n"
                     "  <!-- " +
                     frameAndUnits(model) +
                     " -->\n  <Module type=\"solid\"/>\n"
                     "  <Control>\n    <analysis>STATIC</analysis>\n    <time_steps>1</time_steps>\n"
                     "    <step_size>1</step_size>\n    <solver type=\"solid\"/>\n  </Control>\n";
  appendMaterials(text, model);
  text += "  <Mesh>\n";
  appendNodes(text, model.content.mesh.points);
  appendParts(text, model);
  appendSets(text, model);
  text += "  </Mesh>\n";
  appendDomains(text, model);
  appendClamps(text, model);
  text += "</febio_spec>\n";
  writeBytes(text, destination(file));
}

} // namespace surgicalmesher
