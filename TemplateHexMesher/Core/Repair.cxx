// SPDX-License-Identifier: Apache-2.0
#include "Repair.h"

#include "ElementQuality.h"
#include "FitEnergy.h"
#include "Validity.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <map>

namespace surgicalmesher
{
namespace
{

// Of a patch whose mean edge is 1.
constexpr EnergyWeights kWeights{ 1, 10, 0.2, 0 };
constexpr double kPlaceWeight = 0.1; ///< of a node's squared distance to its original position
constexpr double kRimWeight = 1e5;   ///< the same for a node on the rim, which afterwards is reset to its position

constexpr int kSteps = 150;      ///< per round
constexpr double kEnough = 0.02; ///< scaled Jacobian from which an element needs no repair

using Elements = std::vector<Element>;

/// Returns the elements at each node.
std::vector<std::vector<std::int32_t>> elementsAround(const Elements& elements, Eigen::Index nodes)
{
  std::vector<std::vector<std::int32_t>> around(static_cast<std::size_t>(nodes));
  for (std::size_t e = 0; e < elements.size(); ++e)
  {
    for (int i = 0; i < nodeCount(elements[e].shape); ++i)
      around[std::size_t(elements[e].nodes[i])].push_back(std::int32_t(e));
  }
  return around;
}

/// Some elements of a mesh, with nodes renumbered and scaled to a mean edge of 1.
struct Patch
{
  ElementMesh mesh;
  std::vector<std::int32_t> nodes; ///< in the whole mesh
  std::vector<bool> onRim;         ///< whether elements outside the patch share the node
  Eigen::Vector3d middle;
  double unit;
};

Pull pullOf(std::size_t node, const Eigen::Vector3d& goal, double weight)
{
  Pull pull;
  pull.nodes[0] = std::int32_t(node);
  pull.weights[0] = 1;
  pull.goal = goal;
  pull.all = weight;
  return pull;
}

std::vector<Pull> rimPulls(const Patch& patch)
{
  std::vector<Pull> pulls;
  for (std::size_t i = 0; i < patch.nodes.size(); ++i)
  {
    if (patch.onRim[i]) pulls.push_back(pullOf(i, patch.mesh.points.col(Eigen::Index(i)), kRimWeight));
  }
  return pulls;
}

/// Returns the end of the descent from `start`, with the rim exactly where it was.
Points minimum(const FitEnergy& energy, const Patch& patch, Points start)
{
  minimise(energy, start, kSteps);
  for (std::size_t i = 0; i < patch.nodes.size(); ++i)
  {
    if (patch.onRim[i]) start.col(Eigen::Index(i)) = patch.mesh.points.col(Eigen::Index(i));
  }
  return start;
}

/// Returns nodes spread over the patch as smoothly as its rim allows, whatever their positions. A wholly inverted
/// element has scaled Jacobians of -1, the minimum, where the gradient vanishes: descent has to start elsewhere.
Points evened(const Patch& patch)
{
  FitEnergy energy(patch.mesh);
  energy.weights = { 1, 0, kWeights.threshold, 0 };
  energy.reference = Points::Zero(3, patch.mesh.points.cols());
  energy.pulls = rimPulls(patch);
  return minimum(energy, patch, patch.mesh.points);
}

class PatchRepair
{
public:
  explicit PatchRepair(const ElementMesh& mesh)
    : m_Mesh(mesh), m_Around(elementsAround(mesh.elements, mesh.points.cols()))
  {
  }

  /// Runs one round over all places with an element that needs repair, each with the elements within `rings` rings;
  /// returns false if there is none.
  bool improve(Points& points, int rings, double hinge) const
  {
    const std::vector<ElementQuality> quality = elementQuality({ points, m_Mesh.elements });
    std::vector<bool> done(m_Mesh.elements.size(), false);
    bool found = false;
    for (std::size_t e = 0; e < done.size(); ++e)
    {
      if (quality[e].minimum >= kEnough || done[e]) continue;
      found = true;
      const std::vector<std::int32_t> chosen = this->around(std::int32_t(e), rings, quality);
      for (const std::int32_t element : chosen) done[std::size_t(element)] = true;
      this->improve(this->patchOf(chosen, points), hinge, points);
    }
    return found;
  }

private:
  /// Returns the elements within `rings` rings of this element, or of other elements in need of repair that are reached
  /// so.
  std::vector<std::int32_t> around(std::int32_t seed, int rings, const std::vector<ElementQuality>& quality) const
  {
    std::map<std::int32_t, int> left{ { seed, rings } }; // rings still to go from an element
    std::vector<std::int32_t> queue{ seed };
    for (std::size_t n = 0; n < queue.size(); ++n)
    {
      const Element& element = m_Mesh.elements[std::size_t(queue[n])];
      const int further = left.at(queue[n]) - 1;
      if (further < 0) continue;
      for (int i = 0; i < nodeCount(element.shape); ++i)
      {
        for (const std::int32_t next : m_Around[std::size_t(element.nodes[i])])
        {
          const int there = quality[std::size_t(next)].minimum < kEnough ? rings : further;
          const auto [entry, isNew] = left.emplace(next, there);
          if (!isNew && entry->second >= there) continue;
          entry->second = there;
          queue.push_back(next);
        }
      }
    }
    std::vector<std::int32_t> chosen;
    for (const auto& entry : left) chosen.push_back(entry.first);
    return chosen;
  }

