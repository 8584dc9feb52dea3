// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Improvement of the worst dihedral angles, worst tetrahedron first, by every guarded operation. Nothing here ever
/// makes the worst angle of what it touches worse, changes a label's topology, or leaves the envelope.

#include "GuardedOperations.h"

namespace surgicalmesher
{

struct ImprovementOptions
{
  double targetAngle =
    34; ///< degrees; tetrahedra with a dihedral angle below this, or above 180 minus it, are worked on
  double shortEdge = 0.6; ///< collapses that improve are tried on edges up to this share of the target
  double longEdge = 1.6;
  bool split = true;
  double splitEdge = 1.0; ///< splits are tried on edges from this share of the target on
  double ease = 0.02;     ///< as in PolishingOptions
  int trials = 12;        ///< positions tried for each vertex
  int together = 0;       ///< rounds in which the vertices around what resists all else move together
  int patience = 3;       ///< rounds after which that is given up if nothing is better: one in thirty would be, later
  double worstShare = 1;  ///< of the tetrahedra, the worst, that are worked on in one pass; a hundred at least
  double togetherShare =
    0.001;        ///< of the tetrahedra, the worst, for which that is tried in one pass; of a hundred at least
  int passes = 3; ///< later passes work only where something has changed
  /// Share of a block's tetrahedra, removed ones included. Where more are bad, most of them have no room within the bounds
  /// of the stage: what brings them nearer by little is left undone. For stages that others with wider bounds follow.
  double crowd = 1;
};

/// Worst first: edge removal, vertex optimisation, collapse, split, and moves of several vertices together, as they are
/// or with a new one among them, of the tetrahedra below the target, until nothing helps or the
/// passes are over.
void improveBlock(GuardedOperations& operations, const ImprovementOptions& options = {});

} // namespace surgicalmesher
