// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Tests of whether an operation preserves every tissue's topology and manifold boundary. The tests are exact and look
/// only at the stars of the changed vertices.

#include "TetComplex.h"

#include <functional>

namespace surgicalmesher
{

/// The link condition of Dey, Edelsbrunner, Guha and Nekhayev (1999) for all labels at an edge at once.
class CollapseTopology
{
public:
  explicit CollapseTopology(const TetComplex& complex) : m_Complex(complex) {}

  /// Returns whether merging u into v preserves all tissues; `ring` and `ringVertices` as found by TetComplex::ring().
  /// Background that consists of tetrahedra of the ring of uv only is enclosed by tissues and may vanish.
  bool keepsTissues(std::int32_t u, std::int32_t v, const std::vector<std::int32_t>& starOfU,
                    const std::vector<std::int32_t>& starOfV, const std::vector<std::int32_t>& ring,
                    const std::vector<std::int32_t>& ringVertices);

  /// Valid after keepsTissues(): whether the collapse may remove a label from a vertex of the ring.
  bool ringLosesLabels() const { return m_RingLosesLabels; }

private:
  /// Labels, as bits, at one vertex of the ring of edge uv: at its edge to u, at its edge to v, and those that both u
  /// and v have at the ring's edge that follows the vertex.
  struct RingLabels
  {
    std::uint32_t atU = 0, atV = 0, atEdge = 0;
  };
  struct Place
  {
    std::uint32_t search = 0;
    std::int32_t at = 0; ///< index among the ring's vertices
  };

  std::uint32_t bitOf(Label label);
  std::uint32_t lookAround(const std::vector<std::int32_t>& star, std::int32_t other, std::uint32_t RingLabels::*atEnd);
  std::uint32_t closingOver(std::int32_t t, std::int32_t u, std::int32_t v);
  std::uint32_t compareEnds(std::int32_t u, std::int32_t v, const std::vector<std::int32_t>& ring);

  const TetComplex& m_Complex;
  std::vector<Place> m_Places; ///< per vertex; valid if its search number is m_Search
  std::uint32_t m_Search = 0;
  std::vector<Label> m_LocalLabels;
  std::vector<RingLabels> m_RingLabels;
  std::uint32_t m_Closed = 0; ///< bits of the labels that close over a tetrahedron of the ring, see closingOver
  bool m_RingLosesLabels = false;
};

/// Returns whether t can lose `label`, or be given it, without a change of that label's topology, that is, whether t is
/// a simple point: the other tetrahedra with the label, and likewise those without it, share one to three faces with t
/// and meet t nowhere but in these faces. A single tetrahedron of background enclosed by tissues may also vanish.
/// `starOf` returns the tetrahedra at a vertex. No face of t may lie on the border of the block.
bool isSimple(const TetComplex& complex, std::int32_t t, Label label,
              const std::function<const std::vector<std::int32_t>&(std::int32_t)>& starOf);

} // namespace surgicalmesher
