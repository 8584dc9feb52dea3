// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A simplex mesh in motion: forces that draw it to the tissue boundaries, operators that bring its edges to scale.

#include "Progress.h"
#include "SimplexForces.h"
#include "SimplexOperators.h"

namespace surgicalmesher
{

/// Law of motion (Delingette 1999): P' = P + (1 - damping) (P - P before) + internal F_int + image F_ext.
struct MotionOptions
{
  double damping = 0.65;
  double internal = 0.3;
  double image = 0.5;
  InternalForceOptions internalForce;
  double hidden = 0.5; ///< of the dual points' roughness, which no force on vertices sees
  double least = 0;    ///< mm; shorter ways are not gone: a mesh at rest costs little
};

struct AdaptationOptions
{
  MotionOptions motion;
  int motionsPerIteration = 3; ///< steps of the law of motion between operators
  int mostIterations = 60;
  int lastMotions = 10;         ///< steps of the law of motion after the last operators
  double shortEdge = 0.72;      ///< T1 where a simplex edge is shorter than this share of its target
  double mostFusions = 0.25;    ///< T1 per iteration, share of the faces: motion makes room for the next ones
  double longEdge = 1.7;        ///< T2 where it is longer than that
  std::size_t mostVertices = 7; ///< of a face
  double rest = 0.01; ///< operators end when five iterations change the number of faces by no more than this share
};

/// One iteration, for a graph such as figure 6d of Audette et al. 2007.
struct SimplexStep
{
  std::size_t faces = 0;      ///< dual points
  std::size_t vertices = 0;   ///< dual triangles
  double meanDistance = 0;    ///< mm, of the faces' centres to the tissue boundary
  double maximumDistance = 0; ///< mm
  int t1 = 0, t2 = 0, t7 = 0; ///< operations since the step before
  double largestMove = 0;     ///< mm, of a dual point in the last step of motion
};

/// A simplex mesh as its dual triangles, and what moves their points.
struct MovingDual
{
  SurfaceComplex surface;
  SimplexMesh simplex;           ///< of the surface; its points follow
  std::vector<std::int32_t> ids; ///< of the surface's points, as `move` knows them
  /// Moves a point unless a guard refuses.
  std::function<bool(std::int32_t id, const Vec3& p)> move;
};

/// Motion of the whole mesh. Dual points follow the mean of their vertices, so that each vertex stays the centroid of
/// its triangle.
class SimplexMotion
{
public:
  explicit SimplexMotion(const MotionOptions& options) : m_Options(options) {}

  /// One step. No point goes farther than a third of its shortest edge; a way that a guard refuses is halved, up to
  /// three times, and the point then rests. Returns the largest way, mm.
  double step(SimplexOperators& mesh, const TissueBoundary& boundary);

  /// Ways of dual points by forces from outside, mm.
  using OuterForces = std::function<std::vector<Vec3>(const SurfaceComplex& dual)>;
  /// The same with other forces than the image's.
  double step(SimplexOperators& mesh, const OuterForces& outer);
  /// The same of any mesh, with the outer forces on its dual points.
  double step(MovingDual& dual, const std::vector<Vec3>& outer);

private:
  MotionOptions m_Options;
  std::vector<Vec3> m_Last; ///< way of each dual point in the step before
};

/// T7 where it leaves better triangles, or faces with more nearly six vertices and triangles hardly worse. Returns the
/// number of operations.
int swapEdges(SimplexOperators& mesh);

/// Moves until no point moves by more than `tolerance` mm in a step, or for `mostSteps`. Returns the largest way of
/// each step.
std::vector<double> relaxSimplexMesh(SimplexOperators& mesh, const TissueBoundary& boundary,
                                     const MotionOptions& options, int mostSteps, double tolerance);

/// Iterates operators and motion until T1, driven by scale, and T2, driven by proximity, offset each other: the number
/// of faces rests. Step 0 is the mesh as given, the last one what the last motions leave.
std::vector<SimplexStep> adaptSimplexMesh(SimplexOperators& mesh, const TissueBoundary& boundary,
                                          const AdaptationOptions& options, const Progress& progress = {});

/// One row per step; the first row names the columns.
std::string evolutionCSV(const std::vector<SimplexStep>& steps);

} // namespace surgicalmesher
