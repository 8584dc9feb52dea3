// SPDX-License-Identifier: Apache-2.0
#include "TissueSurfaces.h"

#include "Structures.h"
#include "Text.h"

#include <algorithm>
#include <set>

namespace surgicalmesher
{
namespace
{

/// Copies points to the surfaces of single tissues, each point once per tissue.
class PointCopier
{
public:
  explicit PointCopier(const SurfaceFile& all) : m_All(all), m_Ids(all.surface.points.size()), m_Owner(m_Ids.size(), 0)
  {
  }

  std::int32_t copy(std::int32_t point, Label owner, SurfaceFile& part)
  {
    if (m_Owner[point] == owner) return m_Ids[point];
    m_Owner[point] = owner;
    m_Ids[point] = std::int32_t(part.surface.points.size());
    part.surface.points.push_back(m_All.surface.points[point]);
    if (!m_All.targetEdgeLength.empty()) part.targetEdgeLength.push_back(m_All.targetEdgeLength[point]);
    return m_Ids[point];
  }

private:
  const SurfaceFile& m_All;
  std::vector<std::int32_t> m_Ids;
  std::vector<Label> m_Owner; ///< the tissue in whose surface m_Ids is valid
};

/// Whether the triangles with this label in front form a closed surface around a volume.
bool isWholeInFront(const SurfaceComplex& surface, Label label)
{
  std::map<std::pair<std::int32_t, std::int32_t>, int> balance; // by edge: ascending minus descending uses
  double volume = 0;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
  {
    if (surface.labels[t][1] != label) continue;
    const auto& ids = surface.triangles[t];
    volume -= dot(surface.points[ids[0]], cross(surface.points[ids[1]], surface.points[ids[2]]));
    for (int n = 0; n < 3; ++n)
    {
      const std::int32_t from = ids[n], to = ids[(n + 1) % 3];
      balance[std::minmax(from, to)] += from < to ? 1 : -1;
    }
  }
  return volume > 0 && std::all_of(balance.begin(), balance.end(), [](const auto& edge) { return edge.second == 0; });
}

} // namespace

std::optional<Label> leaveNeighboursOut(SurfaceComplex& surface)
{
  if (surface.labels.empty()) return {};
  const Label tissue = surface.labels.front()[0];
  std::set<Label> neighbours;
  for (const auto& [behind, front] : surface.labels)
  {
    if (behind != tissue) return {};
    if (front != 0) neighbours.insert(front);
  }
  const bool areWhole =
    std::all_of(neighbours.begin(), neighbours.end(), [&](Label label) { return isWholeInFront(surface, label); });
  if (tissue == 0 || neighbours.empty() || areWhole) return {};
  for (auto& sides : surface.labels) sides[1] = 0;
  return tissue;
}

std::map<Label, SurfaceFile> tissueSurfaces(const SurfaceFile& content)
{
  std::map<Label, std::vector<std::size_t>> trianglesOf;
  for (std::size_t t = 0; t < content.surface.labels.size(); ++t)
  {
    for (const Label label : content.surface.labels[t])
    {
      if (label != 0) trianglesOf[label].push_back(t);
    }
  }
  std::map<Label, SurfaceFile> result;
  PointCopier points(content);
  for (const auto& [label, triangles] : trianglesOf)
  {
    SurfaceFile& part = result[label];
    part.tissues = content.tissues;
    for (const std::size_t t : triangles)
    {
      auto triangle = content.surface.triangles[t];
      auto sides = content.surface.labels[t];
      if (sides[0] != label)
      {
        std::swap(sides[0], sides[1]);
        std::swap(triangle[1], triangle[2]);
      }
      for (std::int32_t& point : triangle) point = points.copy(point, label, part);
      part.surface.triangles.push_back(triangle);
      part.surface.labels.push_back(sides);
    }
  }
  return result;
}

std::string multiBlockIndex(const std::map<Label, std::string>& files, const TissueTable& tissues)
{
  std::string result = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
                       "<VTKFile type=\"vtkMultiBlockDataSet\" version=\"1.0\" byte_order=\"LittleEndian\">\n"
                       "  <vtkMultiBlockDataSet>\n";
  int index = 0;
  for (const auto& [label, file] : files)
  {
    result += "    <DataSet index=\"" + std::to_string(index++) + "\" name=\"" +
              text::xmlEscaped(nameOf(label, tissues)) + "\" file=\"" + text::xmlEscaped(file) + "\"/>\n";
  }
  return result + "  </vtkMultiBlockDataSet>\n</VTKFile>\n";
}

} // namespace surgicalmesher
