// SPDX-License-Identifier: Apache-2.0
#include "SolidElements.h"

#include "Errors.h"

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkPointData.h>
#include <vtkPointSet.h>

namespace surgicalmesher
{
namespace
{

using Ids = std::vector<std::int32_t>;

Cell cellOf(const Element& element)
{
  Cell cell;
  for (int i = 0; i < nodeCount(element.shape); ++i) cell.append(element.nodes[i]);
  return cell;
}

/// Returns the arrays of bytes 0 and 1 as named sets. `renumbered` maps ids of cells or points to new ids, -1 for
/// omitted ones.
std::map<std::string, Ids> byteSets(vtkDataSetAttributes* data, const Ids& renumbered)
{
  std::map<std::string, Ids> sets;
  for (int a = 0; a < data->GetNumberOfArrays(); ++a)
  {
    vtkDataArray* array = data->GetArray(a);
    if (!array || !array->GetName() || array->GetDataTypeSize() != 1 || array->GetNumberOfComponents() != 1) continue;
    if (array->GetRange()[0] < 0 || array->GetRange()[1] > 1) continue;
    Ids members;
    for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i)
    {
      if (array->GetTuple1(i) != 0 && renumbered[std::size_t(i)] >= 0) members.push_back(renumbered[std::size_t(i)]);
    }
    if (!members.empty()) sets[array->GetName()] = members;
  }
  return sets;
}

Label labelOf(vtkDataArray* labels, std::size_t element, const std::string& file)
{
  if (!labels) return 1;
  const double label = labels->GetTuple1(vtkIdType(element));
  if (label >= 1 && label < double(labelCount) && label == Label(label)) return Label(label);
  throw InputError(file + ": TissueLabel of cell " + std::to_string(element) + " is none of 1 to " +
                   std::to_string(labelCount - 1));
}

vtkDataArray* scalars(vtkDataSetAttributes* data, const char* name)
{
  vtkDataArray* array = data->GetArray(name);
  return array && array->GetNumberOfComponents() == 1 ? array : nullptr;
}

} // namespace

SolidMesh solidMeshOf(const ElementMeshFile& content, const Points& points, const std::string& file)
{
  SolidMesh solid;
  vtkDataSetAttributes* cells = content.data->GetCellData();
  vtkDataArray *labels = scalars(cells, "TissueLabel"), *layers = scalars(cells, "Layer");
  const std::vector<Element>& elements = content.mesh.elements;
  Ids newElement(elements.size(), -1), newPoint(std::size_t(points.cols()), -1);
  for (std::size_t e = 0; e < elements.size(); ++e)
  {
    if (!isVolume(elements[e])) continue;
    newElement[e] = std::int32_t(solid.elements.size());
    solid.elements.push_back(cellOf(elements[e]));
    solid.labels.push_back(labelOf(labels, e, file));
    for (const std::int32_t id : solid.elements.back()) newPoint[id] = 0;
    if (layers)
      solid.elementSets["layer_" + std::to_string(int(layers->GetTuple1(vtkIdType(e))))].push_back(newElement[e]);
  }
  if (solid.elements.empty())
    throw InputError(file + ": no volume element found, tetrahedra, hexahedra or wedges expected");
  for (std::size_t i = 0; i < newPoint.size(); ++i)
  {
    if (newPoint[i] < 0) continue;
    newPoint[i] = std::int32_t(solid.points.size());
    const auto p = points.col(Eigen::Index(i));
    solid.points.push_back({ p.x(), p.y(), p.z() });
  }
  for (Cell& cell : solid.elements)
  {
    for (std::int32_t& id : cell) id = newPoint[id];
  }
  solid.elementSets.merge(byteSets(cells, newElement));
  solid.nodeSets = byteSets(content.data->GetPointData(), newPoint);
  solid.tissues = tissuesOf(content.data->GetFieldData());
  if (!labels) solid.tissues[1].name = "template";
  return solid;
}

} // namespace surgicalmesher
