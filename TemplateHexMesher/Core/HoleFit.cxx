// SPDX-License-Identifier: Apache-2.0
#include "HoleFit.h"

#include "FitEnergy.h"
#include "TargetSurface.h"
#include "Validity.h"

#include <algorithm>
#include <limits>
#include <optional>

namespace surgicalmesher
{
namespace
{

using Eigen::Vector3d;

constexpr int kRings = 3;
constexpr int kRounds = 6;
constexpr int kSteps = 15;
constexpr double kPoor = 0.2;           ///< scaled Jacobian under which an element is improved
constexpr double kPlaneWeight = 1;      ///< of the squared distance (mm) to the tangent plane at a side's closest point
constexpr double kPointWeight = 0.02;   ///< of the squared distance to the closest point itself
constexpr double kBorderWeight = 1;     ///< of the squared distance to a hole's border
constexpr double kFaceWeight = 2;       ///< of the squared distance of a face's centre to such a plane
constexpr double kHeldWeight = 1e3;     ///< of the squared distance of fixed nodes to their position
constexpr std::size_t kAllMove = 20000; ///< nodes; finer meshes need this less, and the system grows with the mesh

struct SidePatches
{
  std::array<std::optional<TargetSurface>, kSides> patches; ///< empty: the side has no triangle
};

SidePatches patchesOf(const Envelope& envelope)
{
  SidePatches result;
  for (int s = 0; s < kSides; ++s)
  {
    std::vector<Triangle> triangles;
    for (std::size_t t = 0; t < envelope.sides.size(); ++t)
    {
      if (envelope.sides[t] == Side(s)) triangles.push_back(envelope.surface.triangles[t]);
    }
    if (!triangles.empty()) result.patches[s].emplace(compacted(envelope.surface.points, triangles));
  }
  return result;
}

/// Returns the sides of the envelope on which a node lies.
std::vector<Side> sidesOf(const LayeredMesh& mesh, std::size_t node)
{
  constexpr Side low[3] = { Side::Right, Side::Outer, Side::Bottom }, high[3] = { Side::Left, Side::Inner, Side::Top };
  std::vector<Side> sides;
  for (int axis = 0; axis < 3; ++axis)
  {
    if (mesh.nodes[node][axis] == 0) sides.push_back(low[axis]);
    if (mesh.nodes[node][axis] == mesh.divisions[axis]) sides.push_back(high[axis]);
  }
  return sides;
}

Vector3d closestOn(const HoleBorders& borders, const Vector3d& point)
{
  Vector3d best = point;
  double least = std::numeric_limits<double>::max();
  for (const auto& loop : borders)
  {
    for (std::size_t i = 0; i < loop.size(); ++i)
    {
      const Vector3d& a = loop[i];
      const Vector3d along = loop[(i + 1) % loop.size()] - a;
      const double length = along.squaredNorm();
      const double at = length > 0 ? std::clamp((point - a).dot(along) / length, 0.0, 1.0) : 0;
      const Vector3d candidate = a + at * along;
      if ((candidate - point).squaredNorm() >= least) continue;
      least = (candidate - point).squaredNorm();
      best = candidate;
    }
  }
  return best;
}

/// The elements with a movable node, and their nodes, as a mesh of its own.
class Region
{
public:
  Region(const LayeredMesh& whole, const std::vector<char>& moves) : m_Id(whole.nodes.size(), -1)
  {
    for (const Element& element : whole.mesh.elements)
    {
      if (std::none_of(element.nodes.begin(), element.nodes.end(), [&](std::int32_t n) { return moves[n] != 0; }))
        continue;
      part.elements.push_back(element);
      for (std::int32_t& node : part.elements.back().nodes)
      {
        if (m_Id[node] < 0)
        {
          m_Id[node] = std::int32_t(nodes.size());
          nodes.push_back(node);
        }
        node = m_Id[node];
      }
    }
    part.points.resize(3, Eigen::Index(nodes.size()));
    for (std::size_t i = 0; i < nodes.size(); ++i)
    {
      part.points.col(Eigen::Index(i)) = whole.mesh.points.col(nodes[i]);
      held.push_back(!moves[nodes[i]]);
    }
  }

  ElementMesh part;
  std::vector<std::int32_t> nodes; ///< node of the whole mesh, by node of the part
  std::vector<char> held;

private:
  std::vector<std::int32_t> m_Id;
};

class HoleFit
{
public:
  HoleFit(LayeredMesh& mesh, const Envelope& envelope, const std::array<HoleBorders, 2>& borders)
    : m_Mesh(mesh), m_Patches(patchesOf(envelope)), m_Borders(borders)
  {
  }

  /// Runs rounds of descent over the region that currently needs it; does nothing if the region is empty.
  void rounds(int count, EnergyWeights weights)
  {
    const std::vector<char> moves = moving();
    Region region(m_Mesh, moves);
    if (region.nodes.empty()) return;
    FitEnergy energy(region.part);
    energy.weights = weights;
    Points points = region.part.points;
    for (int round = 0; round < count; ++round)
    {
      energy.reference = points;
      energy.pulls = pulls(region, points);
      minimise(energy, points, kSteps);
      for (std::size_t i = 0; i < region.nodes.size(); ++i)
      {
        if (region.held[i]) points.col(Eigen::Index(i)) = region.part.points.col(Eigen::Index(i));
      }
    }
    for (std::size_t i = 0; i < region.nodes.size(); ++i)
      m_Mesh.mesh.points.col(region.nodes[i]) = points.col(Eigen::Index(i));
  }

private:
  bool isCoarse() const { return m_Mesh.nodes.size() <= kAllMove; }

