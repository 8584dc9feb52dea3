// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Graded background tetrahedra from a prepared tissue map; their label interfaces are the surface of all tissues.

#include "Evolution.h"
#include "FeatureSimplification.h"
#include "MapChanges.h"
#include "Progress.h"
#include "SampleTolerances.h"
#include "ScaleField.h"
#include "SimplexForces.h"
#include "TissueMap.h"

namespace surgicalmesher
{

struct TissueMesherOptions
{
  /// Bound on the distance of any boundary point of the map to the surface, mm. 0: automatic (SampleTolerances.h); then
  /// up to 2.1 times as much (2.4 in noisy maps) where an angle cannot be improved otherwise, and up to a voxel more
  /// where that preserves the volume of a tissue.
  double maximumDistance = 0;
  /// Scale, in voxels, of the smooth boundary that the surface approximates (SmoothBoundary.h). Without a
  /// maximumDistance or a proximity, roughness of that scale is first removed from the map (LabelSmoothing.h). 0: the
  /// steps of the voxels are kept.
  double smoothing = 0.7;
  /// Resistance of the surface to bending, relative to that of its samples: 0 none, 0.2 some, 1 equal (Bending.h).
  double rigidity = 0.28;
  /// Continuity of the simplex mesh's internal forces, used where elements are of voxel size and the surface is
  /// smoothed.
  Continuity continuity = Continuity::C2;
  /// Distance of samples to the surface, replacing the automatic one; where it is exceeded, the surface gets more
  /// triangles.
  Proximity proximity;
  FeatureOptions features; ///< options by which the map was simplified; thin tissues are then held less closely
};

/// Whether the surface may leave the boundary of the voxels; the mesh then starts from blocks of voxels where L is
/// large.
inline bool leavesVoxels(const TissueMesherOptions& options)
{
  return options.smoothing > 0 && !(options.maximumDistance > 0) && !options.proximity.isAsked();
}

/// Returns the scale that keeps the midpoints of edges within `chordError` mm of the boundary that will be meshed
/// (BoundaryCurvature.h, followCurvature). `scale` and the result are in world coordinates.
ScaleField followBoundary(const TissueMap& map, const ScaleField& scale, const TissueMesherOptions& options,
                          double chordError, double gradation);

struct MeshedMap
{
  BackgroundMesh background; ///< in the grid frame of the map
  double targetAngle;        ///< degrees; dihedral angle reached except at isolated places
  std::vector<EvolutionStep> evolution;
  std::vector<MapChange> smoothed; ///< changes of tissues by smoothing, before meshing
};

/// Meshes all tissues of a map: removal of roughness from the labels, lattice, boundary samples, smooth interface,
/// coarsening by levels of size, improvement, repair, balance of volumes, motion of the simplex mesh, equalisation of
/// lengths. `map` must be well-composed (prepareMap); every tissue keeps its topology. `scale` is in world coordinates.
/// The result depends neither on the number of threads nor on their timing. Throws EngineError if the mesh cannot be
/// built.
MeshedMap meshTissues(const TissueMap& map, const ScaleField& scale, const TissueMesherOptions& options,
                      const Progress& progress = {});

} // namespace surgicalmesher
