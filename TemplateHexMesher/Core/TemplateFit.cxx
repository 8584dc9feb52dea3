// SPDX-License-Identifier: Apache-2.0
#include "TemplateFit.h"

#include "FitEnergy.h"
#include "Parallel.h"
#include "ThinPlateSpline.h"
#include "Validity.h"

#include <algorithm>
#include <cmath>

namespace surgicalmesher
{
namespace
{

using Eigen::Vector3d;

constexpr double kNormalScale = 10;      ///< distance (mm) that weighs as much as a difference of normals of 1
constexpr double kPlaneWeight = 1;       ///< of the squared distance (mm) to the tangent plane at the closest point
constexpr double kPointWeight = 0.3;     ///< of the squared distance to the closest point itself
constexpr double kCreaseWeight = 0.3;    ///< of the squared distance to the nearest crease
constexpr double kCreaseReach = 8;       ///< mm
constexpr double kMutualTolerance = 2;   ///< mm, see mutuality
constexpr double kOrientationReach = 20; ///< mm

/// The surface of the template; its topology does not change during the fit.
struct Outline
{
  std::vector<Face> faces;
  std::vector<std::int32_t> nodes;   ///< of the faces, ascending
  std::vector<std::int32_t> creases; ///< nodes on sharp edges, ascending
};

Outline outlineOf(const ElementMesh& mesh)
{
  Outline outline;
  outline.faces = outerFaces(mesh.elements);
  for (const Face& face : outline.faces)
    outline.nodes.insert(outline.nodes.end(), face.nodes.begin(), face.nodes.begin() + face.size);
  for (const auto& edge : creasesOf({ mesh.points, trianglesOf(outline.faces, mesh.points) }, kCreaseDegrees))
    outline.creases.insert(outline.creases.end(), edge.begin(), edge.end());
  for (auto* ids : { &outline.nodes, &outline.creases })
  {
    std::sort(ids->begin(), ids->end());
    ids->erase(std::unique(ids->begin(), ids->end()), ids->end());
  }
  return outline;
}

/// Returns area-weighted unit normals at the nodes of the faces; a column per point of the mesh.
Points nodeNormals(const std::vector<Face>& faces, const Points& points)
{
  Points normals = Points::Zero(3, points.cols());
  for (const Face& face : faces)
  {
    const auto& n = face.nodes;
    const Vector3d diagonal = points.col(n[2]) - points.col(n[0]);
    const Vector3d other =
      face.size == 3 ? Vector3d(points.col(n[2]) - points.col(n[1])) : Vector3d(points.col(n[3]) - points.col(n[1]));
    const Vector3d area =
      face.size == 3 ? Vector3d(Vector3d(points.col(n[1]) - points.col(n[0])).cross(diagonal)) : diagonal.cross(other);
    for (int i = 0; i < face.size; ++i) normals.col(n[i]) += area;
  }
  return normals.colwise().normalized();
}

/// Adds the pulls that pullOf(node) returns for single nodes, in the order of `nodes`; pulls without weight are left
/// out.
template <typename PullOf>
void addPulls(const std::vector<std::int32_t>& nodes, const PullOf& pullOf, std::vector<Pull>& pulls)
{
  std::vector<Pull> found(nodes.size());
  parallelFor(nodes.size(),
              [&](std::size_t i)
              {
                found[i] = pullOf(nodes[i]);
                found[i].nodes[0] = nodes[i];
                found[i].weights[0] = 1;
              });
  for (const Pull& pull : found)
  {
    if (pull.all != 0 || pull.along != 0) pulls.push_back(pull);
  }
}

/// The cost that TargetSurface::closest() minimises.
double costOf(const SurfacePoint& q, const Vector3d& point, const Vector3d& normal)
{
  return (q.position - point).squaredNorm() + kNormalScale * kNormalScale * (q.normal - normal).squaredNorm();
}

/// Returns 1 if no other point of the template is much closer to the goal than the node drawn to it, 0 if one is. Where
/// sheets lie side by side, such as teeth in gums, no sheet is then drawn to the goal of another.
double mutuality(const TargetSurface& moved, const SurfacePoint& goal, const Vector3d& point, const Vector3d& normal)
{
  const SurfacePoint back = moved.closest(goal.position, goal.normal, kNormalScale);
  const double near = kMutualTolerance * kMutualTolerance;
  const double ratio =
    std::sqrt((costOf(back, goal.position, goal.normal) + near) / (costOf(goal, point, normal) + near));
  return std::clamp((ratio - 0.3) / 0.4, 0.0, 1.0);
}

/// Pulls a node to the tangent plane at the closest point with a similar normal, and weakly to the point itself.
Pull pullToSurface(const TargetSurface& target, const TargetSurface& moved, const Vector3d& point,
                   const Vector3d& normal)
{
  Pull pull;
  const SurfacePoint closest = target.closest(point, normal, kNormalScale);
  if (closest.triangle < 0 || closest.onBorder) return pull;
  const double agreement =
    std::clamp((normal.dot(closest.normal) - 0.2) / 0.5, 0.0, 1.0) * mutuality(moved, closest, point, normal);
  pull.goal = closest.position;
  pull.direction = closest.normal;
  pull.along = kPlaneWeight * agreement;
  pull.all = kPointWeight * agreement;
  return pull;
}

/// Pulls a node on a sharp edge to the nearest sharp edge of the target, along which it may slide.
Pull pullToCrease(const TargetSurface& target, const Vector3d& point)
{
  Pull pull;
  const SurfacePoint closest = target.closestOnCrease(point, kCreaseReach);
  if (closest.triangle < 0) return pull;
  pull.goal = closest.position;
  pull.all = kCreaseWeight;
  return pull;
}

/// The attachment of a landmark to the mesh, at a point that may differ from the landmark.
struct Attachment
{
  Pull pull;
  Vector3d offset = Vector3d::Zero(); ///< from there to the landmark, after the spline
};

/// Attaches each landmark to the closest point of the template's surface, or to a node if one is closer. The attached
/// point is drawn to its position under the spline.
std::vector<Attachment> attached(const ElementMesh& mesh, const Outline& outline, const LandmarkPairs& landmarks,
                                 const ThinPlateSpline& spline, double weight)
{
  const TargetSurface surface({ mesh.points, trianglesOf(outline.faces, mesh.points) });
  std::vector<Attachment> attachments;
  for (Eigen::Index i = 0; i < landmarks.source.cols(); ++i)
  {
    const Vector3d landmark = landmarks.source.col(i);
    const SurfacePoint closest = surface.closest(landmark, Vector3d::Zero(), 0);
    Eigen::Index node = 0;
    const double toNode = std::sqrt((mesh.points.colwise() - landmark).colwise().squaredNorm().minCoeff(&node));
    const bool onSurface = (closest.position - landmark).norm() <= toNode;
    Attachment attachment;
    Pull& pull = attachment.pull;
    if (onSurface)
    {
      std::copy_n(surface.surface().triangles[closest.triangle].begin(), 3, pull.nodes.begin());
      std::copy_n(closest.weights.data(), 3, pull.weights.begin());
    }
    else
    {
      pull.nodes[0] = std::int32_t(node);
      pull.weights[0] = 1;
    }
    pull.goal = spline(pull.position(mesh.points));
    pull.all = weight;
    attachment.offset = landmarks.target.col(i) - pull.goal;
    attachments.push_back(attachment);
  }
  return attachments;
}

class Fit
{
public:
  Fit(const ElementMesh& mesh, const LandmarkPairs& landmarks, const ThinPlateSpline& spline, TargetSurface target,
      const FitOptions& options)
    : m_Mesh(mesh), m_Options(options), m_Target(std::move(target)), m_Outline(outlineOf(mesh)),
      m_Energy({ spline(mesh.points), mesh.elements })
  {
    m_Spline = m_Energy.reference;
    m_Points = m_Spline;
    m_Landmarks = attached(mesh, m_Outline, landmarks, spline, options.landmarkWeight);
    const Points normals = nodeNormals(m_Outline.faces, m_Points);
    Points places(3, Eigen::Index(m_Outline.nodes.size())), theirNormals = places;
    for (std::size_t i = 0; i < m_Outline.nodes.size(); ++i)
    {
      places.col(Eigen::Index(i)) = m_Points.col(m_Outline.nodes[i]);
      theirNormals.col(Eigen::Index(i)) = normals.col(m_Outline.nodes[i]);
    }
    m_Target.orientLike(places, theirNormals, kOrientationReach);
  }

