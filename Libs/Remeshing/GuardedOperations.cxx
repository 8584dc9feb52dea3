// SPDX-License-Identifier: Apache-2.0

// Stars, qualities and other measures that all guarded operations share. The operations themselves are in EdgeCollapse,
// VertexMove, EdgeRemoval, EdgeSplit and Relabel.

#include "GuardedOperations.h"

#include "TetQuality.h"

#include <algorithm>
#include <utility>

namespace surgicalmesher
{

OperationCounts& OperationCounts::operator+=(const OperationCounts& more)
{
  collapses += more.collapses;
  moves += more.moves;
  flips += more.flips;
  splits += more.splits;
  relabels += more.relabels;
  t1 += more.t1;
  t2 += more.t2;
  t7 += more.t7;
  return *this;
}

GuardedOperations::GuardedOperations(TetComplex& complex, SizingFunction length, const EnvelopeBounds& bounds,
                                     double rigidity, CurveChains* curves)
  : m_Complex(complex), m_Curves(curves), m_Length(std::move(length)), m_Envelope(complex, bounds), m_Topology(complex),
    m_TriangleWeight(bounds.triangleWeight), m_Rigidity(rigidity), m_KeepsFolds(bounds.keepsFolds)
{
}

void GuardedOperations::changed()
{
  m_Star.vertex = m_NeighboursVertex = m_RefusedVertex = -1;
  for (Star& star : m_Targets) star.vertex = -1;
  for (Star& star : m_Recent) star.vertex = -1;
  m_Envelope.forgetSheet();
}

double GuardedOperations::quality(std::int32_t t) const
{
  const auto& c = m_Complex;
  double result = lenient(t, c.quality(t));
  if (m_TriangleWeight == 0 || !c.mayHaveInterface(t)) return result;
  const auto corner = [&](int i) { return c.points[c.tets[t][i & 3]]; };
  for (int i = 0; i < 4; ++i)
    if (c.isInterfaceOfLesser(t, i))
      result = std::min(result, m_TriangleWeight * smallestSine2(corner(i + 1), corner(i + 2), corner(i + 3)));
  return result;
}

double GuardedOperations::worstQuality(const std::vector<std::int32_t>& tetrahedra) const
{
  double worst = std::numeric_limits<double>::max();
  for (std::int32_t t : tetrahedra) worst = std::min(worst, quality(t));
  return worst;
}

const std::vector<std::int32_t>& GuardedOperations::starOf(std::int32_t v, Star& star)
{
  if (star.vertex != v)
  {
    if (&star == &m_Star && recall(v)) return star.tets;
    m_Complex.star(v, star.tets);
    star.vertex = v;
    star.isMeasured = star.hasFaces = star.hasFacesAtEnd = false;
    star.ends.clear();
  }
  return star.tets;
}

/// Exchanges m_Star for the star of v, if it is in m_Recent, or else for the entry to be replaced next. Returns whether
/// it was found.
bool GuardedOperations::recall(std::int32_t v)
{
  const auto known = std::find_if(m_Recent.begin(), m_Recent.end(), [v](const Star& star) { return star.vertex == v; });
  std::swap(m_Star, known != m_Recent.end() ? *known : m_Recent[m_NextRecent++ % m_Recent.size()]);
  return known != m_Recent.end();
}

GuardedOperations::Star& GuardedOperations::target(std::int32_t v)
{
  auto known = std::find_if(m_Targets.begin(), m_Targets.end(), [v](const Star& star) { return star.vertex == v; });
  if (known == m_Targets.end()) known = m_Targets.begin() + std::ptrdiff_t(m_NextTarget++ % m_Targets.size());
  starOf(v, *known);
  return *known;
}

const std::vector<std::int32_t>& GuardedOperations::endsAt(Star& star)
{
  if (!star.ends.empty()) return star.ends;
  m_Seen.resize(m_Complex.points.size());
  m_Seen[star.vertex].search = ++m_Search;
  for (const std::int32_t t : star.tets)
    for (const std::int32_t x : m_Complex.tets[t])
      if (m_Seen[x].search != m_Search)
      {
        m_Seen[x].search = m_Search;
        star.ends.push_back(x);
      }
  return star.ends;
}

const std::vector<TetComplex::FaceOfTet>& GuardedOperations::interfaceFacesOf(std::int32_t v, Star& star)
{
  starOf(v, star);
  if (!std::exchange(star.hasFaces, true)) m_Complex.interfaceFaces(v, star.tets, star.faces);
  return star.faces;
}

const std::vector<GuardedOperations::FaceAtEnd>& GuardedOperations::facesAtEnd(std::int32_t v, Star& star)
{
  interfaceFacesOf(v, star);
  if (std::exchange(star.hasFacesAtEnd, true)) return star.facesAtEnd;
  const auto& c = m_Complex;
  star.facesAtEnd.clear();
  for (const auto& [t, i] : star.faces)
  {
    const SheetFace face = sheetFace(c, t, i);
    const auto& [x, y, z] = face.vertices;
    star.facesAtEnd.push_back({ face, { c.tets[t][i], c.fourthVertex(c.neighbours[t][i], x, y, z) } });
  }
  return star.facesAtEnd;
}

StarQuality& GuardedOperations::measured(std::int32_t v, Star& star)
{
  starOf(v, star);
  if (std::exchange(star.isMeasured, true)) return star.quality;
  if (m_TriangleWeight > 0) star.quality.gather(m_Complex, v, star.tets, interfaceFacesOf(v, star), m_TriangleWeight);
  else star.quality.gather(m_Complex, v, star.tets);
  return star.quality;
}

const std::vector<GuardedOperations::Neighbour>& GuardedOperations::neighbours(std::int32_t v)
{
  if (m_NeighboursVertex == v) return m_Neighbours;
  m_NeighboursVertex = v;
  const std::vector<std::int32_t>& star = this->star(v);
  m_Neighbours.resize(3 * star.size()); // at most
  m_Seen.resize(m_Complex.points.size());
  ++m_Search;
  std::int32_t count = 0;
  for (std::int32_t t : star)
    for (const int k : TetComplex::otherCorners[m_Complex.indexOf(t, v)])
    {
      const std::int32_t x = m_Complex.tets[t][k];
      const Label label = m_Complex.labels[t];
      Seen& seen = m_Seen[x];
      const bool isNew = seen.search != m_Search;
      m_Neighbours[count] = { x, false }; // overwritten unless x is new; a branch would be unpredictable
      seen = { m_Search, isNew ? count : seen.at, isNew ? label : seen.label };
      m_Neighbours[seen.at].alongInterface |= label != seen.label;
      count += std::int32_t(isNew);
    }
  m_Neighbours.resize(count);
  return m_Neighbours;
}

bool GuardedOperations::meetsLabels(const std::vector<std::int32_t>& star) const
{
  const auto& labels = m_Complex.labels;
  return std::any_of(star.begin(), star.end(), [&](std::int32_t t) { return labels[t] != labels[star.front()]; });
}

std::optional<Vec3> GuardedOperations::nearestSampleOf(std::int32_t v)
{
  const SheetSample* sample = nearestSample(sheet(v), m_Complex.points[v]).first;
  return sample ? std::optional(sample->position) : std::nullopt;
}

bool GuardedOperations::isSpike(std::int32_t v, double tolerances)
{
  const Vec3 p = m_Complex.points[v];
  const SheetSample* sample = nearestSample(sheet(v), p).first;
  return sample && m_Envelope.isBeyond(*sample, m_Envelope.squaredDistanceBy(*sample, p), tolerances);
}

} // namespace surgicalmesher
