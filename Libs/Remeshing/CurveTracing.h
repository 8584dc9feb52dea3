// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The first step of a curve into a mesh: chains of edges along it, whatever their tetrahedra are like.

#include "CurveChains.h"

namespace surgicalmesher
{

/// Where a curve comes near an interface, aims at its nearest place instead, so that it runs along it rather than in
/// and out.
void aimAtInterfaces(CurveNetwork& network, const TetComplex& complex);

/// Cuts the complex, which has no samples, along the curves of `chains`: faces, edges and tetrahedra that a curve
/// passes get a vertex there, unless one is near enough, and labels stay where they are. Throws InputError, with the
/// curve's name and the place, where a curve leaves the tissues; EngineError where it cannot be followed.
void traceCurves(TetComplex& complex, CurveChains& chains);

} // namespace surgicalmesher
