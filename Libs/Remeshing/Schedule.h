// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The sweeps of the surface stage and of the tetrahedral stage, in the order in which they run, with all their
/// parameters. Methods and measurements: Docs/SimplexMesher.md#method, Docs/FuchsTetrahedralizer.md#method.

#include "Sweep.h"
#include "TetMesh.h"

#include <vector>

namespace surgicalmesher
{

/// The quality that the surface stage improves a mesh to, and the effort that it spends on it.
struct MeshTargets
{
  /// Degrees, dihedral; target of the first sweep of improvement. The target then rises in steps to aimedAngle, which
  /// disturbs edge lengths less than aiming high at once.
  double firstAngle;
  double aimedAngle;  ///< degrees, dihedral; final target
  double keptAngle;   ///< degrees, dihedral; later passes may not lower angles below this
  bool holdsVertices; ///< whether vertices are bound to their samples and the samples' planes, see EnvelopeBounds
  bool opensFolds;    ///< false where the surface follows the voxels' steps, which are at right angles
  /// Whether repairs before motion and fits are thorough: where features have no room, nothing else reaches good
  /// angles.
  bool repairsThoroughly;
  int trials;           ///< see ImprovementOptions; for improvement after coarsening
  int coarseningSweeps; ///< number of sweeps of improvement that also coarsen
};

extern const MeshTargets usualTargets;
/// For maps with unresolved features, such as noise; see hasUnresolvedFeatures. With holdsVertices, most repairs of
/// such maps would fail.
extern const MeshTargets noisyTargets;

/// Returns whether coarsening has left so many bad tetrahedra that features of the map's own size have no room for good
/// ones. Attempts to improve them all would be in vain and take most of the run time.
bool hasUnresolvedFeatures(const TetMesh& mesh);

/// The sizes that the rows below depend on, all in mm.
struct MeshSizes
{
  double voxel;           ///< smallest spacing of the map
  double longest;         ///< largest target length
  double maximumDistance; ///< see SpikeOptions; infinity: no bound
};

/// Returns whether the longest L is more than twelve voxels, so that a single voxel matters less.
bool hasFineVoxels(const MeshSizes& sizes);

// --- surface stage, in this order
/// Returns the size levels (mm) of successive coarsening sweeps; the last one is `longest`. A single pass to the final
/// lengths would leave a ragged mesh.
std::vector<double> sizeLevels(const MeshSizes& sizes);
/// Returns whether edges of size `level` are longer than 5 voxels (7.4 if hasFineVoxels()). Only from such levels on
/// can unresolved features be recognised.
bool isCoarse(double level, const MeshSizes& sizes);
Sweep coarsenTo(double level, const MeshSizes& sizes);
/// The last level. Pass `thoroughly` = false for unresolved features: they keep most of the vertices from collapsing,
/// and trying more positions costs much and gains little.
Sweep coarsenToLast(const MeshSizes& sizes, bool thoroughly);
/// The first sweep of improvement, which also coarsens.
Sweep firstImprovement(const MeshTargets& targets, const MeshSizes& sizes);
/// The following sweeps of improvement that also coarsen, with rising target angle. The caller balances the tissues'
/// volumes before each.
std::vector<Sweep> improvementSweeps(const MeshTargets& targets, const MeshSizes& sizes);
/// Sweeps without coarsening that allow the interface ever larger distances from its samples where tetrahedra are still
/// bad, and in the end splits.
std::vector<Sweep> repairSweeps(const MeshTargets& targets, const MeshSizes& sizes);
/// Moves vertices back to their samples as far as angles allow. The caller balances the tissues' volumes before.
Sweep fittingSweep(const MeshTargets& targets, const MeshSizes& sizes);
/// Motion of the simplex mesh, which smooths the steps of the voxels where elements are of the voxels' size. Each sweep
/// then repairs the angles lost, within the samples' tolerances, and opens folds everywhere. Later sweeps keep folds
/// open, except those for proximity, those that restore volumes and the very last repairs.
std::vector<Sweep> motionSweeps(const MeshTargets& targets, const MeshSizes& sizes, Continuity continuity);
/// Refines the interface where it is beyond the samples' tolerances, which the proximity option has set, and repairs
/// the angles.
std::vector<Sweep> proximitySweeps(const MeshTargets& targets, const MeshSizes& sizes);
/// Repairs once more, since tetrahedra that resisted before may have room now: first by blocks, then the whole mesh in
/// one block.
std::vector<Sweep> secondRepairSweeps(const MeshTargets& targets, const MeshSizes& sizes);
/// Moves single vertices back to their samples, then evens edge lengths and opens folds once more. The caller balances
/// the tissues' volumes before, unless proximity is bounded.
Sweep finishingSweep(const MeshTargets& targets, const MeshSizes& sizes);
constexpr std::size_t offsetRounds = 9; ///< on jhu189 one tissue needs more than six
/// Corrects the remaining errors of the tissues' volumes by moving the tissues' boundaries by `offsets`.
Sweep offsetSweep(const MeshTargets& targets, TissueOffsets offsets);
/// Returns the largest number of sweeps that the surface stage can run.
std::size_t surfaceSweepCount(const MeshSizes& sizes);

// --- tetrahedral stage
struct TetrahedralSweep
{
  Sweep sweep;
  bool balanced = false; ///< whether VolumeBalance::apply precedes the sweep
};

/// For a mesh that has not been improved yet, such as a constrained Delaunay one. `targetAngle`: degrees, dihedral.
/// `smallestLength`: the least L in tissues, mm; the last sweep softens stiff pairs of vertices and then raises heights
/// to 0.4 of this length, as far as the surface has room.
std::vector<TetrahedralSweep> sweepsForRawMesh(double targetAngle, double smallestLength);
/// For a mesh whose surface the surface stage has improved to `targetAngle`, whatever its interior. The surface moves
/// only where an angle cannot be repaired otherwise, within its tolerance where pairs of vertices are softened, and
/// within 1.5 tolerances where heights are raised.
std::vector<TetrahedralSweep> sweepsForImprovedMesh(double targetAngle, double smallestLength);

/// Restores the tissues' volumes that repairs of the surface have changed. For a sweep over the whole mesh in one
/// block.
Stage restoringStage(double targetAngle, VolumeBalance wanted);

/// For a mesh through which curves have just been traced, so that the edges along the curves are as short as the
/// tetrahedra that the curves cut.
std::vector<TetrahedralSweep> sweepsForCurves(double targetAngle, double smallestLength);

} // namespace surgicalmesher
