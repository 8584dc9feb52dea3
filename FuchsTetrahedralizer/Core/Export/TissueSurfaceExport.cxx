#include "TissueSurfaceExport.h"

#include "Errors.h"

#include <vtkCellArray.h>
#include <vtkErrorCode.h>
#include <vtkNew.h>
#include <vtkPLYWriter.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSTLWriter.h>

#include <algorithm>
#include <cctype>
#include <filesystem>

namespace surgicalmesher
{
namespace
{

using Triangles = std::vector<std::array<std::int32_t, 3>>;

/// By label: the triangles of all interfaces that have the tissue behind them, wound out of it.
std::map<std::int32_t, Triangles> surfacesOf(const FiniteElementModel& model)
{
  std::map<std::int32_t, Triangles> result;
  for (const SurfaceSet& surface : model.surfaces)
  {
    if (surface.kind != SetKind::TissueInterface) continue;
    Triangles& triangles = result[surface.ids[0]];
    triangles.insert(triangles.end(), surface.triangles.begin(), surface.triangles.end());
  }
  return result;
}

/// Points in the order of the mesh, those of the triangles alone.
vtkSmartPointer<vtkPolyData> polyDataOf(const std::vector<Vec3>& points, const Triangles& triangles)
{
  std::map<std::int32_t, vtkIdType> newId;
  for (const auto& triangle : triangles)
  {
    for (const std::int32_t id : triangle) newId[id] = 0;
  }
  vtkNew<vtkPoints> vertices;
  vertices->SetDataTypeToFloat();
  for (auto& [id, place] : newId) place = vertices->InsertNextPoint(&points[id].x);
  vtkNew<vtkCellArray> cells;
  for (const auto& [a, b, c] : triangles) cells->InsertNextCell({ newId[a], newId[b], newId[c] });
  auto result = vtkSmartPointer<vtkPolyData>::New();
  result->SetPoints(vertices);
  result->SetPolys(cells);
  return result;
}

void writeSTL(vtkPolyData* surface, const std::string& file)
{
  vtkNew<vtkSTLWriter> writer;
  writer->SetInputData(surface);
  writer->SetFileName(file.c_str());
  writer->SetFileTypeToBinary();
  writer->SetHeader("SPACE=LPS closed surface of a tissue, mm");
  if (!writer->Write() || writer->GetErrorCode() != vtkErrorCode::NoError)
  {
    throw InputError(file + ": can't be written to its end (" +
                     vtkErrorCode::GetStringFromErrorCode(writer->GetErrorCode()) + ")");
  }
}

void writePLY(vtkPolyData* surface, const std::string& file)
{
  vtkNew<vtkPLYWriter> writer;
  writer->SetInputData(surface);
  writer->SetFileTypeToBinary();
  writer->SetDataByteOrderToLittleEndian();
  writer->AddComment("SPACE=LPS");
  writer->WriteToOutputStringOn();
  writer->Write();
  writeBytes(writer->GetOutputString(), file);
}

} // namespace

void writeTissueSurfaces(const FiniteElementModel& model, const std::string& file, const Destination& destination)
{
  const std::filesystem::path path(file);
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  const std::map<std::int32_t, Triangles> surfaces = surfacesOf(model);
  for (const ElementSet& set : model.elementSets)
  {
    if (set.kind != SetKind::Tissue) continue;
    const std::string name = path.stem().string() + "." + set.name + path.extension().string();
    const std::string place = destination((path.parent_path() / name).string());
    const auto surface = polyDataOf(model.content.mesh.points, surfaces.at(set.ids[0]));
    extension == ".stl" ? writeSTL(surface, place) : writePLY(surface, place);
  }
}

} // namespace surgicalmesher
