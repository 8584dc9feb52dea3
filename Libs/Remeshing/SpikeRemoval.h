// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Removal of spikes (vertices between two labels that are far from all their boundary samples) and of ears (vertices
/// at which tissues have hardly any tetrahedra), by relabelling the tetrahedra that form them.

#include "GuardedOperations.h"
#include "TetQuality.h"

namespace surgicalmesher
{

struct SpikeOptions
{
  /// In tolerances; a vertex farther than this from all samples of its faces is the tip of a spike.
  double vertexDistance = 1.4;
  std::size_t few = 8; ///< largest number of tetrahedra that a spike consists of
  /// Degrees; least dihedral angle of tetrahedra that are relabelled to a tissue. Relabelling to background has no such
  /// bound.
  double keptAngle = usualAngle;
  /// Degrees; a spike that cannot be cut is pulled towards its samples as far as dihedral angles stay above this, for
  /// later repairs to raise again. 0: it is left as it is.
  double pullAngle = 0;
  /// mm; cutting may leave samples as far from the interface as the tip is from them, but no farther than this.
  double maximumDistance = std::numeric_limits<double>::infinity();
};

/// Relabels the tetrahedra of spikes, so that their tips leave the interface, or pulls the tips towards their samples.
void cutSpikesOfBlock(GuardedOperations& operations, const SpikeOptions& options = {});

/// Removes ears: vertices at which tissues have at most `few` tetrahedra and fill less than a quarter of the solid
/// angle. Relabels these tetrahedra to background or, where that fails, fills the valleys beside the vertex with
/// tissue. Ears have hardly any volume, but cause the largest eigenvalues of a stiffness matrix.
void removeEarsOfBlock(GuardedOperations& operations, std::size_t few);

} // namespace surgicalmesher
