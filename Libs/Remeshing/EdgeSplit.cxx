// SPDX-License-Identifier: Apache-2.0
#include "GuardedOperations.h"

#include <cassert>

namespace surgicalmesher
{

std::optional<std::int32_t> GuardedOperations::split(std::int32_t a, std::int32_t b, std::int32_t seed, const Vec3& p,
                                                     double minimumQuality)
{
  auto& c = m_Complex;
  if (m_Curves && !m_Curves->maySplit(a, b, p)) return {};
  if (!c.ring(a, b, seed, m_Ring, m_RingVertices)) return {};
  for (std::int32_t t : m_Ring)
    if (lenient(t, c.qualityWith(t, a, p)) < minimumQuality || lenient(t, c.qualityWith(t, b, p)) < minimumQuality)
      return {};
  m_Envelope.clear();
  const std::int32_t m = std::int32_t(c.points.size()); // id of the new vertex
  const std::size_t n = m_Ring.size();
  for (std::size_t i = 0; i < n; ++i)
  {
    const std::int32_t t = m_Ring[i], before = m_Ring[(i + n - 1) % n], x = m_RingVertices[i];
    if (c.labels[t] == c.labels[before]) continue;
    for (int k = 0; k < 4; ++k)
      if (c.neighbours[t][k] == before) m_Envelope.addOldFace(t, k);
    for (std::int32_t end : { a, b })
      m_Envelope.addNewFace(c.points[end], p, c.points[x], { end, m, x }, labelPair(c.labels[t], c.labels[before]));
  }
  if (m_Envelope.hasNewFaces() && m_Envelope.isHeld()) return {};
  if (!m_Envelope.trianglesReach(minimumQuality) || !m_Envelope.featuresStay() || !m_Envelope.samplesStay()) return {};
  m_Envelope.detach();
  c.addVertex(p, float(m_Length(p)), m_Envelope.hasNewFaces());
  std::vector<TetComplex::Tet> fresh;
  std::vector<Label> labels;
  for (std::int32_t t : m_Ring)
    for (std::int32_t end : { a, b })
    {
      auto x = c.tets[t];
      x[c.indexOf(t, end)] = m;
      fresh.push_back(x);
      labels.push_back(c.labels[t]);
    }
  const auto ids = c.replace(m_Ring, fresh, labels);
  if (m_Curves) m_Curves->split(a, b, m);
  changed();
  m_Envelope.attach(ids);
  ++m_Counts.splits;
  m_Counts.t2 += m_Envelope.hasNewFaces();
  return m;
}

void GuardedOperations::takeBackSplit(std::int32_t v, std::int32_t a)
{
  const Envelope::Lifted lifted(m_Envelope); // the state restored was valid
  if (m_Curves) m_Curves->setLifted(true);
  const OperationCounts before = m_Counts;
  const bool done = collapseWithin(v, a, m_Complex.points[a], 0);
  assert(done);
  if (m_Curves) m_Curves->setLifted(false);
  m_Counts.splits -= done;
  m_Counts.t2 -= m_Counts.t1 - before.t1;
  m_Counts.collapses = before.collapses;
  m_Counts.t1 = before.t1;
}

} // namespace surgicalmesher
