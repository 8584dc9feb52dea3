// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The background tetrahedra: a labelled mesh of a whole box, the tissues and the space around them, with what
/// remeshing needs to know of the map that it stands for.

#include "FaceAdjacency.h"

namespace surgicalmesher
{

struct BackgroundMesh
{
  /// A place on the boundary between two labels of the map, held by the face that stands for it.
  struct Sample
  {
    Vec3 position;
    float tolerance; ///< mm, to the nearest face of its pair of labels
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
