// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Flat faces, sharp edges and corners of the interface, as in surfaces from CAD, which operations must preserve.
///
/// Triangles between the same two labels belong to one *side* if the angle between their normals, or between successive
/// normals of a chain of such triangles, is below the feature angle. Sides meet at sharp edges and corners. A side
/// whose normals are all the same is flat. Sides are found anew from the few triangles that an operation removes, so
/// that nothing has to be stored between operations.

#include "BoundarySamples.h"

#include <vector>

namespace surgicalmesher
{

class FeatureSides
{
public:
  /// `angle`: the feature angle, degrees; 0: there are no features, and everything is allowed.
  explicit FeatureSides(double angle);

  bool areWatched() const { return m_LeastCosine < 1; }

  /// Groups `faces`, with the vertices in their present positions, into sides.
  void find(const TetComplex& complex, const std::vector<SheetFace>& faces);

  /// Whether a triangle with unit normal `normal`, of either orientation, may replace triangles found between these
  /// labels: it must be parallel to a flat side, or within the feature angle of a triangle of a side that is not flat.
  bool allow(const Vec3& normal, LabelPair labels) const;

  /// Returns the part of `step` that keeps flat sides flat: its projection to the plane of one side or to the common
  /// edge of two; zero at a corner of three.
  Vec3 along(Vec3 step) const;

private:
  struct Triangle
  {
    Vec3 normal; ///< unit, away from the larger label
    LabelPair labels;
    bool isFlat; ///< whether its side is flat
  };

  double m_LeastCosine;
  std::vector<Triangle> m_Triangles; ///< grouped by side
  std::vector<Vec3> m_FlatNormals;   ///< orthonormal basis of the normals of the flat sides
};

} // namespace surgicalmesher
