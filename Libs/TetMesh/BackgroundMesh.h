// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The background tetrahedra: a labelled mesh of a whole box, the tissues and the space around them, with what
/// remeshing needs to know of the map that it stands for.

#include "FaceAdjacency.h"

namespace surgicalmesher
{

/// A place where the map, or an input surface, says that the boundary between two labels is. What holds samples adds to
/// them how it holds them.
struct BoundarySample
{
  Vec3 position;
  float tolerance = 0; ///< mm, to the nearest face of its pair of labels

  double squaredTolerance() const { return double(tolerance) * tolerance; } ///< mm^2
};

struct BackgroundMesh
{
  /// Held by the face that stands for it.
  struct Sample : BoundarySample
  {
    std::int32_t tetrahedron;
    std::int32_t face; ///< opposite this vertex (0..3); the tetrahedron's label is the larger of the face's two
    /// Normal of the boundary, out of the larger label, over the radius (mm) in which it is nearly plane; 0: not known.
    std::array<float, 3> normal{ 0, 0, 0 };
  };

  TetMesh mesh;
  std::vector<float> lengths; ///< target edge length at each point, mm
  std::vector<Sample> samples;
  AcrossFaces neighbours; ///< empty until somebody has found them
};

} // namespace surgicalmesher
