// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Remeshes closed surfaces of one or many tissues to another density. The surface is repeatedly decimated, refined,
/// smoothed and projected back onto the original (Virtual Family, section 3.2) with the guarded operators of the
/// simplex mesh: every tissue keeps its topology, triangles do not intersect, and curves between tissues and sharp
/// edges are preserved.

#include "Progress.h"
#include "SurfaceCurves.h"

namespace surgicalmesher
{

struct RemeshingOptions
{
  std::function<double(const Vec3&)> edgeLength; ///< L(x), mm
  /// Bound on the distance to the original and back, mm; edges are shorter than L where the curvature requires it. 0:
  /// the bound is a fifth of L, and L alone gives the edge lengths.
  double chordError = 0;
  double featureAngle = 40; ///< degrees; see sharpEdges
};

struct RemeshedSurface
{
  SurfaceComplex surface;
  std::vector<double> edgeLength; ///< target length at each point, mm
  std::size_t sharpEdges = 0;     ///< of the original
};

/// Returns the remeshed surface; the result does not depend on the number of threads. `original` must be sound
/// (requireSound).
RemeshedSurface remeshSurface(const SurfaceComplex& original, const RemeshingOptions& options,
                              const Progress& progress = {});

} // namespace surgicalmesher
