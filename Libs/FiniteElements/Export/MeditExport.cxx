// SPDX-License-Identifier: Apache-2.0
#include "MeditExport.h"

#include "ExportText.h"
#include "SetTags.h"

namespace surgicalmesher
{

void writeMedit(const FiniteElementModel& model, const std::string& file, const Destination& destination)
{
  const TetMesh& mesh = model.content.mesh;
  const SetTags tags = tagsOf(model);
  std::vector<std::int32_t> reference(mesh.points.size(), 0);
  for (const std::int32_t id : tags.fixedPoints) reference[id] = tags.nullDisplacement;
  std::size_t triangles = 0;
  for (const FacePiece& piece : tags.facePieces) triangles += piece.triangles.size();
  ExportText out;
  out << "MeshVersionFormatted 2\n\nDimension 3\n\nVertices\n" << mesh.points.size() << '\n';
  for (std::size_t i = 0; i < mesh.points.size(); ++i) out << mesh.points[i] << ' ' << reference[i] << '\n';
  out << "\nTriangles\n" << triangles;
  for (const FacePiece& piece : tags.facePieces)
  {
    for (const auto& triangle : piece.triangles) out << '\n' << FromOne{ triangle } << ' ' << piece.tag;
  }
  out << "\n\nTetrahedra\n" << mesh.tetrahedra.size();
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t)
  {
    out << '\n' << FromOne{ mesh.tetrahedra[t] } << ' ' << mesh.labels[t];
  }
  out << "\n\nEnd\n";
  writeBytes(out.str(), destination(file));
}

} // namespace surgicalmesher
