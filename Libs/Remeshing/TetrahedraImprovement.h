// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Improvement of a finished labelled mesh, with its own interface as the surface to stay on: what the tetrahedral
/// stage does.

#include "Progress.h"
#include "SizingFunction.h"
#include "TetMesh.h"
#include "TetQuality.h"

namespace surgicalmesher
{

struct TetrahedraImprovementOptions
{
  /// How far the surface may move from where it was, as a share of the target length, and of the cube root of a tissue's
  /// volume where that is less (not if isImproved); four times as far where nothing else mends an angle.
  double surfaceTolerance = 0.017;
  double targetAngle = usualAngle; ///< degrees; work goes on until no dihedral angle is below it or above 180 minus it
  double featureAngle = 0; ///< degrees; edges of the surface sharper than that, corners and flat faces stay what they
                           ///< are. 0: none are watched
  /// The surface stage has improved the surface for targetAngle: it is where it belongs, and is held except where an
  /// angle cannot be mended otherwise, or a tissue has lost volume by that.
  bool isImproved = false;
};

/// Improves `mesh` (positively wound, face-to-face, label 0 outside; vertices on its hull stay) towards `length` and
/// towards the target angle. Labels keep their topology, and no operation lowers the worst quality of what it
/// touches below the target angle. Heights under 0.4 of the smallest length are raised in the end.
/// Deterministic, whatever the number of threads.
void improveTetrahedra(TetMesh& mesh, const SizingFunction& length, const TetrahedraImprovementOptions& options = {},
                       const Progress& progress = {});

} // namespace surgicalmesher
