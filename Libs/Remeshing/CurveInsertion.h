// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Curves as chains of edges in a finished labelled mesh: the curvilinear elements of Audette et al. (MICCAI 2003
/// workshop paper), for vessels and nerves thinner than any element.

#include "CurveChain.h"
#include "CurveNetwork.h"
#include "TetMesh.h"
#include "TetQuality.h"

namespace surgicalmesher
{

struct CurveInsertionOptions
{
  double tolerance = 0.1;          ///< target lengths: between a curve and its chain, both ways
  double targetAngle = usualAngle; ///< degrees; see TetrahedraImprovementOptions
  double surfaceTolerance = 0.017; ///< target lengths; likewise
  double featureAngle = 0;         ///< degrees; likewise
};

/// Makes every curve a chain of edges of `mesh` (positively wound, face-to-face, label 0 outside), and improves the
/// tetrahedra near them again; those farther away stay as they are, and come first. Labels keep their topology, and the
/// surface stays within its tolerance. Chains are in the order of the curves, whose ends and branchings are vertices
/// within the tolerance of theirs. Deterministic. Throws InputError, with the curve's name and the place, where a curve
/// leaves the tissues; EngineError where a chain cannot be made.
std::vector<CurveChain> insertCurves(TetMesh& mesh, const CurveNetwork& curves, const SizingFunction& length,
                                     const CurveInsertionOptions& options = {});

} // namespace surgicalmesher
