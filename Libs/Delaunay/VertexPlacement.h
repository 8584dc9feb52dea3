// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Fuchs's second stage: the adjustment of vertex positions by minimisation of a penalty functional, before they are
/// triangulated (A. Fuchs, Almost regular triangulations of trivariate NURBS-solids, 2001, as Audette et al., Computer
/// Aided Surgery 12(1), 2007, use it: with the target edge length L(x) in the functional). Neither text of Audette et al.
/// has its formula; the terms below are ours.
///
/// *Terms.* F = sum over pairs of points of phi(|p - q| / l), l the mean of L at both, phi the potential of the force
/// 5/4 s^3 - 19/8 s^2 + 9/8 between bubbles (Shimada, Gossard, Bubble mesh, 1995): it repels below s = 1, attracts a
/// little up to 1.5 and ends there, which takes in the fourteen neighbours in the body-centred lattice of mean edge 1
/// and no more. The surface's points take part and stay where they are: they are the boundary term, together with a
/// clearance that no point may fall below.
///
/// *Insertion and removal.* After every round: of two points closer than 0.5 l one goes; where a point has fewer than
/// eleven neighbours within 1.5 l, a new one is put at distance L on its emptiest side, if no point is within 0.75 L
/// there and the clearance allows it.
///
/// *Stopping rule.* A round is L-BFGS (vnl, after Nocedal) with L and the pairs frozen, for ten evaluations at most;
/// there are two rounds at most, and no second one if in the first no point moved by 0.01 L, came or went. More make
/// edges hardly more even, and lose what is left of the lattice.

#include "SizingFunction.h"
#include "TetMesh.h"

namespace surgicalmesher
{

enum class VertexPlacement
{
  Lattice,  ///< where the lattice has them: nothing is minimised
  NotWhole, ///< those without their fourteen neighbours of the lattice move: between octaves and by the surface
  All       ///< as in the paper
};

/// `points` (as latticePoints() returns them for this clearance), those within tissues adjusted. Deterministic, whatever
/// the number of threads.
std::vector<Vec3> placedPoints(const SurfaceComplex& surface, const std::vector<Vec3>& points,
                               const SizingFunction& edgeLength, VertexPlacement placement, double clearance);

/// F over all pairs of `points`, with L at each.
double placementPenalty(const std::vector<Vec3>& points, const SizingFunction& edgeLength);

} // namespace surgicalmesher
