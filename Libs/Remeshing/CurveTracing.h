// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The first step of curve insertion: chains of edges along the curves, regardless of the quality of the tetrahedra.

#include "CurveChains.h"

namespace surgicalmesher
{

/// Where a curve comes near an interface, moves its aims (CurveArc::aims) to the nearest place of the interface, so
/// that the chain runs along the interface rather than in and out.
void aimAtInterfaces(CurveNetwork& network, const TetComplex& complex);

/// Cuts the complex, which must have no samples, along the curves of `chains`: splits the edges, faces and tetrahedra
/// that a curve passes where no vertex is near enough. The parts keep their label. Throws InputError, with the curve's
/// source and the place, where a curve leaves the tissues, and EngineError where a curve cannot be followed.
void traceCurves(TetComplex& complex, CurveChains& chains);

} // namespace surgicalmesher
