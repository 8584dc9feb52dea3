#pragma once
/// Faces between two labels with the samples that they hold, and where it would like a vertex of theirs to be.

#include "TetComplex.h"

namespace surgicalmesher
{

using LabelPair = std::uint32_t; ///< two labels, the larger one in the upper half: compared more often than taken apart

inline LabelPair labelPair(Label a, Label b) { return a < b ? LabelPair(b) << 16 | a : LabelPair(a) << 16 | b; }

struct SheetFace
{
  std::int32_t tet;
  int face; ///< opposite this vertex of tet
  LabelPair labels;
  std::array<std::int32_t, 3> vertices;
  std::pair<std::int32_t, int> holder; ///< see TetComplex
};

struct SheetSample
{
  Vec3 position;
  double tolerance2; ///< mm^2
  std::int32_t id;   ///< in TetComplex::samples
  std::int32_t from; ///< number of its face in the sheet
  std::int32_t to;   ///< where an operation would put it: a number of a new face, or -1, and
  double distance2;  ///< the squared distance to that
};

struct Sheet
{
  std::vector<SheetFace> faces;
  std::vector<SheetSample> points; ///< in the order of their faces

  void clear();
  /// Adds the face opposite vertex `face` of t, which must separate two labels.
  void addFace(const TetComplex& complex, std::int32_t t, int face);
  /// Adds the samples of face number k, once that of those before it is there.
  void addPoints(const TetComplex& complex, std::size_t k);
};

/// Collects the interface faces at v, each once, whose tetrahedra are `star`.
void gatherSheet(const TetComplex& complex, std::int32_t v, const std::vector<std::int32_t>& star, Sheet& sheet);

/// Normal equations m x = g, m symmetric.
struct Fit
{
  double m[6] = { 0, 0, 0, 0, 0, 0 }; ///< xx xy xz yy yz zz
  Vec3 g;

  double trace() const { return m[0] + m[3] + m[5]; }
  void addToDiagonal(double value) { m[0] += value, m[3] += value, m[5] += value; }
  Vec3 times(const Vec3& x) const;
  Vec3 solve(const Vec3& right) const; ///< zero if m is singular
};

/// Least squares for the step of v that brings the faces of its `sheet` nearest to their samples: m step = g, mm. With
/// `robust` (mm) > 0, samples at distance d weighs 1 / (1 + d / robust), one round of iteratively reweighted least squares
/// for the mean distance, and so for the volume between surface and map, instead of its square.
Fit fitOf(const TetComplex& complex, std::int32_t v, const Sheet& sheet, double robust = 0);

/// The same, were v at p.
Fit fitAt(const TetComplex& complex, std::int32_t v, const Vec3& p, const Sheet& sheet, double robust);

} // namespace surgicalmesher
