// SPDX-License-Identifier: Apache-2.0
#pragma once
/// From a prepared tissue map to graded background tetrahedra whose label interfaces are the surface of all tissues.

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
  /// mm; bound on the distance of any boundary point of the map to the surface. 0: automatic (SampleTolerances.h), 2.1
  /// times as much (2.4 in maps full of noise) where an angle cannot be mended otherwise, and up to a voxel more where
  /// that keeps a tissue's volume.
  double maximumDistance = 0;
  /// Scale, in voxels, of the smooth boundary that the surface is driven to (SmoothBoundary.h); without a
  /// maximumDistance or a proximity the map's roughness of that scale goes first (LabelSmoothing.h). 0: the voxels' steps.
  double smoothing = 0.7;
  /// Resistance of the surface to bending, in that of its samples: 0 none, 0.2 some, 1 as much (Bending.h).
  double rigidity = 0.28;
  /// What the simplex mesh's internal forces ask of the surface where elements are of the voxels' size, if it is smoothed.
  Continuity continuity = Continuity::C2;
  /// Distance of samples to the surface, in place of the automatic one; where it does not hold, the surface gets more
  /// triangles.
  Proximity proximity;
  FeatureOptions features; ///< what the map was simplified by; thin tissues are then held less closely
};

/// Whether the surface may leave the voxels' own boundary; then the mesh begins with blocks of voxels where L is long.
inline bool leavesVoxels(const TissueMesherOptions& options)
{
  return options.smoothing > 0 && !(options.maximumDistance > 0) && !options.proximity.isAsked();
}

/// The scale that keeps the middles of edges within `chordError` mm of the boundary that will be meshed
/// (BoundaryCurvature.h, followCurvature). `scale` is in world coordinates, and so is the result.
ScaleField followBoundary(const TissueMap& map, const ScaleField& scale, const TissueMesherOptions& options,
                          double chordError, double gradation);

struct MeshedMap
{
  BackgroundMesh background; ///< in the grid frame of the map
  double targetAngle;        ///< degrees, dihedral: what it has been improved to, but for single places
  std::vector<EvolutionStep> evolution;
  std::vector<MapChange> smoothed; ///< what smoothing took from tissues and gave to them, before anything was meshed
};

/// Labels without roughness, lattice, boundary samples, smooth interface, coarsening by levels of size, improvement, repair, balance of volumes,
/// motion of the simplex mesh, even lengths. `map` must be well-composed (prepareMap); every tissue keeps its topology. `scale` is in world
/// coordinates. The result depends on neither the number of threads nor their timing. Throws EngineError.
MeshedMap meshTissues(const TissueMap& map, const ScaleField& scale, const TissueMesherOptions& options,
                      const Progress& progress = {});

} // namespace surgicalmesher
