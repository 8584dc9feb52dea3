// SPDX-License-Identifier: Apache-2.0
#include "TissueSurfaceExport.h"
#include "Compaction.h"

#include "Errors.h"
#include "ExportText.h"
#include "TextFile.h"

#include <vtkCellArray.h>
#include <vtkErrorCode.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSTLWriter.h>

#include <algorithm>
#include <filesystem>

namespace surgicalmesher
{
namespace
{

using Triangles = std::vector<std::array<std::int32_t, 3>>;

/// Splits a quadrilateral at its node of lowest id, so that both sides of an interface are split alike.
void addTriangles(const Cell& face, Triangles& triangles)
{
  const auto first = std::size_t(std::min_element(face.begin(), face.end()) - face.begin());
  const auto corner = [&](std::size_t i) { return face[(first + i) % face.size()]; };
  if (face.size() == 3) return triangles.push_back({ face[0], face[1], face[2] });
  triangles.push_back({ corner(0), corner(1), corner(2) });
  triangles.push_back({ corner(0), corner(2), corner(3) });
}

/// Returns, by label, the faces of all interfaces with the tissue behind them, oriented out of it. Label 0 is the outer
/// boundary.
std::map<std::int32_t, Triangles> surfacesOf(const FiniteElementModel& model)
{
  std::map<std::int32_t, Triangles> result;
  for (const SurfaceSet& surface : model.surfaces)
  {
    if (surface.kind != SetKind::TissueInterface && surface.kind != SetKind::OuterBoundary) continue;
    Triangles& triangles = result[surface.kind == SetKind::OuterBoundary ? 0 : surface.ids[0]];
    for (const Cell& face : surface.cells) addTriangles(face, triangles);
  }
  return result;
}

/// Returns the triangles with the points that they use, in the order of the mesh.
SurfaceComplex surfaceOf(const std::vector<Vec3>& points, const Triangles& triangles)
{
  SurfaceComplex result;
  result.triangles = triangles;
  result.points = valuesAt(points, compactPoints(result.triangles, points.size()));
  return result;
}

void writeSTL(const SurfaceComplex& surface, const std::string& file)
{
  vtkNew<vtkPoints> points;
  for (const Vec3& p : surface.points) points->InsertNextPoint(p.x, p.y, p.z);
  vtkNew<vtkCellArray> cells;
  for (const auto& [a, b, c] : surface.triangles) cells->InsertNextCell({ a, b, c });
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetPolys(cells);
  vtkNew<vtkSTLWriter> writer;
  writer->SetInputData(data);
  writer->SetFileName(file.c_str());
  writer->SetFileTypeToBinary();
  writer->SetHeader("SPACE=LPS closed surface of a tissue, mm");
  if (!writer->Write() || writer->GetErrorCode() != vtkErrorCode::NoError)
  {
    throw InputError(file + ": can't be written to its end (" +
                     vtkErrorCode::GetStringFromErrorCode(writer->GetErrorCode()) + ")");
  }
}

/// VTK's writer is not used: it rounds to single precision, fails silently, and in 9.1 leaves its output string empty.
void writePLY(const SurfaceComplex& surface, const std::string& file)
{
  ExportText out;
  out << "ply\nformat ascii 1.0\ncomment SPACE=LPS\nelement vertex " << surface.points.size()
      << "\nproperty double x\nproperty double y\nproperty double z\nelement face " << surface.triangles.size()
      << "\nproperty list uchar int vertex_indices\nend_header\n";
  for (const Vec3& p : surface.points) out << p << '\n';
  for (const auto& [a, b, c] : surface.triangles) out << "3 " << a << ' ' << b << ' ' << c << '\n';
  writeBytes(out.str(), file);
}

} // namespace

void writeTissueSurfaces(const FiniteElementModel& model, const std::string& file, const Destination& destination)
{
  const std::filesystem::path path(file);
  const std::string extension = text::extensionOf(file);
  const std::map<std::int32_t, Triangles> surfaces = surfacesOf(model);
  const auto write = [&](std::int32_t label, const std::string& finalPath)
  {
    const SurfaceComplex surface = surfaceOf(model.content.mesh.points, surfaces.at(label));
    const std::string place = destination(finalPath);
    extension == ".stl" ? writeSTL(surface, place) : writePLY(surface, place);
  };
  write(0, file);
  for (const ElementSet& set : model.elementSets)
  {
    const std::string name = path.stem().string() + "." + set.name + path.extension().string();
    if (set.kind == SetKind::Tissue) write(set.ids[0], (path.parent_path() / name).string());
  }
}

} // namespace surgicalmesher
