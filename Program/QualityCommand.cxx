// SPDX-License-Identifier: Apache-2.0
// surgicalmesher quality: measures of a mesh of tetrahedra, or of other solid elements.

#include "Commands.h"
#include "ElementQuality.h"
#include "Errors.h"
#include "JsonReport.h"
#include "MeshIO.h"
#include "MeshQuality.h"
#include "PrintableText.h"
#include "SolidElements.h"
#include "TextFile.h"
#include "TissueMapIO.h"

#include <algorithm>
#include <cstdio>

namespace surgicalmesher
{

namespace
{

/// Cuts or pads a text to `width` characters, of which some have several bytes in UTF-8.
std::string column(const std::string& text, int width)
{
  std::size_t bytes = 0;
  int letters = 0;
  for (; letters < width && bytes < text.size(); ++letters) bytes += std::max<std::size_t>(1, utf8Length(text, bytes));
  return text.substr(0, bytes) + std::string(std::size_t(width - letters), ' ');
}

std::string tissueColumn(Label label, const TissueTable& tissues)
{
  const auto found = tissues.find(label);
  const std::string name = found == tissues.end() ? "" : found->second.name;
  return column(std::to_string(label) + " " + name, 32);
}

std::string numberColumn(double value, const char* format)
{
  char text[32];
  std::snprintf(text, sizeof(text), format, value);
  return text;
}

std::string tetrahedraRow(const QualityGroup& group)
{
  return numberColumn(double(group.tetrahedra), "%10.0f") + numberColumn(group.volume, "%14.1f") +
         numberColumn(group.dihedral.minimum, "%10.1f") + numberColumn(group.dihedral.maximum, "%8.1f") +
         numberColumn(group.minimumDihedral.mean, "%8.1f") + numberColumn(group.radiusRatio.minimum, "%8.3f") +
         numberColumn(group.height.minimum, "%8.3f");
}

void tellOfTetrahedra(CommandLine& line, const MeshQuality& quality, const TissueTable& tissues)
{
  line.message(column("tissue", 32) + "tetrahedra  volume (mm3)  dihedral     to    mean   ratio  height");
  line.message(column("all", 32) + tetrahedraRow(quality.whole));
  for (const auto& [label, group] : quality.tissues) line.message(tissueColumn(label, tissues) + tetrahedraRow(group));
}

MeshQuality qualityOf(const MeshFile& content, const std::string& scaleFile)
{
  if (scaleFile.empty()) return assessQualityFromPoints(content.mesh, content.subMesh, content.targetEdgeLength);
  return assessQuality(content.mesh, content.subMesh,
                       [scale = readScale(scaleFile)](const Vec3& p) { return scale(p); });
}

void measureTetrahedra(CommandLine& line, const MeshFile& content)
{
  const MeshQuality quality = qualityOf(content, line.text("scale"));
  const std::string file = line.outputFile("report");
  if (!file.empty()) writeBytes(qualityJSON(quality, content.tissues) + "\n", file);
  tellOfTetrahedra(line, quality, content.tissues);
}

struct ShapeOfTissue
{
  Label label = 0;
  ElementShape shape = ElementShape::Hexahedron;
  double volume = 0; ///< mm^3
  QualitySummary quality;
};

const char* nameOf(ElementShape shape)
{
  if (shape == ElementShape::Tetrahedron) return "tetrahedra";
  return shape == ElementShape::Wedge ? "wedges" : "hexahedra";
}

/// Measures the elements by tissue and shape; combinations without elements are left out.
std::vector<ShapeOfTissue> measured(const ElementMeshFile& content, const SolidMesh& solid)
{
  std::map<Label, ElementMesh> parts;
  std::size_t n = 0;
  for (const Element& element : content.mesh.elements)
  {
    if (isVolume(element)) parts[solid.labels[n++]].elements.push_back(element);
  }
  std::vector<ShapeOfTissue> rows;
  for (auto& [label, part] : parts)
  {
    part.points = content.mesh.points;
    const std::vector<ElementQuality> quality = elementQuality(part);
    for (const ElementShape shape : { ElementShape::Hexahedron, ElementShape::Wedge, ElementShape::Tetrahedron })
    {
      ShapeOfTissue row{ label, shape, 0, summaryOf(part, quality, shape) };
      for (const Element& element : part.elements)
      {
        if (element.shape == shape) row.volume += volumeOf(element, part.points);
      }
      if (row.quality.elements > 0) rows.push_back(row);
    }
  }
  return rows;
}

void writeElements(const std::vector<ShapeOfTissue>& rows, const std::string& file)
{
  const auto writeRow = [](JsonWriter& json, const ShapeOfTissue& row)
  {
    writeMember(json, "label", row.label);
    writeMember(json, "shape", std::string(nameOf(row.shape)));
    writeMember(json, "elements", row.quality.elements);
    writeMember(json, "volume", row.volume);
    writeMember(json, "invalid", row.quality.invalid);
    writeMember(json, "minimumScaledJacobian", row.quality.minimum);
    writeMember(json, "meanScaledJacobian", row.quality.mean);
    writeMember(json, "meanShapeSkew", row.quality.meanShapeSkew);
  };
  const auto writeMembers = [&](JsonWriter& json)
  { writeObjects(json, "tissues", rows, [&](const ShapeOfTissue& row) { writeRow(json, row); }); };
  writeBytes(jsonText(writeMembers, { 6 }), file);
}

void measureElements(CommandLine& line, const ElementMeshFile& content)
{
  const SolidMesh solid = solidMeshOf(content, content.mesh.points, line.text("mesh"));
  const std::vector<ShapeOfTissue> rows = measured(content, solid);
  const std::string file = line.outputFile("report");
  if (!file.empty()) writeElements(rows, file);
  line.message(column("tissue", 32) + column("shape", 12) +
               "  elements  volume (mm3)  invalid  least Jacobian    mean    skew");
  for (const ShapeOfTissue& row : rows)
  {
    line.message(tissueColumn(row.label, solid.tissues) + column(nameOf(row.shape), 12) +
                 numberColumn(double(row.quality.elements), "%10.0f") + numberColumn(row.volume, "%14.1f") +
                 numberColumn(double(row.quality.invalid), "%9.0f") + numberColumn(row.quality.minimum, "%16.3f") +
                 numberColumn(row.quality.mean, "%8.3f") + numberColumn(row.quality.meanShapeSkew, "%8.3f"));
  }
}

bool isOfTetrahedra(const ElementMesh& mesh)
{
  return std::none_of(mesh.elements.begin(), mesh.elements.end(),
                      [](const Element& element)
                      { return isVolume(element) && element.shape != ElementShape::Tetrahedron; });
}

} // namespace

void qualityCommand(CommandLine& line)
{
  const std::string file = line.text("mesh");
  const std::string extension = text::extensionOf(file);
  const ElementMeshFile content = readElementMesh(file);
  const bool isVTK = extension == ".vtu" || extension == ".vtk";
  if (isVTK && isOfTetrahedra(content.mesh))
  {
    measureTetrahedra(line, readMesh(file));
    return;
  }
  if (!line.text("scale").empty())
    throw UsageError("--scale is given, but " + file + " has other elements than tetrahedra, expected these");
  measureElements(line, content);
}

} // namespace surgicalmesher
