#include "SubMeshExport.h"

namespace surgicalmesher
{
namespace
{

std::vector<std::int32_t> interfaceNumbers(const std::vector<std::int32_t>& subMeshInterface)
{
  std::int32_t next = 0;
  std::vector<std::int32_t> numbers(subMeshInterface.size(), -1);
  for (std::size_t i = 0; i < numbers.size(); ++i)
  {
    if (subMeshInterface[i] != 0) numbers[i] = next++;
  }
  return numbers;
}

/// Values at `ids`; nothing if there are none.
template <class Value>
std::vector<Value> valuesAt(const std::vector<Value>& values, const std::vector<std::int32_t>& ids)
{
  std::vector<Value> result;
  if (values.empty()) return result;
  result.reserve(ids.size());
  for (const std::int32_t id : ids) result.push_back(values[id]);
  return result;
}

/// The points of `tetrahedra`, ascending, which are renumbered to them.
std::vector<std::int32_t> takePoints(std::vector<std::array<std::int32_t, 4>>& tetrahedra, std::size_t pointCount)
{
  std::vector<std::int32_t> newId(pointCount, -1), kept;
  for (const auto& tetrahedron : tetrahedra)
  {
    for (const std::int32_t id : tetrahedron) newId[id] = 0;
  }
  for (std::size_t i = 0; i < pointCount; ++i)
  {
    if (newId[i] < 0) continue;
    newId[i] = static_cast<std::int32_t>(kept.size());
    kept.push_back(static_cast<std::int32_t>(i));
  }
  for (auto& tetrahedron : tetrahedra)
  {
    for (std::int32_t& id : tetrahedron) id = newId[id];
  }
  return kept;
}

} // namespace

MeshFile partOf(const MeshFile& whole, const std::function<bool(std::int32_t subMesh)>& chosen)
{
  std::vector<std::int32_t> tetrahedra;
  for (std::size_t t = 0; t < whole.subMesh.size(); ++t)
  {
    if (chosen(whole.subMesh[t])) tetrahedra.push_back(static_cast<std::int32_t>(t));
  }
  MeshFile part;
  part.mesh.tetrahedra = valuesAt(whole.mesh.tetrahedra, tetrahedra);
  part.mesh.labels = valuesAt(whole.mesh.labels, tetrahedra);
  part.subMesh = valuesAt(whole.subMesh, tetrahedra);
  part.constitutive = valuesAt(whole.constitutive, tetrahedra);
  part.volumePointId = takePoints(part.mesh.tetrahedra, whole.mesh.points.size());
  part.mesh.points = valuesAt(whole.mesh.points, part.volumePointId);
  part.subMeshInterface = valuesAt(whole.subMeshInterface, part.volumePointId);
  part.interfaceId = valuesAt(interfaceNumbers(whole.subMeshInterface), part.volumePointId);
  part.targetEdgeLength = valuesAt(whole.targetEdgeLength, part.volumePointId);
  part.tissues = whole.tissues;
  return part;
}

} // namespace surgicalmesher
