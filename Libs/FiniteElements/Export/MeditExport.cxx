// SPDX-License-Identifier: Apache-2.0
#include "MeditExport.h"

#include "ExportText.h"
#include "SetTags.h"
#include "TextFile.h"

#include <map>
#include <utility>

namespace surgicalmesher
{

namespace
{

/// Writes a section of cells, each with its reference; nothing if there are no cells.
void writeSection(ExportText& out, const char* title, const std::vector<std::pair<Cell, std::int32_t>>& cells)
{
  if (cells.empty()) return;
  out << "\n\n" << title << '\n' << cells.size();
  for (const auto& [cell, reference] : cells) out << '\n' << FromOne{ cell } << ' ' << reference;
}

} // namespace

void writeMedit(const FiniteElementModel& model, const std::string& file, const Destination& destination)
{
  const TetMesh& mesh = model.content.mesh;
  const SetTags tags = tagsOf(model);
  std::vector<std::int32_t> reference(mesh.points.size(), 0);
  for (const std::int32_t id : tags.fixedPoints) reference[id] = tags.nullDisplacement;
  std::map<std::size_t, std::vector<std::pair<Cell, std::int32_t>>> faces, elements; // by their number of nodes
  for (const FacePiece& piece : tags.facePieces)
  {
    for (const Cell& face : piece.cells) faces[face.size()].push_back({ face, piece.tag });
  }
  for (std::size_t e = 0; e < model.elements.size(); ++e)
    elements[model.elements[e].size()].push_back({ model.elements[e], mesh.labels[e] });
  std::vector<std::pair<Cell, std::int32_t>> edges;
  for (std::size_t b = 0; b < model.beams.size(); ++b)
    for (const Cell& edge : model.beams[b].edges) edges.push_back({ edge, tags.beams[b] });
  ExportText out;
  out << "MeshVersionFormatted 2\n\nDimension 3\n\nVertices\n" << mesh.points.size();
  for (std::size_t i = 0; i < mesh.points.size(); ++i) out << '\n' << mesh.points[i] << ' ' << reference[i];
  writeSection(out, "Edges", edges);
  writeSection(out, "Triangles", faces[3]);
  writeSection(out, "Quadrilaterals", faces[4]);
  writeSection(out, "Tetrahedra", elements[4]);
  writeSection(out, "Prisms", elements[6]);
  writeSection(out, "Hexahedra", elements[8]);
  out << "\n\nEnd\n";
  writeBytes(out.str(), destination(file));
}

} // namespace surgicalmesher
