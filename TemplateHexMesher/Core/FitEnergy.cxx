// SPDX-License-Identifier: Apache-2.0
#include "FitEnergy.h"

#include "Errors.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <deque>

namespace surgicalmesher
{
namespace
{

using Eigen::Vector3d;
using Sparse = Eigen::SparseMatrix<double>;
using Factor = Eigen::SimplicialLDLT<Sparse>;

constexpr double kLeastFacing = 0.05; ///< least facing() required of corners that are turned over before the fit

Sparse graphLaplacian(const ElementMesh& mesh)
{
  const auto edges = edgesOf(mesh.elements);
  std::vector<int> degree(mesh.points.cols(), 0);
  for (const auto& edge : edges)
  {
    ++degree[edge[0]];
    ++degree[edge[1]];
  }
  std::vector<Eigen::Triplet<double>> entries;
  for (const auto& edge : edges)
  {
    entries.emplace_back(edge[0], edge[1], -1.0 / degree[edge[0]]);
    entries.emplace_back(edge[1], edge[0], -1.0 / degree[edge[1]]);
  }
  for (std::size_t i = 0; i < degree.size(); ++i)
  {
    if (degree[i] > 0) entries.emplace_back(int(i), int(i), 1);
  }
  Sparse laplacian(mesh.points.cols(), mesh.points.cols());
  laplacian.setFromTriplets(entries.begin(), entries.end());
  return laplacian;
}

/// Solves for the three coordinates in one pass over the factor, where Eigen's own solver takes one for each.
Points solved(const Factor& factor, const Points& right)
{
  const Sparse& lower = factor.matrixL().nestedExpression();
  const auto& order = factor.permutationP().indices();
  const auto diagonal = factor.vectorD();
  Points x(3, right.cols());
  for (Eigen::Index i = 0; i < right.cols(); ++i) x.col(order[i]) = right.col(i);
  for (Eigen::Index j = 0; j < x.cols(); ++j)
  {
    const Vector3d value = x.col(j);
    for (Sparse::InnerIterator entry(lower, j); entry; ++entry)
    {
      if (entry.row() > j) x.col(entry.row()) -= entry.value() * value;
    }
  }
  for (Eigen::Index j = x.cols(); j-- > 0;)
  {
    Vector3d value = x.col(j) / diagonal[j];
    for (Sparse::InnerIterator entry(lower, j); entry; ++entry)
    {
      if (entry.row() > j) value -= entry.value() * x.col(entry.row());
    }
    x.col(j) = value;
  }
  Points result(3, right.cols());
  for (Eigen::Index i = 0; i < right.cols(); ++i) result.col(i) = x.col(order[i]);
  return result;
}

/// The latest steps and changes of the gradient, the last one last.
class Memory
{
public:
  void add(const Points& step, const Points& change)
  {
    const double product = step.cwiseProduct(change).sum();
    if (!(product > 1e-12 * step.norm() * change.norm())) return;
    m_Pairs.push_back({ step, change, 1 / product });
    if (m_Pairs.size() > 10) m_Pairs.pop_front();
  }

