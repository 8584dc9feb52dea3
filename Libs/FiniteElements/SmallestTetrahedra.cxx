// SPDX-License-Identifier: Apache-2.0
#include "SmallestTetrahedra.h"

#include "ConstitutiveTags.h"
#include "FaceAdjacency.h"
#include "LinearTetrahedron.h"
#include "MeshQuality.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <set>

namespace surgicalmesher
{
namespace
{

std::vector<std::int32_t> byHeight(const TetMesh& mesh, std::size_t count)
{
  std::vector<std::pair<double, std::int32_t>> heights;
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t)
  {
    const auto p = cornersOf(mesh, t);
    heights.emplace_back(leastHeight(p[0], p[1], p[2], p[3]), std::int32_t(t));
  }
  const auto end = heights.begin() + std::ptrdiff_t(std::min(count, heights.size()));
  std::partial_sort(heights.begin(), end, heights.end());
  std::vector<std::int32_t> result;
  std::transform(heights.begin(), end, std::back_inserter(result), [](const auto& pair) { return pair.second; });
  return result;
}

/// Returns the labels at each point, including 0 on the hull.
std::vector<std::set<Label>> labelsAtPoints(const TetMesh& mesh, const FaceAdjacency& neighbours)
{
  std::vector<std::set<Label>> labels(mesh.points.size());
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t)
  {
    for (const std::int32_t id : mesh.tetrahedra[t]) labels[id].insert(mesh.labels[t]);
    for (int f = 0; f < 4; ++f)
      if (neighbours.across[t][f] < 0)
        for (const int c : kFaceCorners[f]) labels[mesh.tetrahedra[t][c]].insert(0);
  }
  return labels;
}

/// Returns the distance from the centroid of tetrahedron t along a unit vector to the end of its tissue.
double distanceToBoundary(const TetMesh& mesh, const FaceAdjacency& neighbours, std::int32_t t, const Vec3& direction)
{
  const Label label = mesh.labels[t];
  const auto centre = [&](std::int32_t i)
  {
    const auto p = cornersOf(mesh, std::size_t(i));
    return 0.25 * (p[0] + p[1] + p[2] + p[3]);
  };
  const Vec3 from = centre(t);
  double reached = 0;
  // Rounding could make the walk cycle at an edge; visiting as many tetrahedra as there are is enough.
  for (std::size_t steps = 0; steps < mesh.tetrahedra.size(); ++steps)
  {
    const LinearTetrahedron element = linearTetrahedron(cornersOf(mesh, std::size_t(t)));
    double leave = std::numeric_limits<double>::infinity();
    int through = 0;
    for (int f = 0; f < 4; ++f)
    {
      const double slope = dot(element.gradients[f], direction); // of the barycentric coordinate that is 0 on face f
      if (!(slope < 0)) continue;
      const double at = -(0.25 + dot(element.gradients[f], from - centre(t))) / slope;
      if (at < leave) leave = at, through = f;
    }
    reached = std::max(reached, leave);
    t = neighbours.across[t][through];
    if (t < 0 || mesh.labels[t] != label) break;
  }
  return reached;
}

/// Returns the thickness of the tissue in the direction of the least height, which is that of the steepest barycentric
/// coordinate.
double thicknessAt(const TetMesh& mesh, const FaceAdjacency& neighbours, std::int32_t t)
{
  const auto gradients = linearTetrahedron(cornersOf(mesh, std::size_t(t))).gradients;
  const Vec3 steepest = *std::max_element(gradients.begin(), gradients.end(),
                                          [](const Vec3& a, const Vec3& b) { return squaredNorm(a) < squaredNorm(b); });
  const Vec3 direction = steepest / norm(steepest);
  return distanceToBoundary(mesh, neighbours, t, direction) + distanceToBoundary(mesh, neighbours, t, -direction);
}

SmallBecause reasonOf(bool isHeld, std::size_t mostLabels, double thickness, double edgeLength)
{
  if (isHeld) return SmallBecause::NullDisplacement;
  if (mostLabels > 2) return SmallBecause::Junction;
  if (thickness < edgeLength) return SmallBecause::ThinTissue;
  return mostLabels == 2 ? SmallBecause::Boundary : SmallBecause::Inside;
}

} // namespace

const char* nameOf(SmallBecause reason)
{
  switch (reason)
  {
  case SmallBecause::NullDisplacement: return "null displacement";
  case SmallBecause::Junction: return "junction";
  case SmallBecause::ThinTissue: return "thin tissue";
  case SmallBecause::Boundary: return "boundary";
  case SmallBecause::Inside: break;
  }
  return "inside";
}

std::vector<SmallTetrahedron> smallestTetrahedra(const MeshFile& content, std::size_t count)
{
  const TetMesh& mesh = content.mesh;
  const FaceAdjacency neighbours = faceAdjacency(mesh);
  const std::vector<std::set<Label>> labels = labelsAtPoints(mesh, neighbours);
  std::vector<SmallTetrahedron> result;
  for (const std::int32_t t : byHeight(mesh, count))
  {
    SmallTetrahedron small;
    small.tetrahedron = t;
    const auto p = cornersOf(mesh, std::size_t(t));
    small.height = leastHeight(p[0], p[1], p[2], p[3]);
    small.place = 0.25 * (p[0] + p[1] + p[2] + p[3]);
    std::size_t mostLabels = 0;
    for (const std::int32_t id : mesh.tetrahedra[t])
    {
      small.edgeLength += 0.25 * content.targetEdgeLength[id];
      mostLabels = std::max(mostLabels, labels[id].size());
    }
    small.thickness = thicknessAt(mesh, neighbours, t);
    const bool isHeld = !content.constitutive.empty() && content.constitutive[t] == kNullDisplacement;
    small.reason = reasonOf(isHeld, mostLabels, small.thickness, small.edgeLength);
    result.push_back(small);
  }
  return result;
}

} // namespace surgicalmesher
