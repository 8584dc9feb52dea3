// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Fuchs's second stage: adjustment of the vertex positions by minimisation of a penalty functional, before they are
/// tetrahedralized (A. Fuchs, Almost regular triangulations of trivariate NURBS-solids, 2001, as used by Audette et
/// al., Computer Aided Surgery 12(1), 2007, with the target edge length L(x) in the functional). Neither text of
/// Audette et al. gives its formula; the terms below are this project's own.
///
/// *Terms.* F = sum over pairs of points of phi(|p - q| / l), where l is the mean of L at both points and phi the
/// potential of the force 5/4 s^3 - 19/8 s^2 + 9/8 between bubbles (Shimada, Gossard, Bubble mesh, 1995). The force
/// repels below s = 1, attracts weakly up to 1.5 and vanishes beyond. This range includes exactly the fourteen
/// neighbours in the body-centred lattice of mean edge 1. The points of the surface take part but are fixed; they and a
/// minimum clearance of all other points form the boundary term.
///
/// *Insertion and removal.* After every round, one of two points closer than 0.5 l is removed. Where a point has fewer
/// than eleven neighbours within 1.5 l, a new one is inserted at distance L on its emptiest side, if no point is within
/// 0.75 L there and the clearance allows it.
///
/// *Stopping rule.* A round is L-BFGS (vnl, after Nocedal) with L and the pairs frozen, for at most ten evaluations.
/// There are at most two rounds, and no second one if the first moved no point by 0.01 L and inserted or removed none.
/// Further rounds hardly make the edges more even, and destroy what is left of the lattice.

#include "SizingFunction.h"
#include "TetMesh.h"

namespace surgicalmesher
{

enum class VertexPlacement
{
  Lattice,  ///< lattice positions; nothing is minimised
  NotWhole, ///< only points without their fourteen lattice neighbours move: between octaves and near the surface
  All       ///< all points move, as in the paper
};

/// Returns `points` with those inside tissues adjusted. `points` must be the result of latticePoints() for this
/// clearance. The result does not depend on the number of threads.
std::vector<Vec3> placedPoints(const SurfaceComplex& surface, const std::vector<Vec3>& points,
                               const SizingFunction& edgeLength, VertexPlacement placement, double clearance);

/// Returns F over all pairs of `points`, with L at each.
double placementPenalty(const std::vector<Vec3>& points, const SizingFunction& edgeLength);

} // namespace surgicalmesher