  /// The two-loop recursion (Nocedal, Wright, Numerical Optimization, algorithm 7.4).
  Points direction(const Points& gradient, const Factor& factor) const
  {
    Points q = gradient;
    std::vector<double> a(m_Pairs.size());
    for (std::size_t i = m_Pairs.size(); i-- > 0;)
    {
      a[i] = m_Pairs[i].inverse * m_Pairs[i].step.cwiseProduct(q).sum();
      q -= a[i] * m_Pairs[i].change;
    }
    Points r = solved(factor, q);
    for (std::size_t i = 0; i < m_Pairs.size(); ++i)
    {
      const double b = m_Pairs[i].inverse * m_Pairs[i].change.cwiseProduct(r).sum();
      r += (a[i] - b) * m_Pairs[i].step;
    }
    return -r;
  }

private:
  struct Pair
  {
    Points step, change;
    double inverse;
  };
  std::deque<Pair> m_Pairs;
};

} // namespace

Vector3d Pull::position(const Points& points) const
{
  Vector3d p = Vector3d::Zero();
  for (int i = 0; i < 4; ++i)
  {
    if (weights[i] != 0) p += weights[i] * points.col(nodes[i]);
  }
  return p;
}

std::vector<FacetCorner> facetCorners(const std::vector<Element>& elements, const Points& points)
{
  std::vector<FacetCorner> corners;
  for (std::size_t e = 0; e < elements.size(); ++e)
  {
    const Element& element = elements[e];
    if (isVolume(element)) continue;
    const int count = nodeCount(element.shape);
    const auto& n = element.nodes;
    Vector3d area = Vector3d::Zero();
    for (int i = 1; i + 1 < count; ++i)
      area += Vector3d(points.col(n[i]) - points.col(n[0])).cross(Vector3d(points.col(n[i + 1]) - points.col(n[0])));
    for (int i = 0; i < count; ++i)
    {
      FacetCorner corner{
        n[i], n[(i + 1) % count], n[(i + count - 1) % count], std::int32_t(e), {}, 0, count == 3 ? std::sqrt(0.75) : 1
      };
      const Vector3d own = Vector3d(points.col(corner.first) - points.col(corner.node))
                             .cross(Vector3d(points.col(corner.second) - points.col(corner.node)));
      corner.normal = (own.dot(area) > 0 ? own : area).normalized();
      corner.before = facing(corner, points);
      corners.push_back(corner);
    }
  }
  return corners;
}

double facing(const FacetCorner& corner, const Points& points)
{
  const Vector3d a = points.col(corner.first) - points.col(corner.node),
                 b = points.col(corner.second) - points.col(corner.node);
  const double lengths = std::sqrt(a.squaredNorm() * b.squaredNorm());
  return lengths > 0 ? corner.normal.dot(a.cross(b)) / lengths : 0;
}

FitEnergy::FitEnergy(const ElementMesh& mesh)
  : reference(mesh.points), m_Corners(cornersOf(mesh.elements)),
    m_FacetCorners(facetCorners(mesh.elements, mesh.points)), m_Laplacian(graphLaplacian(mesh)),
    m_LaplacianTransposed(m_Laplacian.transpose()), m_Squared(m_LaplacianTransposed * m_Laplacian)
{
}

double FitEnergy::evaluate(const Points& points, Points& gradient) const
{
  gradient.setZero(3, points.cols());
  return addQuality(points, gradient) + addFacing(points, gradient) + addSmoothness(points, gradient) +
         addPulls(points, gradient);
}

double FitEnergy::addQuality(const Points& points, Points& gradient) const
{
  if (weights.hinge == 0 && weights.mean == 0) return 0;
  const double t = weights.threshold;
  double sum = 0;
  for (const Corner& corner : m_Corners)
  {
    const Vector3d origin = points.col(corner.node);
    const Vector3d a = points.col(corner.first) - origin, b = points.col(corner.second) - origin,
                   c = points.col(corner.third) - origin;
    const double aa = a.squaredNorm(), bb = b.squaredNorm(), cc = c.squaredNorm();
    const double lengths = std::sqrt(aa * bb * cc);
    if (!(lengths > 0)) continue; // no gradient is defined here; the smoothness term separates the nodes
    const Vector3d bc = b.cross(c), ca = c.cross(a), ab = a.cross(b);
    const double s = a.dot(bc) / lengths;
    const double lack = std::max(0.0, t * corner.best - s) / t;
    sum += weights.hinge * lack * lack + weights.mean * (corner.best - s);
    const double slope = -2 * weights.hinge * lack / t - weights.mean;
    const Vector3d toA = slope * (bc / lengths - a * (s / aa)), toB = slope * (ca / lengths - b * (s / bb)),
                   toC = slope * (ab / lengths - c * (s / cc));
    gradient.col(corner.first) += toA;
    gradient.col(corner.second) += toB;
    gradient.col(corner.third) += toC;
    gradient.col(corner.node) -= toA + toB + toC;
  }
  return sum;
}

double FitEnergy::addFacing(const Points& points, Points& gradient) const
{
  const double t = weights.threshold;
  double sum = 0;
  for (const FacetCorner& corner : m_FacetCorners)
  {
    const double least = std::min(t * corner.best, std::max(0.5 * corner.before, kLeastFacing));
    const Vector3d origin = points.col(corner.node);
    const Vector3d a = points.col(corner.first) - origin, b = points.col(corner.second) - origin;
    const double aa = a.squaredNorm(), bb = b.squaredNorm(), lengths = std::sqrt(aa * bb);
    if (!(lengths > 0)) continue;
    const double s = corner.normal.dot(a.cross(b)) / lengths;
    if (s >= least) continue;
    const double lack = (least - s) / t;
    sum += weights.hinge * lack * lack;
    const double slope = -2 * weights.hinge * lack / t;
    const Vector3d toA = slope * (b.cross(corner.normal) / lengths - a * (s / aa)),
                   toB = slope * (corner.normal.cross(a) / lengths - b * (s / bb));
    gradient.col(corner.first) += toA;
    gradient.col(corner.second) += toB;
    gradient.col(corner.node) -= toA + toB;
  }
  return sum;
}

double FitEnergy::addSmoothness(const Points& points, Points& gradient) const
{
  const Eigen::MatrixXd displacement = (points - reference).transpose();
  const Eigen::MatrixXd rough = m_Laplacian * displacement;
  const Eigen::MatrixXd slope = m_LaplacianTransposed * rough;
  gradient += 2 * weights.smoothness * slope.transpose();
  return weights.smoothness * rough.squaredNorm();
}

double FitEnergy::addPulls(const Points& points, Points& gradient) const
{
  double sum = 0;
  for (const Pull& pull : pulls)
  {
    const Vector3d d = pull.position(points) - pull.goal;
    const double distance = pull.direction.dot(d);
    sum += pull.along * distance * distance + pull.all * d.squaredNorm();
    const Vector3d slope = 2 * (pull.along * distance * pull.direction + pull.all * d);
    for (int i = 0; i < 4; ++i)
    {
      if (pull.weights[i] != 0) gradient.col(pull.nodes[i]) += pull.weights[i] * slope;
    }
  }
  return sum;
}

std::size_t FitEnergy::turnedFacets(const Points& points) const
{
  std::size_t turned = 0;
  std::int32_t last = -1; // corners of one element are neighbours
  for (const FacetCorner& corner : m_FacetCorners)
  {
    if (corner.element == last || corner.before <= 0 || facing(corner, points) > 0) continue;
    last = corner.element;
    ++turned;
  }
  return turned;
}

Sparse FitEnergy::preconditioner() const
{
  std::vector<Eigen::Triplet<double>> entries;
  double largest = 0;
  for (const Pull& pull : pulls)
  {
    const double weight = pull.all + pull.along / 3;
    largest = std::max(largest, weight);
    for (int i = 0; i < 4; ++i)
    {
      for (int j = 0; j < 4; ++j)
      {
        const double product = weight * pull.weights[i] * pull.weights[j];
        if (product != 0) entries.emplace_back(pull.nodes[i], pull.nodes[j], product);
      }
    }
  }
  // The small diagonal keeps the matrix regular for points that no element uses.
  for (int i = 0; i < int(reference.cols()); ++i) entries.emplace_back(i, i, 1e-6 * (1 + largest));
  Sparse data(reference.cols(), reference.cols());
  data.setFromTriplets(entries.begin(), entries.end());
  return 2 * (weights.smoothness * m_Squared + data);
}

int minimise(const FitEnergy& energy, Points& points, int iterations)
{
  const Factor factor(energy.preconditioner());
  if (factor.info() != Eigen::Success) throw EngineError("fit: the equations of the first step have no solution");
  Memory memory;
  Points gradient, nextGradient;
  double value = energy.evaluate(points, gradient);
  for (int iteration = 0; iteration < iterations; ++iteration)
  {
    Points direction = memory.direction(gradient, factor);
    double slope = direction.cwiseProduct(gradient).sum();
    if (!(slope < 0)) return iteration;
    double length = 1, nextValue = 0;
    Points next;
    bool found = false;
    for (int halving = 0; halving < 30 && !found; ++halving, length *= found ? 1 : 0.5)
    {
      next = points + length * direction;
      nextValue = energy.evaluate(next, nextGradient);
      found = nextValue <= value + 1e-4 * length * slope;
    }
    if (!found) return iteration;
    memory.add(next - points, nextGradient - gradient);
    const double gain = value - nextValue;
    points = next;
    gradient = nextGradient;
    value = nextValue;
    if (gain < 1e-7 * value) return iteration + 1;
  }
  return iterations;
}

} // namespace surgicalmesher
