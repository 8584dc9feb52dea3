// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Motion of a simplex mesh: forces draw it to the tissue boundaries, operators bring its edges to the target length.

#include "Progress.h"
#include "SimplexForces.h"
#include "SimplexOperators.h"

namespace surgicalmesher
{

/// Parameters of the law of motion (Delingette 1999): P' = P + (1 - damping) (P - P_previous) + internal F_int + image
/// F_ext.
struct MotionOptions
{
  double damping = 0.65;
  double internal = 0.3;
  double image = 0.5;
  InternalForceOptions internalForce;
  double hidden = 0.5; ///< weight of the force against roughness of the dual points that no force on vertices detects
  double least = 0;    ///< mm; shorter displacements are skipped: a mesh at rest costs little
};

struct AdaptationOptions
{
  MotionOptions motion;
  int motionsPerIteration = 3; ///< steps of the law of motion between operators
  int mostIterations = 60;
  int lastMotions = 10;         ///< steps of the law of motion after the last use of operators
  double shortEdge = 0.72;      ///< T1 where a simplex edge is shorter than this fraction of its target length
  double mostFusions = 0.25;    ///< T1 per iteration, fraction of the faces: motion makes room for the next ones
  double longEdge = 1.7;        ///< T2 where an edge is longer than this multiple of its target length
  std::size_t mostVertices = 7; ///< of a face; T2 above
  /// Operators end once the number of faces changes by no more than this fraction over five iterations.
  double rest = 0.01;
};

/// Figures of one iteration, for a plot such as figure 6d of Audette et al. 2007.
struct SimplexStep
{
  std::size_t faces = 0;      ///< dual points
  std::size_t vertices = 0;   ///< dual triangles
  double meanDistance = 0;    ///< mm, from the faces' centres to the tissue boundary
  double maximumDistance = 0; ///< mm
  int t1 = 0, t2 = 0, t7 = 0; ///< operations since the previous step
  double largestMove = 0;     ///< mm, largest displacement of a dual point in the last step of motion
};

/// A simplex mesh given by its dual triangles, with the means to move their points.
struct MovingDual
{
  SurfaceComplex surface;
  SimplexMesh simplex;           ///< of the surface; its points are updated from it
  std::vector<std::int32_t> ids; ///< of the surface's points, as `move` expects them
  /// Moves a point unless a guard refuses.
  std::function<bool(std::int32_t id, const Vec3& p)> move;
};

/// Motion of the whole mesh. Dual points move by the mean of the displacements of their vertices, so that each vertex
/// stays the centroid of its triangle.
class SimplexMotion
{
public:
  explicit SimplexMotion(const MotionOptions& options) : m_Options(options) {}

  /// Performs one step. No point moves farther than a third of its shortest edge; a displacement that a guard refuses
  /// is halved, up to three times, and the point stays if all are refused. Returns the largest displacement, mm.
  double step(SimplexOperators& mesh, const TissueBoundary& boundary);

  /// Displacements of the dual points by external forces, mm.
  using OuterForces = std::function<std::vector<Vec3>(const SurfaceComplex& dual)>;
  /// The same with other external forces than the image forces.
  double step(SimplexOperators& mesh, const OuterForces& outer);
  /// The same for any mesh, given the external forces on its dual points.
  double step(MovingDual& dual, const std::vector<Vec3>& outer);

private:
  MotionOptions m_Options;
  std::vector<Vec3> m_Last; ///< displacement of each dual point in the previous step
};

/// T7 where it improves the quality of the two triangles, or brings the faces closer to six vertices at little loss of
/// quality. Returns the number of operations.
int swapEdges(SimplexOperators& mesh);

/// Moves the mesh until no point moves by more than `tolerance` mm in a step, or for `mostSteps` steps. Returns the
/// largest displacement of each step.
std::vector<double> relaxSimplexMesh(SimplexOperators& mesh, const TissueBoundary& boundary,
                                     const MotionOptions& options, int mostSteps, double tolerance);

/// Iterates operators and motion until T1, driven by scale, and T2, driven by proximity, offset each other, so that the
/// number of faces becomes steady. Returns the steps: step 0 is the mesh as given, the last step the result after the
/// last motions.
std::vector<SimplexStep> adaptSimplexMesh(SimplexOperators& mesh, const TissueBoundary& boundary,
                                          const AdaptationOptions& options, const Progress& progress = {});

/// Returns CSV text with one row per step, after a row with the names of the columns.
std::string evolutionCSV(const std::vector<SimplexStep>& steps);

} // namespace surgicalmesher
