// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Flat faces, sharp edges and corners of the interface, as surfaces from CAD have them: what an operation must leave
/// as it is.
///
/// Triangles between the same two labels are of one *side* if the angle between their normals, or from one to the next
/// through others, is below the feature angle; where sides meet is a sharp edge, or a corner. A side whose normals are
/// all the same is flat. Sides are those of the few triangles that an operation takes away, so that nothing has to be
/// kept between operations.

#include "BoundarySamples.h"

#include <vector>

namespace surgicalmesher
{

class FeatureSides
{
public:
  /// degrees; 0: there are no features, and everything is allowed.
  explicit FeatureSides(double angle);

  bool areWatched() const { return m_LeastCosine < 1; }

  /// Finds the sides of `faces`, as they are now.
  void find(const TetComplex& complex, const std::vector<SheetFace>& faces);

  /// Whether a triangle of that unit normal, in either sense, may take the place of some found: in the plane of a flat
  /// side, or within the feature angle of another's.
  bool allow(const Vec3& normal, LabelPair labels) const;

  /// The part of a step that leaves flat sides flat: in the plane of one, along the edge of two, none at a corner.
  Vec3 along(Vec3 step) const;

private:
  struct Triangle
  {
    Vec3 normal; ///< unit, away from the larger label
    LabelPair labels;
    bool isFlat; ///< its side is
  };

  double m_LeastCosine;
  std::vector<Triangle> m_Triangles; ///< side by side
  std::vector<Vec3> m_FlatNormals;   ///< orthonormal: of the flat sides
};

} // namespace surgicalmesher
