// SPDX-License-Identifier: Apache-2.0
#include "TissueTopology.h"

#include "UnionFind.h"

#include <algorithm>

namespace surgicalmesher
{

namespace
{

constexpr std::size_t mostLocalLabels = 30;

int bitCount(std::uint32_t x)
{
  int n = 0;
  for (; x; x &= x - 1) ++n;
  return n;
}

/// The triangles on the boundary of the union of two stars that belong to tetrahedra of one label.
class LabelShare
{
public:
  LabelShare(const TetComplex& complex, Label label) : m_Complex(complex), m_Label(label) {}

  /// Adds those opposite `centre` in tetrahedra of its star that do not contain `other`.
  void add(const std::vector<std::int32_t>& star, std::int32_t centre, std::int32_t other)
  {
    for (std::int32_t t : star)
    {
      if (m_Complex.labels[t] != m_Label || m_Complex.contains(t, other)) continue;
      std::array<std::int32_t, 3> x;
      std::remove_copy(m_Complex.tets[t].begin(), m_Complex.tets[t].end(), x.begin(), centre);
      std::sort(x.begin(), x.end());
      m_Corners.insert(m_Corners.end(), x.begin(), x.end());
      for (const auto& side : { std::array{ x[0], x[1] }, { x[0], x[2] }, { x[1], x[2] } })
        m_Sides.push_back({ side, m_Triangles });
      ++m_Triangles;
    }
  }

