// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Improvement of the worst dihedral angles, worst tetrahedron first, by every guarded operation. The result of an
/// operation never has a worse angle than the tetrahedra that it replaces, never changes a label's topology and stays
/// within the envelope.

#include "GuardedOperations.h"

namespace surgicalmesher
{

struct ImprovementOptions
{
  /// Degrees; tetrahedra with a dihedral angle below this, or above 180 minus it, are bad and are processed.
  double targetAngle = 34;
  double shortEdge = 0.6; ///< edges up to this multiple of their target length are tried for collapse
  double longEdge = 1.6;  ///< a collapse creates no edge longer than this multiple of its target length
  bool split = true;      ///< whether edges are split at all
  double splitEdge = 1.0; ///< edges from this multiple of their target length on are tried for a split
  double ease = 0.02;     ///< as in PolishingOptions
  int trials = 12;        ///< positions tried for each vertex
  int together = 0;       ///< rounds of moving a group of vertices together where all other operations fail; 0: never
  int patience = 3;       ///< rounds after which a group without any gain is given up; one in thirty would gain later
  double worstShare = 1;  ///< share of the tetrahedra processed in one pass, worst first; at least 100 tetrahedra
  /// Share of the tetrahedra for which group moves are tried in one pass, worst first; at least 100 tetrahedra.
  double togetherShare = 0.001;
  int passes = 3; ///< later passes process only tetrahedra near a change
  /// Share of a block's tetrahedra (deleted ones count). If more than this share is bad, most of them have no room
  /// within the bounds of the stage, and tetrahedra that make little progress are abandoned. For stages that are
  /// followed by others with wider bounds.
  double crowd = 1;
};

/// Processes the tetrahedra below the target angle, worst first, until nothing improves or the passes are used up.
/// Tries in this order: edge removal, moves of single vertices, edge collapse, edge split, group moves of several
/// vertices together, and a split followed by a group move.
void improveBlock(GuardedOperations& operations, const ImprovementOptions& options = {});

} // namespace surgicalmesher
