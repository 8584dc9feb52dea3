#pragma once
/// From a prepared tissue map to the graded ambient complex whose interface is the surface of all tissues.

#include "BlockSweep.h"
#include "FeatureSimplification.h"
#include "GuardedOperations.h"
#include "Progress.h"
#include "ScaleField.h"
#include "TissueMap.h"

#include <string>
#include <vector>

namespace surgicalmesher
{

struct TissueMesherOptions
{
  /// mm; bound on the distance of any boundary point of the map to the surface. 0: automatic: 0.42 voxel + 0.095 L, on thin
  /// tissues 0.28 of their thickness if that is less (0.6 voxel at least); 2.1 times as much (2.4 in maps full of noise)
  /// where an angle can't be mended otherwise; and up to a voxel more where that keeps a tissue's volume.
  double maximumDistance = 0;
  /// What the map was simplified by. Thin tissues, but the protected ones, are then let off 0.08 F of their thickness more,
  /// 0.4 at most.
  FeatureOptions features;
};

/// The mesh after one step.
struct EvolutionStep
{
  std::string stage;
  std::size_t tetrahedra = 0; ///< of tissues
  std::size_t faces = 0;      ///< between labels; not counted (0) in the lattice, whose neighbours nobody needs
  double meanDistance = 0;    ///< mm, of the map's smoothed boundary to the surface
  double maximumDistance = 0; ///< mm
  OperationCounts operations; ///< since the step before
};

struct SurfaceMesh
{
  BackgroundMesh ambient; ///< in the grid frame of the map
  std::vector<EvolutionStep> evolution;
};

/// Lattice, smoothed boundary, guarded coarsening by levels of size, improvement. `map` must be well-composed
/// (prepareMap); every tissue keeps its topology. `scale` is in world coordinates. The result depends on neither the number
/// of threads nor their timing. Throws EngineError.
SurfaceMesh meshTissues(const TissueMap& map, const ScaleField& scale, const TissueMesherOptions& options,
                        const Progress& progress = {});

} // namespace surgicalmesher
