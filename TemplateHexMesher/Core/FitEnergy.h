// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The energy whose minimum is a template fitted to a patient with valid elements: quality of all corners, smoothness
/// of the displacements from a reference, and pulls towards the target, for all nodes at once.

#include "ElementQuality.h"

#include <Eigen/Sparse>
#include <Eigen/SparseCholesky>

#include <vector>

namespace surgicalmesher
{

/// A point fixed in the mesh, as weighted nodes, drawn to a goal: along (direction.d)^2 + all |d|^2, d its displacement
/// from the goal. `along` may be negative down to -all: an edge along `direction` that may be slid on.
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

/// A corner of a surface element, and the way it faced before the fit: its own, or the element's mean if it is folded
/// against that.
struct FacetCorner
{
  std::int32_t node, first, second; ///< counter-clockwise seen against `normal`
  std::int32_t element;
  Eigen::Vector3d normal; ///< unit length
  double before;          ///< `facing` before the fit
  double best;            ///< of the ideal element: 1, or sqrt(3)/2 in a triangle
};

/// Of all surface elements, as they lie in `points`.
std::vector<FacetCorner> facetCorners(const std::vector<Element>& elements, const Points& points);

/// The scaled Jacobian with the former normal for a third edge: not above 0 where the corner is turned over.
double facing(const FacetCorner& corner, const Points& points);

/// Weights of the terms, lengths in mm.
struct EnergyWeights
{
  double smoothness = 1; ///< of |L (x - reference)|^2, L the graph Laplacian v_i - mean of v_j, j next to i
  double hinge = 10;     ///< of max(0, threshold best - s)^2 / threshold^2, s the scaled Jacobian of a corner; in a
                         ///< facet's corner at most half of s before the fit is asked for
  double threshold = 0.25;
  double mean = 0.2; ///< of best - s, in volume elements
};

class FitEnergy
{
public:
  /// Elements' corners and edges define the quality and the Laplacian; a surface element faces as it does in `mesh`.
  explicit FitEnergy(const ElementMesh& mesh);

  Points reference; ///< a column per node
  EnergyWeights weights;
  std::vector<Pull> pulls;

  /// The energy, and its gradient with respect to each node.
  double evaluate(const Points& points, Points& gradient) const;

  /// Surface elements with a corner turned over that was not so before.
  std::size_t turnedFacets(const Points& points) const;

  /// 2 (smoothness L'L + pulls), by which the directions of descent are preconditioned, the same for all coordinates.
  /// A pull along a direction counts with a third of its weight.
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

/// Limited-memory BFGS (Nocedal 1980), ten pairs, with the energy's preconditioner as first inverse Hessian and steps
/// that satisfy Armijo's condition. Moves `points` by at most `iterations` steps and returns the number of steps taken.
int minimise(const FitEnergy& energy, Points& points, int iterations);

} // namespace surgicalmesher