  /// Returns whether the triangles are connected and have Euler characteristic 1.
  bool isDisc()
  {
    std::sort(m_Corners.begin(), m_Corners.end());
    std::sort(m_Sides.begin(), m_Sides.end());
    const auto points = std::int32_t(std::unique(m_Corners.begin(), m_Corners.end()) - m_Corners.begin());
    std::int32_t shared = 0, components = m_Triangles;
    UnionFind connected(m_Triangles);
    for (std::size_t i = 1; i < m_Sides.size(); ++i)
    {
      if (m_Sides[i].first != m_Sides[i - 1].first) continue;
      ++shared;
      components -= connected.unite(m_Sides[i].second, m_Sides[i - 1].second);
    }
    return components == 1 && points - (3 * m_Triangles - shared) + m_Triangles == 1;
  }

private:
  const TetComplex& m_Complex;
  const Label m_Label;
  std::vector<std::int32_t> m_Corners;
  std::vector<std::pair<std::array<std::int32_t, 2>, std::int32_t>> m_Sides; ///< (edge, number of its triangle)
  std::int32_t m_Triangles = 0;
};

} // namespace

/// Returns a label's bit: one for each of the first 30 labels met, and a last one for all others.
std::uint32_t CollapseTopology::bitOf(Label label)
{
  const auto at = std::find(m_LocalLabels.begin(), m_LocalLabels.end(), label);
  const auto k = std::size_t(at - m_LocalLabels.begin());
  if (at == m_LocalLabels.end()) m_LocalLabels.push_back(label);
  return 1u << std::min<std::size_t>(k, mostLocalLabels);
}

/// Looks through the star of one end of an edge; `other` is the other end. Returns the labels of its tetrahedra that do
/// not contain `other`, and adds the labels that meet each vertex of the ring to its RingLabels member `atEnd`.
std::uint32_t CollapseTopology::lookAround(const std::vector<std::int32_t>& star, std::int32_t other,
                                           std::uint32_t RingLabels::*atEnd)
{
  std::uint32_t beside = 0;
  for (std::int32_t t : star)
  {
    const std::uint32_t bit = bitOf(m_Complex.labels[t]);
    bool isAtOther = false;
    for (std::int32_t x : m_Complex.tets[t])
    {
      isAtOther |= x == other;
      if (const Place& place = m_Places[x]; place.search == m_Search) m_RingLabels[place.at].*atEnd |= bit;
    }
    if (!isAtOther) beside |= bit;
  }
  return beside;
}

/// Returns the bit of the label that closes over tetrahedron t of the ring of uv when t vanishes: the label beyond both
/// of t's faces that do not contain edge uv. Returns 0 if these are different labels, or t's own.
std::uint32_t CollapseTopology::closingOver(std::int32_t t, std::int32_t u, std::int32_t v)
{
  const auto& c = m_Complex;
  const std::int32_t nu = c.neighbours[t][c.indexOf(t, v)], nv = c.neighbours[t][c.indexOf(t, u)];
  if (nu < 0 || nv < 0 || c.labels[nu] != c.labels[nv] || c.labels[nu] == c.labels[t]) return 0;
  return bitOf(c.labels[nu]);
}

/// Fills RingLabels::atEdge and m_Closed. Returns the labels that fail the link condition on their own boundary.
std::uint32_t CollapseTopology::compareEnds(std::int32_t u, std::int32_t v, const std::vector<std::int32_t>& ring)
{
  const auto& c = m_Complex;
  const std::size_t n = ring.size();
  std::uint32_t doubtful = 0;
  m_Closed = 0;
  for (std::size_t i = 0; i < n; ++i)
  {
    auto& [atU, atV, atEdge] = m_RingLabels[i];
    const std::int32_t before = ring[(i + n - 1) % n], after = ring[i];
    const std::uint32_t own = bitOf(c.labels[after]), closing = closingOver(after, u, v);
    atEdge = own | closing;
    m_Closed |= closing;
    if (c.labels[before] == c.labels[after] && bitCount(atU) > 1 && bitCount(atV) > 1) doubtful |= own;
  }
  return doubtful;
}

/// The collapse removes a label that occurs at both ends from the ball that the two stars form, and puts back the cone
/// over the label's share of the ball's boundary. This preserves the topology if the removed part was contractible and
/// the share is a disc:
///   - The stars meet in the ring of uv. The vertices and edges of the ring at which both stars have the label must
///     form a path.
///   - The share is certainly a disc if the label is not at edge uv, or if it closes over no tetrahedron of the ring
///     and meets the link condition on its own boundary; otherwise the share is examined.
///
/// The link condition on the tetrahedra themselves follows from positive volumes: the cone from v tiles star(u) only if
/// it holds.
bool CollapseTopology::keepsTissues(std::int32_t u, std::int32_t v, const std::vector<std::int32_t>& starOfU,
                                    const std::vector<std::int32_t>& starOfV, const std::vector<std::int32_t>& ring,
                                    const std::vector<std::int32_t>& ringVertices)
{
  m_LocalLabels.clear();
  std::uint32_t onEdge = 0;
  for (std::int32_t t : ring) onEdge |= bitOf(m_Complex.labels[t]);
  if (bitCount(onEdge) < 2) return false;
  m_RingLabels.assign(ring.size(), {});
  m_Places.resize(m_Complex.points.size());
  ++m_Search;
  for (std::size_t i = 0; i < ring.size(); ++i) m_Places[ringVertices[i]] = { m_Search, std::int32_t(i) };
  const std::uint32_t besideU = lookAround(starOfU, v, &RingLabels::atU);
  const std::uint32_t besideV = lookAround(starOfV, u, &RingLabels::atV);
  const std::uint32_t lost = onEdge & ~(besideU | besideV);
  if (m_LocalLabels.size() > mostLocalLabels || (lost != 0 && lost != bitOf(0))) return false;

  std::uint32_t doubtful = compareEnds(u, v, ring);
  doubtful |= m_Closed & onEdge;
  m_RingLosesLabels = (doubtful | m_Closed | lost) != 0;
  const std::uint32_t common = (besideU | onEdge) & (besideV | onEdge) & ~lost;
  for (std::size_t k = 0; common >> k != 0; ++k)
  {
    if (!(common >> k & 1)) continue;
    std::uint32_t vertices = 0, edges = 0;
    for (const auto& [atU, atV, atEdge] : m_RingLabels) vertices += (atU & atV) >> k & 1, edges += atEdge >> k & 1;
    if (edges == 0 || vertices != edges + 1) return false;
    if (!(doubtful >> k & 1)) continue;
    LabelShare share(m_Complex, m_LocalLabels[k]);
    share.add(starOfU, u, v);
    share.add(starOfV, v, u);
    if (!share.isDisc()) return false;
  }
  return true;
}

bool isSimple(const TetComplex& c, std::int32_t t, Label label,
              const std::function<const std::vector<std::int32_t>&(std::int32_t)>& starOf)
{
  std::array<int, 4> corners{}; // first those opposite neighbours with the label, then the others
  int shared = 0, rest = 4;
  for (int i = 0; i < 4; ++i) corners[c.labels[c.neighbours[t][i]] == label ? shared++ : --rest] = i;
  const auto meets = [&](int k, int l, bool has) // at corner k, or at the edge between corners k and l
  {
    const std::int32_t v = c.tets[t][corners[k]], w = c.tets[t][corners[l]];
    const auto& star = starOf(v);
    return std::any_of(star.begin(), star.end(),
                       [&](std::int32_t s) { return s != t && (c.labels[s] == label) == has && c.contains(s, w); });
  };
  if (shared == 0) return label == 0;
  if (shared == 1) return !meets(0, 0, true);
  if (shared == 3) return !meets(3, 3, false);
  return shared == 2 && !meets(0, 1, true) && !meets(2, 3, false);
}

} // namespace surgicalmesher
