// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Inserts curves as chains of edges into a finished labelled mesh: the curvilinear elements of Audette et al. (MICCAI
/// 2003 workshop paper), for vessels and nerves thinner than any element.

#include "CurveChain.h"
#include "CurveNetwork.h"
#include "TetMesh.h"
#include "TetQuality.h"

namespace surgicalmesher
{

struct CurveInsertionOptions
{
  double tolerance = 0.1;          ///< target lengths; greatest distance between a curve and its chain, both ways
  double targetAngle = usualAngle; ///< degrees; see TetrahedraImprovementOptions
  double surfaceTolerance = 0.017; ///< target lengths; see TetrahedraImprovementOptions
  double featureAngle = 0;         ///< degrees; see TetrahedraImprovementOptions
};

/// Makes every curve a chain of edges of `mesh` (positively wound, face-to-face, label 0 outside), and improves the
/// tetrahedra near the curves again. Tetrahedra farther away stay as they are and come first in the result. Labels keep
/// their topology, and the surface stays within `surfaceTolerance`. Deterministic.
///
/// Returns the chains in the order of the curves. The vertices at a curve's ends and branchings lie within `tolerance`
/// of them. Throws InputError, with the curve's source and the place, where a curve leaves the tissues, and EngineError
/// where a chain cannot be made.
std::vector<CurveChain> insertCurves(TetMesh& mesh, const CurveNetwork& curves, const SizingFunction& length,
                                     const CurveInsertionOptions& options = {});

} // namespace surgicalmesher
