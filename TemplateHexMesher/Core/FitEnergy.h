// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Energy that fits a template to a patient with valid elements. It combines the quality of all corners, the smoothness
/// of the displacements from a reference, and pulls towards the target, and is minimised over all nodes at once.

#include "ElementQuality.h"

#include <Eigen/Sparse>
#include <Eigen/SparseCholesky>

#include <vector>

namespace surgicalmesher
{

/// Quadratic pull of a point, given as a weighted mean of nodes, to a goal: along (direction . d)^2 + all |d|^2, with d
/// the displacement from the goal. `along` may be negative, down to -all: with along = -all the point slides freely
/// along `direction`.
struct Pull
{
  std::array<std::int32_t, 4> nodes{};
  std::array<double, 4> weights{}; ///< sum 1; 0 for nodes not used
  Eigen::Vector3d goal = Eigen::Vector3d::Zero();
  Eigen::Vector3d direction = Eigen::Vector3d::Zero(); ///< unit length, or zero
  double along = 0;
  double all = 0;

  Eigen::Vector3d position(const Points& points) const;
};

/// A corner of a surface element and its reference normal: the normal of the corner before the fit, or the mean normal
/// of the element where the corner is folded against it.
struct FacetCorner
{
  std::int32_t node, first, second; ///< counter-clockwise seen against `normal`
  std::int32_t element;
  Eigen::Vector3d normal; ///< unit length
  double before;          ///< `facing` before the fit
  double best;            ///< facing() of the ideal element: 1, or sqrt(3)/2 in a triangle
};

/// Returns the corners of all surface elements; `points` are the nodes before the fit.
std::vector<FacetCorner> facetCorners(const std::vector<Element>& elements, const Points& points);

/// Scaled Jacobian of a surface corner, with the reference normal as third edge; at most 0 where the corner is turned
/// over.
double facing(const FacetCorner& corner, const Points& points);

/// Weights of the terms, lengths in mm.
struct EnergyWeights
{
  /// Of |L (x - reference)|^2, with L the graph Laplacian: v_i minus the mean of its neighbours v_j.
  double smoothness = 1;
  /// Of max(0, threshold * best - s)^2 / threshold^2, with s the scaled Jacobian of a corner. For a corner of a surface
  /// element, the required s is at most half of its value before the fit, but at least 0.05.
  double hinge = 10;
  double threshold = 0.25;
  double mean = 0.2; ///< of best - s, in volume elements
};

class FitEnergy
{
public:
  /// The corners and edges of the elements define quality and Laplacian. The reference normals of surface elements are
  /// those in `mesh`.
  explicit FitEnergy(const ElementMesh& mesh);

  Points reference; ///< a column per node
  EnergyWeights weights;
  std::vector<Pull> pulls;

  /// Returns the energy and sets its gradient with respect to each node.
  double evaluate(const Points& points, Points& gradient) const;

  /// Counts the surface elements that have a corner turned over now but not before the fit.
  std::size_t turnedFacets(const Points& points) const;

  /// Returns 2 (smoothness L'L + pulls), the preconditioner of the descent, the same for all coordinates. The
  /// directional part of a pull counts with a third of its weight.
  Eigen::SparseMatrix<double> preconditioner() const;

private:
  double addQuality(const Points& points, Points& gradient) const;
  double addFacing(const Points& points, Points& gradient) const;
  double addSmoothness(const Points& points, Points& gradient) const;
  double addPulls(const Points& points, Points& gradient) const;

  std::vector<Corner> m_Corners;
  std::vector<FacetCorner> m_FacetCorners;
  Eigen::SparseMatrix<double> m_Laplacian, m_LaplacianTransposed, m_Squared;
};

/// Minimises the energy by limited-memory BFGS (Nocedal 1980) with ten pairs, with the energy's preconditioner as
/// initial inverse Hessian, and step lengths that satisfy Armijo's condition. Moves `points` by at most `iterations`
/// steps and returns the number of steps taken.
int minimise(const FitEnergy& energy, Points& points, int iterations);

} // namespace surgicalmesher
