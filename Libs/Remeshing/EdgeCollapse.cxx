// SPDX-License-Identifier: Apache-2.0

// Edge collapse. Vertex u is merged into its neighbour v, at p, if all of these guards allow it, cheapest first:
//   1. locks and labels (mayCollapse): the star of a locked vertex continues in another block; a vertex of the
//      interface moves along it only, and no vertex inside a label moves the interface.
//   2. lengths (keepsLength): no edge becomes longer than allowed, and edges that are longer already do not grow.
//   3. quality (qualityAfterCollapse): positive volumes exclude crossings, and therefore the link condition on the
//      tetrahedra always holds.
//   4. features (Envelope::featuresStay) and samples (Envelope::samplesStay): the latter bound the Hausdorff distance
//      from the map's boundary, for each pair of labels, and in late sweeps refuse nine in ten collapses that get here.
//   5. triangles (Envelope::trianglesReach) and gaps (Envelope::spansGap): the shape of the new faces, and the distance
//      of their long edges from the samples.
//   6. topology (CollapseTopology::keepsTissues): exact for every label at the edge, junctions included.

#include "GuardedOperations.h"

#include <algorithm>

namespace surgicalmesher
{

bool GuardedOperations::mayCoarsen(std::int32_t u)
{
  if (!m_Curves || m_Curves->isOn(u)) return true;
  const auto& around = neighbours(u);
  return std::any_of(around.begin(), around.end(), [&](const auto& n) { return m_Curves->isOn(n.vertex); });
}

bool GuardedOperations::mayCollapse(std::int32_t u, std::int32_t v, bool moves) const
{
  const auto& c = m_Complex;
  if (c.locked[u] || (c.onInterface[u] && m_Envelope.isHeld())) return false;
  if (m_Curves && !m_Curves->mayCollapse(u, v)) return false;
  // The block may contain only some of the labels at a locked vertex.
  return c.onInterface[u] ? c.onInterface[v] && !c.locked[v] : !moves || (!c.onInterface[v] && !c.locked[v]);
}

/// Whether the edge from `end` to x, when `end` is replaced by v at p, is short enough or no longer than it is now.
bool GuardedOperations::keepsLength(std::int32_t end, std::int32_t x, std::int32_t v, const Vec3& p,
                                    double maximumRatio) const
{
  const auto& c = m_Complex;
  const double limit = maximumRatio * c.targetLength(x, v);
  const double length2 = squaredNorm(c.points[x] - p);
  return length2 <= limit * limit || length2 <= squaredNorm(c.points[x] - c.points[end]);
}

double GuardedOperations::qualityAfterCollapse(std::int32_t u, std::int32_t v, const Vec3& p, double atLeast,
                                               double maximumRatio)
{
  constexpr double tooLong = std::numeric_limits<double>::lowest();
  for (const Neighbour& n : neighbours(u))
    if (n.vertex != v && !keepsLength(u, n.vertex, v, p, maximumRatio)) return tooLong;
  const double worst = measured(u).worst(p, atLeast, v);
  if (worst < atLeast || p == m_Complex.points[v]) return worst;
  Star& star = target(v);
  for (const std::int32_t x : endsAt(star))
    if (x != u && !keepsLength(v, x, v, p, maximumRatio)) return tooLong;
  return std::min(worst, measured(v, star).worst(p, atLeast, u));
}

/// Finds the ring of uv. Returns false if it is not closed in the block, or if the topology is known to refuse.
bool GuardedOperations::findCollapsingRing(std::int32_t u, std::int32_t v)
{
  if (m_RefusedVertex != u) m_Refused.clear();
  m_RefusedVertex = u;
  if (std::find(m_Refused.begin(), m_Refused.end(), v) != m_Refused.end()) return false;
  const std::vector<std::int32_t>& star = this->star(u);
  const auto seed = std::find_if(star.begin(), star.end(), [&](std::int32_t t) { return m_Complex.contains(t, v); });
  if (seed != star.end() && m_Complex.ring(u, v, *seed, m_Ring, m_RingVertices)) return true;
  m_Refused.push_back(v);
  return false;
}

/// Whether every tissue keeps its topology. A refusal is remembered until the connectivity or u changes.
bool GuardedOperations::keepsTissues(std::int32_t u, std::int32_t v)
{
  if (m_Topology.keepsTissues(u, v, star(u), starOfTarget(v), m_Ring, m_RingVertices)) return true;
  m_Refused.push_back(v);
  return false;
}

namespace
{

template <std::size_t n>
bool contains(const std::array<std::int32_t, n>& vertices, std::int32_t v)
{
  return std::find(vertices.begin(), vertices.end(), v) != vertices.end();
}

} // namespace

/// Passes the interface faces at u and v to the envelope, with the faces that they become. Returns false at the border
/// of a block.
bool GuardedOperations::gatherCollapsingFaces(std::int32_t u, std::int32_t v, const Vec3& p)
{
  const auto& c = m_Complex;
  m_Envelope.clear();
  // Adds a face as it will be after the collapse: opposite vertex `opposite` of a tetrahedron `stays` that persists.
  const auto addMoved =
    [&](std::array<std::int32_t, 3> ids, LabelPair labels, std::int32_t stays, int opposite, bool changing)
  {
    Vec3 corners[3];
    for (int k = 0; k < 3; ++k)
    {
      if (ids[k] == u) ids[k] = v;
      corners[k] = ids[k] == v ? p : c.points[ids[k]];
    }
    m_Envelope.addNewFace(corners[0], corners[1], corners[2], ids, labels, stays, opposite, changing);
  };
  const auto addFacesAt = [&](const std::vector<FaceAtEnd>& faces, std::int32_t other, bool changing)
  {
    for (const auto& [face, beside] : faces)
    {
      if (contains(face.vertices, other) || contains(beside, other)) continue; // see the loop over the ring
      if (changing) m_Envelope.addOldFace(face);
      addMoved(face.vertices, face.labels, face.tet, face.face, changing);
    }
  };
  addFacesAt(facesAtEnd(u, m_Star), v, true);
  // Faces at v that stay as they are keep their samples, and may take others.
  addFacesAt(facesAtEnd(v, target(v)), u, !(p == c.points[v]));
  for (std::int32_t t : m_Ring)
  {
    const int iu = c.indexOf(t, u), iv = c.indexOf(t, v);
    for (int i = 0; i < 4; ++i)
      if (c.neighbours[t][i] >= 0 && c.isInterface(t, i)) m_Envelope.addOldFace(t, i);
    const std::int32_t nu = c.neighbours[t][iv], nv = c.neighbours[t][iu];
    if (nu < 0 || nv < 0) return false;
    if (c.labels[nu] == c.labels[nv]) continue;
    int opposite = 0;
    while (c.neighbours[nu][opposite] != t) ++opposite;
    addMoved({ c.tets[t][(iu + 1) & 3], c.tets[t][(iu + 2) & 3], c.tets[t][(iu + 3) & 3] },
             labelPair(c.labels[nu], c.labels[nv]), nu, opposite, true);
  }
  return true;
}

bool GuardedOperations::collapseWithin(std::int32_t u, std::int32_t v, const Vec3& p, double minimumQuality)
{
  auto& c = m_Complex;
  const bool moves = !(p == c.points[v]), inside = !c.onInterface[u];
  if (m_Curves && !m_Curves->mayCollapse(u, v, p)) return false;
  const std::vector<std::int32_t>& star = this->star(u);
  if (!inside)
  {
    if (!findCollapsingRing(u, v) || !gatherCollapsingFaces(u, v, p)) return false;
    if (!m_Envelope.featuresStay() || !m_Envelope.samplesStay()) return false;
    if (!m_Envelope.trianglesReach(minimumQuality) || m_Envelope.spansGap(v, c.points[u])) return false;
    if (!keepsTissues(u, v)) return false;
    m_Envelope.detach();
  }
  c.collapse(u, v, star);
  changed();
  if (!inside && m_Topology.ringLosesLabels())
    for (std::int32_t x : m_RingVertices)
      if (!c.locked[x]) c.onInterface[x] = meetsLabels(this->star(x));
  if (moves)
  {
    c.points[v] = p;
    c.lengths[v] = float(m_Length(p));
  }
  if (m_Curves) m_Curves->collapsed(u, v);
  if (!inside) m_Envelope.attach();
  ++m_Counts.collapses;
  m_Counts.t1 += !inside;
  return true;
}

bool GuardedOperations::collapse(std::int32_t u, std::int32_t v, const Vec3& p, double minimumQuality,
                                 double maximumRatio)
{
  return mayCollapse(u, v, !(p == m_Complex.points[v])) &&
         qualityAfterCollapse(u, v, p, minimumQuality, maximumRatio) >= minimumQuality &&
         collapseWithin(u, v, p, minimumQuality);
}

} // namespace surgicalmesher