  std::vector<char> moving() const
  {
    if (isCoarse()) return std::vector<char>(m_Mesh.nodes.size(), 1);
    std::vector<char> moves = m_Mesh.atHole;
    const std::vector<ElementQuality> quality = elementQuality(m_Mesh.mesh);
    for (std::size_t e = 0; e < quality.size(); ++e)
    {
      if (quality[e].minimum >= kPoor) continue;
      for (const std::int32_t node : m_Mesh.mesh.elements[e].nodes) moves[node] = 1;
    }
    for (int ring = 0; ring < kRings; ++ring)
    {
      std::vector<char> wider = moves;
      for (const Element& element : m_Mesh.mesh.elements)
      {
        if (std::none_of(element.nodes.begin(), element.nodes.end(), [&](std::int32_t n) { return moves[n] != 0; }))
          continue;
        for (const std::int32_t node : element.nodes) wider[node] = 1;
      }
      moves = wider;
    }
    return moves;
  }

  std::vector<Pull> pulls(const Region& region, const Points& points) const
  {
    std::vector<Pull> result;
    for (std::size_t i = 0; i < region.nodes.size(); ++i)
    {
      const Vector3d point = points.col(Eigen::Index(i));
      Pull pull;
      pull.nodes[0] = std::int32_t(i);
      pull.weights[0] = 1;
      pull.goal = region.part.points.col(Eigen::Index(i));
      pull.all = kHeldWeight;
      if (region.held[i]) result.push_back(pull);
      else addSlidingPulls(std::size_t(region.nodes[i]), point, pull, result);
    }
    if (isCoarse()) addFacePulls(region, points, result);
    return result;
  }

  /// With only its nodes on a curved surface, a face lies on the concave side of the surface: its centre is drawn to
  /// the surface as well.
  void addFacePulls(const Region& region, const Points& points, std::vector<Pull>& result) const
  {
    for (const Face& face : outerFaces(region.part.elements))
    {
      const auto isOn = [&](int layer)
      {
        return std::all_of(face.nodes.begin(), face.nodes.end(),
                           [&](std::int32_t n) { return m_Mesh.nodes[std::size_t(region.nodes[n])][1] == layer; });
      };
      const Side side = isOn(0) ? Side::Outer : isOn(m_Mesh.divisions[1]) ? Side::Inner : Side::Hole;
      if (side == Side::Hole) continue;
      Pull pull;
      pull.nodes = face.nodes;
      pull.weights.fill(0.25);
      const SurfacePoint closest =
        m_Patches.patches[std::size_t(side)]->closest(pull.position(points), Vector3d::Zero(), 0);
      pull.goal = closest.position;
      pull.direction = closest.normal;
      pull.along = kFaceWeight;
      result.push_back(pull);
    }
  }

  void addSlidingPulls(std::size_t node, const Vector3d& point, Pull pull, std::vector<Pull>& result) const
  {
    const int layer = m_Mesh.nodes[node][1];
    const bool atSurface = layer == 0 || layer == m_Mesh.divisions[1];
    std::vector<Side> sides = sidesOf(m_Mesh, node);
    if (m_Mesh.atHole[node] && !atSurface) sides.push_back(Side::Hole);
    for (const Side side : sides)
    {
      const auto& patch = m_Patches.patches[std::size_t(side)];
      if (!patch) continue;
      const SurfacePoint closest = patch->closest(point, Vector3d::Zero(), 0);
      pull.goal = closest.position;
      pull.direction = closest.normal;
      pull.along = kPlaneWeight;
      pull.all = kPointWeight;
      result.push_back(pull);
    }
    if (!m_Mesh.atHole[node] || !atSurface) return;
    pull.goal = closestOn(m_Borders[layer == 0 ? 0 : 1], point);
    pull.along = 0;
    pull.all = kBorderWeight;
    result.push_back(pull);
  }

  LayeredMesh& m_Mesh;
  SidePatches m_Patches;
  std::array<HoleBorders, 2> m_Borders;
};

} // namespace

void fitToHoles(LayeredMesh& mesh, const Envelope& envelope, const std::array<HoleBorders, 2>& borders,
                int repairRounds, const Progress& progress)
{
  report(progress, 0, "fitting the holes' borders");
  HoleFit fit(mesh, envelope, borders);
  EnergyWeights weights{ 0.3, 10, 0.4, 0.2 };
  fit.rounds(kRounds, weights);
  Validity validity = validityOf(mesh.mesh.elements, mesh.mesh.points);
  double before = -2; // least scaled Jacobian before the latest round
  for (int round = 0; round < repairRounds; ++round)
  {
    if (validity.invalid == 0 && (validity.minimum >= kPoor || validity.minimum <= before)) break;
    report(progress, 0.9, "repairing elements");
    before = validity.minimum;
    weights.hinge *= 2;
    fit.rounds(1, weights);
    validity = validityOf(mesh.mesh.elements, mesh.mesh.points);
  }
  if (validity.invalid > 0) refuseInvalid(mesh.mesh, validity, repairRounds, "are the sides right?");
}

} // namespace surgicalmesher
