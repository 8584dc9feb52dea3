// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Interface faces with the boundary samples that they hold: what an operation looks at before it changes the
/// interface.

#include "TetComplex.h"

namespace surgicalmesher
{

using LabelPair = std::uint32_t; ///< two labels, the larger one in the upper half: compared more often than taken apart

inline LabelPair labelPair(Label a, Label b) { return a < b ? LabelPair(b) << 16 | a : LabelPair(a) << 16 | b; }

/// Whether `label` is one of the pair.
inline bool hasLabel(LabelPair pair, Label label) { return (pair & 0xffff) == label || pair >> 16 == label; }

struct SheetFace
{
  std::int32_t tet;
  int face; ///< opposite this vertex of tet
  LabelPair labels;
  std::array<std::int32_t, 3> vertices;
  TetComplex::FaceOfTet holder; ///< see TetComplex
};

/// The face opposite vertex `face` of t, which must separate two labels.
SheetFace sheetFace(const TetComplex& complex, std::int32_t t, int face);

struct SheetSample : BoundarySample
{
  std::int32_t id;      ///< in TetComplex::samples
  std::int32_t from;    ///< number of its face in the sheet
  std::int32_t to = -1; ///< number of the new face that an operation hands it to; -1: none
  double distance2 = 0; ///< mm^2, to that face
};

/// Some interface faces and their samples: those at a vertex, or those that an operation changes.
struct Sheet
{
  std::vector<SheetFace> faces;
  std::vector<SheetSample> samples; ///< in the order of their faces

  void clear();
  /// Adds sheetFace() of these.
  void addFace(const TetComplex& complex, std::int32_t t, int face);
  /// Adds the samples of face number k, once those of the faces before it are there.
  void addSamples(const TetComplex& complex, std::size_t k);
  /// Begins to fetch the first of them: a list is slow to follow.
  void prefetchSamples(const TetComplex& complex, std::size_t k) const;
};

/// Collects these interface faces.
void gatherSheet(const TetComplex& complex, const std::vector<TetComplex::FaceOfTet>& faces, Sheet& sheet);

/// The sample of the sheet that is nearest to p, and its squared distance, mm^2; null if there is none.
std::pair<const SheetSample*, double> nearestSample(const Sheet& sheet, const Vec3& p);

} // namespace surgicalmesher