  /// Makes the present shape the reference for smoothness.
  void relax() { m_Energy.reference = m_Points; }

  /// Finds closest points, then minimises the energy.
  void round(const EnergyWeights& weights)
  {
    m_Energy.weights = weights;
    m_Energy.pulls.clear();
    for (const Attachment& landmark : m_Landmarks) m_Energy.pulls.push_back(landmark.pull);
    const Points normals = nodeNormals(m_Outline.faces, m_Points);
    const TargetSurface moved({ m_Points, trianglesOf(m_Outline.faces, m_Points) });
    addPulls(
      m_Outline.nodes,
      [&](std::int32_t node) { return pullToSurface(m_Target, moved, m_Points.col(node), normals.col(node)); },
      m_Energy.pulls);
    addPulls(
      m_Outline.creases, [&](std::int32_t node) { return pullToCrease(m_Target, m_Points.col(node)); }, m_Energy.pulls);
    minimise(m_Energy, m_Points, m_Options.iterations);
  }

  Validity validity() const { return validityOf(m_Mesh.elements, m_Points); }
  std::size_t turnedFacets() const { return m_Energy.turnedFacets(m_Points); }

  FitResult result(int repairRounds) const
  {
    FitResult result{ m_Points, m_Spline, Points(3, Eigen::Index(m_Landmarks.size())), repairRounds, turnedFacets() };
    for (std::size_t i = 0; i < m_Landmarks.size(); ++i)
      result.landmarks.col(Eigen::Index(i)) = m_Landmarks[i].pull.position(m_Points) + m_Landmarks[i].offset;
    return result;
  }

