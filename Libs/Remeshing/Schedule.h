// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The sweeps of both stages, and every number in them: what the surface stage and the tetrahedral stage run, in which
/// order and how hard each tries. Methods and measurements: Docs/SimplexMesher.md#method,
/// Docs/FuchsTetrahedralizer.md#method.

#include "Sweep.h"
#include "TetMesh.h"

#include <vector>

namespace surgicalmesher
{

/// What a mesh is improved to.
struct MeshTargets
{
  double firstAngle;  ///< degrees, dihedral: aimed at first, step by step up to aimedAngle: sizes suffer less that way
  double aimedAngle;  ///< degrees, dihedral: aimed at in the end
  double keptAngle;   ///< degrees, dihedral: not to be lost again
  bool holdsVertices; ///< to their samples and these samples' planes: see EnvelopeBounds
  bool opensFolds;    ///< not where the surface follows the voxels' steps, which are at right angles
  bool repairsThoroughly; ///< before motion and fits: where features have no room, angles come right in no other way
  int trials;             ///< see ImprovementOptions, once sizes no longer change
  int coarseningSweeps;   ///< sweeps of improvement that still coarsen
};

extern const MeshTargets usualTargets;
/// Where features are of the map's own size, as noise makes them: see hasUnresolvedFeatures. With held vertices most
/// repairs there would fail.
extern const MeshTargets noisyTargets;

/// Whether coarsening has left so many bad tetrahedra that features of the map's own size have no room for good ones:
/// to try for them all would take most of the time and be in vain.
bool hasUnresolvedFeatures(const TetMesh& mesh);

/// The sizes that the rows below depend on, all in mm.
struct MeshSizes
{
  double voxel;           ///< smallest spacing of the map
  double longest;         ///< largest target length
  double maximumDistance; ///< of spikes that are cut; infinity: no bound
};

/// Whether voxels are small against the longest L: a single one matters less.
bool hasFineVoxels(const MeshSizes& sizes);

// --- surface stage, in this order
/// Sizes that edges are collapsed to one after the other, the last one `longest`: a single pass to the final lengths
/// would leave a ragged mesh.
std::vector<double> sizeLevels(const MeshSizes& sizes);
/// Features may be unresolved before this level: edges are then several voxels long, half again as many where L is more
/// than twelve.
bool isCoarse(double level, const MeshSizes& sizes);
Sweep coarsenTo(double level, const MeshSizes& sizes);
/// The last level. `thoroughly` false for unresolved features: they hold most of the vertices where they are, and to
/// try them at every place costs much and gains little.
Sweep coarsenToLast(const MeshSizes& sizes, bool thoroughly);
/// The first sweep of improvement, which still coarsens.
Sweep firstImprovement(const MeshTargets& targets, const MeshSizes& sizes);
/// Those after it that still coarsen; the angle aimed at rises. Tissues' volumes are balanced before each.
std::vector<Sweep> improvementSweeps(const MeshTargets& targets, const MeshSizes& sizes);
/// Without coarsening; what is still bad may go ever farther from its samples, and be split in the end.
std::vector<Sweep> repairSweeps(const MeshTargets& targets, const MeshSizes& sizes);
/// Vertices go back to their samples as far as angles allow, at volumes that are balanced before.
Sweep fittingSweep(const MeshTargets& targets, const MeshSizes& sizes);
/// The motion of the simplex mesh, which makes the surface smooth between the voxels where elements are of their size,
/// each time with an improvement of the angles that this costs, which keeps to the surface. Folds are opened after it,
/// wherever they are, and what comes later, but for volumes and the very last repairs, keeps them open.
std::vector<Sweep> motionSweeps(const MeshTargets& targets, const MeshSizes& sizes, Continuity continuity);
/// Where samples are beyond their tolerances, which proximity has set: more triangles, and angles as good as they were.
std::vector<Sweep> proximitySweeps(const MeshTargets& targets, const MeshSizes& sizes);
/// What resisted before may have got room; in the end across the blocks' borders.
std::vector<Sweep> secondRepairSweeps(const MeshTargets& targets, const MeshSizes& sizes);
/// Single vertices go back to their samples, and lengths and folds are worked on once more, at volumes that are balanced
/// before.
Sweep finishingSweep(const MeshTargets& targets, const MeshSizes& sizes);
constexpr std::size_t offsetRounds = 9; ///< on jhu189 one tissue needs more than six
/// What tissues still lack of their volumes, by their boundaries themselves.
Sweep offsetSweep(const MeshTargets& targets, TissueOffsets offsets);
/// How many sweeps there are at most.
std::size_t surfaceSweepCount(const MeshSizes& sizes);

// --- tetrahedral stage
struct TetrahedralSweep
{
  Sweep sweep;
  bool balanced = false; ///< VolumeBalance is applied before it
};

/// For tetrahedra that nobody has improved yet, such as constrained Delaunay's. `targetAngle` in degrees, dihedral;
/// `smallestLength`: the least L in tissues, mm, of which the last sweep makes every height a fair share, as
/// far as the surface has room, after it has softened pairs of vertices.
std::vector<TetrahedralSweep> sweepsForRawMesh(double targetAngle, double smallestLength);
/// For a mesh whose surface the surface stage improved to `targetAngle`, whatever fills it: the surface is held, but
/// where an angle cannot be mended otherwise, and slides within its tolerance where pairs of vertices are softened.
std::vector<TetrahedralSweep> sweepsForImprovedMesh(double targetAngle, double smallestLength);

/// Gives back the volumes that repairs of the surface have cost. For a sweep over the whole mesh.
Stage restoringStage(double targetAngle, VolumeBalance wanted);

/// For tetrahedra that curves have just been traced through, their chains as short as the tetrahedra they cut.
std::vector<TetrahedralSweep> sweepsForCurves(double targetAngle, double smallestLength);

} // namespace surgicalmesher
