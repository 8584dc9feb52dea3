#pragma once
/// Improvement of a whole labelled mesh, with its own interface as the surface to stay on.

#include "BlockSweep.h"
#include "GuardedOperations.h"
#include "Progress.h"
#include "TetQuality.h"

namespace surgicalmesher
{

struct MeshImprovementOptions
{
  double surfaceTolerance = 0.017; ///< how far the surface may move from where it was, as a share of the target
                                   ///< length; four times as far where nothing else mends an angle
  double targetAngle = usualAngle; ///< degrees; work goes on until no dihedral angle is below it or above 180 minus it
};

/// Improves `mesh` (positively wound, face-to-face, label 0 outside; vertices on its hull stay) towards `scale` and towards
/// the target angle. Labels keep their topology, and no operation lowers the worst quality of what it touches.
/// Deterministic, whatever the number of threads.
void improveMesh(TetMesh& mesh, const SizingFunction& scale, const MeshImprovementOptions& options = {},
                 const Progress& progress = {});

} // namespace surgicalmesher