  const Points& points() const { return m_Points; }

private:
  const ElementMesh& m_Mesh;
  FitOptions m_Options;
  TargetSurface m_Target;
  Outline m_Outline;
  FitEnergy m_Energy;
  Points m_Spline, m_Points;
  std::vector<Attachment> m_Landmarks;
};

/// Weight of the mean quality of corners. Better shapes come at the cost of nodes that slide on the target: 0.2 instead
/// of 0.1 gives 0.02 more mean scaled Jacobian and 0.08 mm more error under known warps.
constexpr double kMeanWeight = 0.1;

/// Rounds from stiff to soft, two for each weight.
std::vector<EnergyWeights> fittingRounds(double alpha)
{
  std::vector<EnergyWeights> rounds;
  for (const double factor : { 100, 30, 10, 3, 1 })
  {
    for (int twice = 0; twice < 2; ++twice) rounds.push_back({ alpha * factor, 10, 0.25, kMeanWeight });
  }
  return rounds;
}

/// Weights of the rounds that improve quality and closeness; the reference is reset before each round, so that earlier
/// deformation costs nothing.
EnergyWeights polishing(double alpha) { return { alpha, 60, 0.5, kMeanWeight }; }

/// Fewer rounds for a surface: it has no volume corners to improve, and slides farther with every round.
int polishingRounds(const ElementMesh& mesh)
{
  return std::any_of(mesh.elements.begin(), mesh.elements.end(), [](const Element& e) { return isVolume(e); }) ? 6 : 3;
}

} // namespace

FitResult fitTemplate(const ElementMesh& mesh, const LandmarkPairs& landmarks, TargetSurface target,
                      const FitOptions& options, const Progress& progress)
{
  report(progress, 0, "spline of the landmarks");
  const ThinPlateSpline spline(landmarks.source, landmarks.target);
  Fit fit(mesh, landmarks, spline, std::move(target), options);
  const std::vector<EnergyWeights> rounds = fittingRounds(options.alpha);
  const int polishingCount = polishingRounds(mesh);
  const double count = double(rounds.size()) + polishingCount;
  for (std::size_t i = 0; i < rounds.size(); ++i)
  {
    report(progress, 0.05 + 0.9 * double(i) / count, "fitting the surface");
    fit.round(rounds[i]);
  }
  EnergyWeights weights = polishing(options.alpha);
  for (int i = 0; i < polishingCount; ++i)
  {
    report(progress, 0.05 + 0.9 * (double(rounds.size()) + i) / count, "improving elements");
    fit.relax();
    fit.round(weights);
  }
  int repairRounds = 0;
  Validity validity = fit.validity();
  double before = -2; // least scaled Jacobian before the latest round
  for (; repairRounds < options.repairRounds; ++repairRounds)
  {
    const bool valid = validity.invalid == 0 && fit.turnedFacets() == 0;
    if (valid && (validity.minimum >= options.minimumScaledJacobian || validity.minimum <= before)) break;
    report(progress, 0.95, "repairing elements");
    before = validity.minimum;
    weights.hinge *= 2;
    fit.relax();
    fit.round(weights);
    validity = fit.validity();
  }
  if (validity.invalid > 0)
    refuseInvalid({ fit.points(), mesh.elements }, validity, repairRounds, "do the landmarks match?");
  report(progress, 1, "fitted");
  return fit.result(repairRounds);
}

} // namespace surgicalmesher
