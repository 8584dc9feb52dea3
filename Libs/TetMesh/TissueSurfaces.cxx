// SPDX-License-Identifier: Apache-2.0
#include "TissueSurfaces.h"

#include "Structures.h"

#include <algorithm>

namespace surgicalmesher
{
namespace
{

/// Adds a point of `all` to `part` unless it is there; returns its new id.
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
  std::vector<Label> m_Owner; ///< the tissue that m_Ids is of
};

std::string escaped(const std::string& text)
{
  std::string result;
  for (const char c : text)
  {
    if (c == '&') result += "&amp;";
    else if (c == '<') result += "&lt;";
    else if (c == '>') result += "&gt;";
    else if (c == '"') result += "&quot;";
    else result += c;
  }
  return result;
}

} // namespace

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
  std::string text = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
                     "<VTKFile type=\"vtkMultiBlockDataSet\" version=\"1.0\" byte_order=\"LittleEndian\">\n"
                     "  <vtkMultiBlockDataSet>\n";
  int index = 0;
  for (const auto& [label, file] : files)
  {
    text += "    <DataSet index=\"" + std::to_string(index++) + "\" name=\"" + escaped(nameOf(label, tissues)) +
            "\" file=\"" + escaped(file) + "\"/>\n";
  }
  return text + "  </vtkMultiBlockDataSet>\n</VTKFile>\n";
}

} // namespace surgicalmesher
