// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The background mesh: labelled tetrahedra that fill a whole box, the tissues and the space around them, with the data
/// about the underlying map that remeshing needs.

#include "FaceAdjacency.h"

namespace surgicalmesher
{

/// A point of the boundary between two labels, according to the map or an input surface. Meshes that store samples add
/// to this type which of their elements a sample belongs to.
struct BoundarySample
{
  Vec3 position;
  float tolerance = 0; ///< mm, allowed distance to the nearest face between its two labels

  double squaredTolerance() const { return double(tolerance) * tolerance; } ///< mm^2
};

struct BackgroundMesh
{
  /// A sample and the face that represents it.
  struct Sample : BoundarySample
  {
    std::int32_t tetrahedron;
    std::int32_t face; ///< opposite this vertex (0..3); the tetrahedron has the larger of the face's two labels
    /// Normal of the boundary, out of the larger label, divided by the radius (mm) within which the boundary is nearly
    /// plane; 0: unknown.
    std::array<float, 3> normal{ 0, 0, 0 };
  };

  TetMesh mesh;
  std::vector<float> lengths; ///< target edge length at each point, mm
  std::vector<Sample> samples;
  AcrossFaces neighbours; ///< empty until computed
};

} // namespace surgicalmesher
