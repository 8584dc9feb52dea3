// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Whether an operation leaves every tissue its topology and a manifold boundary. Exact, by what is at the changed
/// vertices alone.

#include "TetComplex.h"

#include <functional>

namespace surgicalmesher
{

/// The link condition of Dey, Edelsbrunner, Guha and Nekhayev (1999) for all labels at an edge at once.
class CollapseTopology
{
public:
  explicit CollapseTopology(const TetComplex& complex) : m_Complex(complex) {}

  /// Whether merging u into v keeps all tissues; `ring` and `ringVertices` as of TetComplex::ring. Background that has
  /// no more than the ring of uv is enclosed by tissues, and may vanish: it is no tissue.
  bool keepsTissues(std::int32_t u, std::int32_t v, const std::vector<std::int32_t>& starOfU,
                    const std::vector<std::int32_t>& starOfV, const std::vector<std::int32_t>& ring,
                    const std::vector<std::int32_t>& ringVertices);

  /// After keepsTissues: whether a label may leave a vertex of the ring.
  bool ringLosesLabels() const { return m_RingLosesLabels; }

private:
  /// One vertex of the ring of an edge uv: as bits, the labels at its edges to u and to v, and those that both ends
  /// have at the edge of the ring after it.
  struct RingLabels
  {
    std::uint32_t atU = 0, atV = 0, atEdge = 0;
  };
  struct Place
  {
    std::uint32_t search = 0;
    std::int32_t at = 0; ///< in the ring's vertices
  };

  std::uint32_t bitOf(Label label);
  std::uint32_t lookAround(const std::vector<std::int32_t>& star, std::int32_t other, std::uint32_t RingLabels::*atEnd);
  std::uint32_t closingOver(std::int32_t t, std::int32_t u, std::int32_t v);
  std::uint32_t compareEnds(std::int32_t u, std::int32_t v, const std::vector<std::int32_t>& ring);

  const TetComplex& m_Complex;
  std::vector<Place> m_Places; ///< per vertex, of the search of that number
  std::uint32_t m_Search = 0;
  std::vector<Label> m_LocalLabels;
  std::vector<RingLabels> m_RingLabels;
  std::uint32_t m_Closed = 0; ///< labels that close over a tetrahedron of the ring
  bool m_RingLosesLabels = false;
};

/// Whether t can leave `label`, or go over to it, without a change of that label's topology: what has the label and
/// what has not each meet t in one to three of its faces, and besides at these faces' edges and corners only (t is a
/// simple point). A last tetrahedron of background among tissues may also go. `starOf` gives the tetrahedra at a
/// vertex.
bool isSimple(const TetComplex& complex, std::int32_t t, Label label,
              const std::function<const std::vector<std::int32_t>&(std::int32_t)>& starOf);

} // namespace surgicalmesher
