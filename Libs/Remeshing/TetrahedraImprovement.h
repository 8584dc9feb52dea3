// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The tetrahedral stage: improvement of a finished labelled mesh, which keeps to the mesh's own interface.

#include "Progress.h"
#include "SizingFunction.h"
#include "TetMesh.h"
#include "TetQuality.h"

namespace surgicalmesher
{

struct TetrahedraImprovementOptions
{
  /// Largest distance of the surface from its initial position, as a share of the target length or, if that is smaller
  /// and the surface is not improved yet, of the cube root of the tissue's volume; four times as much where an angle
  /// cannot be improved otherwise.
  double surfaceTolerance = 0.017;
  /// Degrees; tetrahedra with a dihedral angle below this, or above 180 minus it, are improved.
  double targetAngle = usualAngle;
  /// Degrees; edges of the surface sharper than this, corners and flat faces are preserved. 0: features are not
  /// detected.
  double featureAngle = 0;
  /// Whether the surface stage has already improved the surface to targetAngle. The surface is then held, except where
  /// an angle cannot be improved otherwise, where stiff pairs are softened or heights raised, and where a tissue's
  /// volume has to be restored afterwards.
  bool isImproved = false;
};

/// Improves `mesh` towards the target angle, with the target lengths `length`, a function of positions in the frame of
/// the mesh's points. The mesh must be positively wound and face-to-face, with label 0 outside the tissues; vertices on
/// its hull do not move. Labels keep their topology, and no operation lowers the worst dihedral angle in tissues of the
/// tetrahedra that it changes below the lesser of the target angle and 28.4 degrees. Heights below 0.4 of the smallest
/// target length in tissues are raised in the end. The result does not depend on the number of threads.
void improveTetrahedra(TetMesh& mesh, const SizingFunction& length, const TetrahedraImprovementOptions& options = {},
                       const Progress& progress = {});

} // namespace surgicalmesher