  Patch patchOf(const std::vector<std::int32_t>& chosen, const Points& points) const
  {
    Patch patch;
    std::map<std::int32_t, std::int32_t> number;
    std::map<std::int32_t, std::size_t> uses;
    for (const std::int32_t e : chosen)
    {
      Element element = m_Mesh.elements[std::size_t(e)];
      for (int i = 0; i < nodeCount(element.shape); ++i)
      {
        const std::int32_t node = element.nodes[i];
        const auto [entry, isNew] = number.emplace(node, std::int32_t(patch.nodes.size()));
        if (isNew) patch.nodes.push_back(node);
        ++uses[node];
        element.nodes[i] = entry->second;
      }
      patch.mesh.elements.push_back(element);
    }
    for (const std::int32_t node : patch.nodes) patch.onRim.push_back(uses[node] < m_Around[std::size_t(node)].size());
    patch.mesh.points = points(Eigen::all, patch.nodes);
    patch.middle = patch.mesh.points.rowwise().mean();
    double length = 0;
    const auto edges = edgesOf(patch.mesh.elements);
    for (const auto& [a, b] : edges) length += (patch.mesh.points.col(a) - patch.mesh.points.col(b)).norm();
    patch.unit = length > 0 ? length / double(edges.size()) : 1;
    patch.mesh.points = (patch.mesh.points.colwise() - patch.middle) / patch.unit;
    return patch;
  }

  /// Draws each node to its original position. Leaves the patch unchanged if more elements would be invalid.
  void improve(const Patch& patch, double hinge, Points& points) const
  {
    FitEnergy energy(patch.mesh);
    energy.weights = kWeights;
    energy.weights.hinge *= hinge;
    energy.reference = patch.mesh.points;
    energy.pulls = this->pullsOf(patch);
    const auto invalidIn = [&patch](const Points& places) { return validityOf(patch.mesh.elements, places).invalid; };
    Points moved = minimum(energy, patch, patch.mesh.points);
    if (invalidIn(moved) > 0)
    {
      const Points again = minimum(energy, patch, evened(patch));
      if (invalidIn(again) < invalidIn(moved)) moved = again;
    }
    if (invalidIn(moved) > invalidIn(patch.mesh.points)) return;
    for (std::size_t i = 0; i < patch.nodes.size(); ++i)
    {
      if (!patch.onRim[i]) points.col(patch.nodes[i]) = patch.unit * moved.col(Eigen::Index(i)) + patch.middle;
    }
  }

  std::vector<Pull> pullsOf(const Patch& patch) const
  {
    std::vector<Pull> pulls = rimPulls(patch);
    for (std::size_t i = 0; i < patch.nodes.size(); ++i)
    {
      if (!patch.onRim[i])
        pulls.push_back(pullOf(i, (m_Mesh.points.col(patch.nodes[i]) - patch.middle) / patch.unit, kPlaceWeight));
    }
    return pulls;
  }

  const ElementMesh& m_Mesh; ///< as passed to repaired()
  std::vector<std::vector<std::int32_t>> m_Around;
};

} // namespace

Points repaired(const ElementMesh& mesh, int rounds)
{
  Points points = mesh.points;
  if (validityOf(mesh.elements, points).invalid == 0) return points;
  const PatchRepair repair(mesh);
  double hinge = 1;
  for (int round = 0; round < rounds && repair.improve(points, 2 + round / 2, hinge); ++round) hinge *= 1.5;
  return points;
}

} // namespace surgicalmesher
