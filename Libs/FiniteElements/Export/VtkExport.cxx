// SPDX-License-Identifier: Apache-2.0
#include "VtkExport.h"

#include "Errors.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkXMLPolyDataWriter.h>

#include <set>

namespace surgicalmesher
{
namespace
{

template <class Array>
void named(Array& array, const char* name, vtkFieldData* owner)
{
  array->SetName(name);
  owner->AddArray(array);
}

/// Points of the mesh that shells use, in its order; `shellId` receives for each point of the mesh its place among
/// them.
void addPoints(vtkPolyData* data, const FiniteElementModel& model, std::vector<std::int32_t>& shellId)
{
  const std::vector<Vec3>& meshPoints = model.content.mesh.points;
  shellId.assign(meshPoints.size(), -1);
  for (const Shell& shell : model.shells)
  {
    for (const auto& triangle : shell.triangles)
    {
      for (const std::int32_t id : triangle) shellId[id] = 0;
    }
  }
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkIntArray> volumeId;
  for (std::size_t i = 0; i < shellId.size(); ++i)
  {
    if (shellId[i] < 0) continue;
    shellId[i] = static_cast<std::int32_t>(points->InsertNextPoint(&meshPoints[i].x));
    volumeId->InsertNextValue(static_cast<int>(i));
  }
  data->SetPoints(points);
  named(volumeId, "VolumePointId", data->GetPointData());
}

void addTriangles(vtkPolyData* data, const FiniteElementModel& model, const std::vector<std::int32_t>& shellId)
{
  vtkNew<vtkCellArray> triangles;
  vtkNew<vtkIntArray> label;
  vtkNew<vtkDoubleArray> thickness;
  for (const Shell& shell : model.shells)
  {
    for (const auto& [a, b, c] : shell.triangles)
    {
      const vtkIdType ids[3] = { shellId[a], shellId[b], shellId[c] };
      triangles->InsertNextCell(3, ids);
      label->InsertNextValue(shell.ids[0]);
      thickness->InsertNextValue(shell.thickness);
    }
  }
  data->SetPolys(triangles);
  named(label, "TissueLabel", data->GetCellData());
  named(thickness, "Thickness", data->GetCellData());
}

void addTissues(vtkPolyData* data, const FiniteElementModel& model)
{
  vtkNew<vtkStringArray> space, names;
  vtkNew<vtkIntArray> ids;
  vtkNew<vtkDoubleArray> colors;
  colors->SetNumberOfComponents(3);
  space->InsertNextValue("LPS");
  std::set<std::int32_t> shells;
  for (const Shell& shell : model.shells) shells.insert(shell.ids[0]);
  for (const ElementSet& set : model.elementSets)
  {
    if (set.kind != SetKind::Tissue || shells.count(set.ids[0]) == 0) continue;
    ids->InsertNextValue(set.ids[0]);
    names->InsertNextValue(set.original);
    colors->InsertNextTuple(set.color.data());
  }
  named(space, "SPACE", data->GetFieldData());
  named(ids, "TissueIds", data->GetFieldData());
  named(names, "TissueNames", data->GetFieldData());
  named(colors, "TissueColors", data->GetFieldData());
}

} // namespace

void writeVtk(const FiniteElementModel& model, const std::string& file, const Destination& destination)
{
  writeMesh(model.content, destination(file), FieldTexts::LeftOut);
}

void writeShells(const FiniteElementModel& model, const std::string& file)
{
  vtkNew<vtkPolyData> data;
  std::vector<std::int32_t> shellId;
  addPoints(data, model, shellId);
  addTriangles(data, model, shellId);
  addTissues(data, model);
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetInputData(data);
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOff();
  writer->SetCompressorTypeToZLib();
  writer->SetHeaderTypeToUInt64();
  writer->WriteToOutputStringOn();
  if (!writer->Write()) throw InputError(file + ": can't be composed");
  writeBytes(writer->GetOutputString(), file);
}

} // namespace surgicalmesher
