// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Removal of spikes (vertices between two labels that stick out of their boundary samples) and of ears (vertices at
/// which tissues have hardly a tetrahedron), by relabelling the tetrahedra that they consist of.

#include "GuardedOperations.h"
#include "TetQuality.h"

namespace surgicalmesher
{

struct SpikeOptions
{
  double vertexDistance = 1.4; ///< tolerances that a spike's tip is away from all samples of its faces at least
  std::size_t few = 8;         ///< tetrahedra that it consists of at most
  /// Degrees; what has been let off as background has such dihedral angles if it becomes tissue.
  double keptAngle = usualAngle;
  /// Degrees; what can't be cut is drawn in as far as such dihedral angles remain, for repairs to raise again. 0: it
  /// stays.
  double pullAngle = 0;
  /// mm; a sample is left no farther off than the tip is, nor than this.
  double maximumDistance = std::numeric_limits<double>::infinity();
};

/// Takes vertices between two labels that stick out of their samples off the interface, or draws them in.
void cutSpikesOfBlock(GuardedOperations& operations, const SpikeOptions& options = {});

/// Takes vertices that stick out (tissues fill less than a quarter of the sphere around them) and at which tissues
/// have at most `few` tetrahedra off the outer boundary, by relabelling these, or fills the valleys beside them. They are
/// tips of no volume to speak of, but the largest eigenvalues of a stiffness matrix are theirs.
void removeEarsOfBlock(GuardedOperations& operations, std::size_t few);

} // namespace surgicalmesher
