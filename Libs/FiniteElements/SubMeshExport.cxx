// SPDX-License-Identifier: Apache-2.0
#include "SubMeshExport.h"

#include "Compaction.h"

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
  part.volumePointId = compactPoints(part.mesh.tetrahedra, whole.mesh.points.size());
  part.mesh.points = valuesAt(whole.mesh.points, part.volumePointId);
  part.subMeshInterface = valuesAt(whole.subMeshInterface, part.volumePointId);
  part.interfaceId = valuesAt(interfaceNumbers(whole.subMeshInterface), part.volumePointId);
  part.targetEdgeLength = valuesAt(whole.targetEdgeLength, part.volumePointId);
  part.tissues = whole.tissues;
  return part;
}

} // namespace surgicalmesher
