// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Interface faces together with the boundary samples that they hold, gathered before an operation changes the
/// interface.

#include "TetComplex.h"

namespace surgicalmesher
{

/// Two labels in one integer, the larger label in the upper half: pairs are compared more often than unpacked.
using LabelPair = std::uint32_t;

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

/// Returns the face opposite vertex `face` of tetrahedron t, which must separate two labels.
SheetFace sheetFace(const TetComplex& complex, std::int32_t t, int face);

struct SheetSample : BoundarySample
{
  std::int32_t id;      ///< index in TetComplex::samples
  std::int32_t from;    ///< index, in the sheet, of the face that holds the sample
  std::int32_t to = -1; ///< index of the new face to which an operation assigns the sample; -1: none
  double distance2 = 0; ///< mm^2, to the face `to`
};

/// A set of interface faces and their samples: the faces at a vertex, or those that an operation changes.
struct Sheet
{
  std::vector<SheetFace> faces;
  std::vector<SheetSample> samples; ///< in the order of their faces

  void clear();
  /// Adds the interface face opposite vertex `face` of t, without its samples.
  void addFace(const TetComplex& complex, std::int32_t t, int face);
  /// Adds the samples of face k. The samples of the faces before k must have been added.
  void addSamples(const TetComplex& complex, std::size_t k);
  /// Prefetches the first sample of face k, because the linked list of samples is slow to follow.
  void prefetchSamples(const TetComplex& complex, std::size_t k) const;
};

/// Fills `sheet` with the interface faces `faces` and their samples.
void gatherSheet(const TetComplex& complex, const std::vector<TetComplex::FaceOfTet>& faces, Sheet& sheet);

/// Returns the sample of the sheet nearest to p and its squared distance, mm^2; a null pointer if the sheet has none.
std::pair<const SheetSample*, double> nearestSample(const Sheet& sheet, const Vec3& p);

} // namespace surgicalmesher
