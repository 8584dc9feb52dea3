// SPDX-License-Identifier: Apache-2.0
#include "PartOverlap.h"

#include "Errors.h"
#include "InsideTest.h"
#include "Parallel.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

namespace surgicalmesher
{
namespace
{

using Eigen::Vector3d;

constexpr int kSamples = 6; ///< points along each edge of an element

/// A point of a trilinear hexahedron and the Jacobian determinant there.
struct Sample
{
  Vector3d position;
  double density;
};

Sample sampleAt(const Eigen::Matrix<double, 3, 8>& corners, const Vector3d& at)
{
  Vector3d position = Vector3d::Zero();
  Eigen::Matrix3d jacobian = Eigen::Matrix3d::Zero();
  constexpr int places[8][3] = { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 },
                                 { 0, 0, 1 }, { 1, 0, 1 }, { 1, 1, 1 }, { 0, 1, 1 } };
  for (int c = 0; c < 8; ++c)
  {
    Vector3d factor, slope;
    for (int axis = 0; axis < 3; ++axis)
    {
      factor[axis] = places[c][axis] ? at[axis] : 1 - at[axis];
      slope[axis] = places[c][axis] ? 1 : -1;
    }
    position += factor.prod() * corners.col(c);
    jacobian += corners.col(c) * Vector3d(slope[0] * factor[1] * factor[2], factor[0] * slope[1] * factor[2],
                                          factor[0] * factor[1] * slope[2])
                                   .transpose();
  }
  return { position, std::abs(jacobian.determinant()) };
}

/// The share of a hexahedron's volume that lies inside.
double shareInside(const Element& element, const Points& points, const InsideTest& inside)
{
  Eigen::Matrix<double, 3, 8> corners;
  for (int c = 0; c < 8; ++c) corners.col(c) = points.col(element.nodes[c]);
  if (!inside.box().intersects({ corners.rowwise().minCoeff(), corners.rowwise().maxCoeff() })) return 0;
  double all = 0, within = 0;
  for (int s = 0; s < kSamples * kSamples * kSamples; ++s)
  {
    const Eigen::Array3i place(s % kSamples, s / kSamples % kSamples, s / kSamples / kSamples);
    const Sample sample = sampleAt(corners, (place.cast<double>() + 0.5) / kSamples);
    all += sample.density;
    if (inside.contains(sample.position)) within += sample.density;
  }
  return all > 0 ? within / all : 0;
}

/// Whether a vertex or the centre of a triangle lies in an element. A thin part may lie between the samples of all
/// elements.
bool reachesInto(const TriangleSurface& part, const ElementMesh& mesh)
{
  const TriangleSurface outside{ mesh.points, trianglesOf(outerFaces(mesh.elements), mesh.points) };
  const InsideTest inside(outside, "elements");
  const auto centreIsInside = [&](const Triangle& t)
  { return inside.contains((part.points.col(t[0]) + part.points.col(t[1]) + part.points.col(t[2])) / 3); };
  for (Eigen::Index i = 0; i < part.points.cols(); ++i)
  {
    if (inside.contains(part.points.col(i))) return true;
  }
  return std::any_of(part.triangles.begin(), part.triangles.end(), centreIsInside);
}

/// Returns the share above which the elements' volume is closest to `volume`, half-way between the shares of two
/// elements.
double cutOffFor(double volume, const std::vector<double>& shares, const std::vector<double>& volumes)
{
  std::map<double, double, std::greater<>> volumeByShare;
  for (std::size_t e = 0; e < shares.size(); ++e)
  {
    if (shares[e] > 0) volumeByShare[shares[e]] += volumes[e];
  }
  double sum = 0, last = 1;
  for (const auto& [share, more] : volumeByShare)
  {
    if (std::abs(sum + more - volume) > std::abs(sum - volume)) return (last + share) / 2;
    sum += more;
    last = share;
  }
  return last / 2;
}

void assign(const std::vector<std::vector<double>>& shares, Classification& result)
{
  for (std::size_t e = 0; e < result.part.size(); ++e)
  {
    double largest = 0;
    for (std::size_t p = 0; p < shares.size(); ++p)
    {
      if (shares[p][e] <= std::max(largest, result.matches[p].cutOff)) continue;
      largest = shares[p][e];
      result.part[e] = std::int32_t(p + 1);
    }
  }
}

void measure(const std::vector<double>& volumes, const std::vector<std::vector<double>>& shares, Classification& result)
{
  std::vector<double> shared(shares.size(), 0);
  for (std::size_t e = 0; e < volumes.size(); ++e)
  {
    if (result.part[e] == 0) continue;
    const auto p = std::size_t(result.part[e] - 1);
    ++result.matches[p].elements;
    result.matches[p].elementVolume += volumes[e];
    shared[p] += shares[p][e] * volumes[e];
  }
  for (std::size_t p = 0; p < shares.size(); ++p)
  {
    PartMatch& match = result.matches[p];
    match.recall = match.partVolume > 0 ? shared[p] / match.partVolume : 0;
    match.precision = match.elementVolume > 0 ? shared[p] / match.elementVolume : 0;
  }
}

} // namespace

Classification classified(const ElementMesh& mesh, const std::vector<Part>& parts, const std::vector<double>& cutOffs)
{
  const std::size_t count = mesh.elements.size();
  std::vector<double> volumes(count);
  for (std::size_t e = 0; e < count; ++e) volumes[e] = volumeOf(mesh.elements[e], mesh.points);
  Classification result{ std::vector<std::int32_t>(count, 0), std::vector<PartMatch>(parts.size()) };
  std::vector<std::vector<double>> shares(parts.size(), std::vector<double>(count));
  for (std::size_t p = 0; p < parts.size(); ++p)
  {
    const InsideTest inside(parts[p].surface, parts[p].file);
    parallelFor(count, [&](std::size_t e) { shares[p][e] = shareInside(mesh.elements[e], mesh.points, inside); });
    const bool missed = std::all_of(shares[p].begin(), shares[p].end(), [](double share) { return share == 0; });
    if (missed && !reachesInto(parts[p].surface, mesh))
      throw InputError(parts[p].file + ": outside all elements, expected a part of the tissue");
    PartMatch& match = result.matches[p];
    match.partVolume = volumeInside(parts[p].surface, inside);
    match.cutOff = cutOffs[p] > 0 ? cutOffs[p] : cutOffFor(match.partVolume, shares[p], volumes);
  }
  assign(shares, result);
  measure(volumes, shares, result);
  return result;
}

} // namespace surgicalmesher
