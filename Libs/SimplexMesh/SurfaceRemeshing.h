// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Any closed surface of one or many tissues at other densities: decimated and refined, smoothed and projected back on
/// the original again and again (Virtual Family, section 3.2), by the operators of the simplex mesh and under their
/// guards: every tissue keeps its topology, no triangle crosses another, curves between tissues and sharp edges stay.

#include "Progress.h"
#include "SurfaceCurves.h"

namespace surgicalmesher
{

struct RemeshingOptions
{
  std::function<double(const Vec3&)> edgeLength; ///< L(x), mm
  /// mm; bound on the distance to the original and back, and edges shorter than L where curvature asks for it. 0: a
  /// fifth of L, and edges by L alone.
  double chordError = 0;
  double featureAngle = 40; ///< degrees; see sharpEdges
};

struct RemeshedSurface
{
  SurfaceComplex surface;
  std::vector<double> edgeLength; ///< by point, aimed at, mm
  std::size_t sharpEdges = 0;     ///< of the original
};

/// `original` is to be sound (requireSound). The same result with any number of threads.
RemeshedSurface remeshSurface(const SurfaceComplex& original, const RemeshingOptions& options,
                              const Progress& progress = {});

} // namespace surgicalmesher
