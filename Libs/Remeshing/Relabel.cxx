// SPDX-License-Identifier: Apache-2.0
#include "GuardedOperations.h"

namespace surgicalmesher
{

bool GuardedOperations::relabel(std::int32_t t, Label label, double minimumQuality, double mostLeft)
{
  auto& c = m_Complex;
  const TetComplex::Tet x = c.tets[t];
  const Label own = c.labels[t];
  if (label == own || m_Envelope.isHeld() || lenient(label, c.quality(t)) < minimumQuality) return false;
  bool isBeyond = false; // else t would be a piece of its own, which isSimple() allows the background
  for (int i = 0; i < 4; ++i)
  {
    const std::int32_t n = c.neighbours[t][i];
    if (n < 0 || c.locked[x[i]]) return false;
    if (c.labels[n] == label) isBeyond = true;
  }
  if (!isBeyond) return false;
  const auto starAt = [this](std::int32_t v) -> const std::vector<std::int32_t>& { return star(v); };
  if (!isSimple(c, t, own, starAt) || !isSimple(c, t, label, starAt)) return false;
  m_Envelope.clear();
  for (int i = 0; i < 4; ++i)
  {
    const Label beyond = c.labels[c.neighbours[t][i]];
    const std::array<std::int32_t, 3> ids{ x[(i + 1) & 3], x[(i + 2) & 3], x[(i + 3) & 3] };
    if (beyond != own) m_Envelope.addOldFace(t, i);
    if (beyond != label)
      m_Envelope.addNewFace(c.points[ids[0]], c.points[ids[1]], c.points[ids[2]], ids, labelPair(beyond, label));
  }
  if (!m_Envelope.trianglesReach(minimumQuality) || !m_Envelope.featuresStay() || !m_Envelope.samplesStay())
    return false;
  if (mostLeft < anyShare && !m_Envelope.comesNearer(mostLeft)) return false;
  if (m_Envelope.laysBare(t)) return false;
  m_Envelope.detach();
  c.labels[t] = label;
  changed();
  for (std::int32_t v : x) c.onInterface[v] = meetsLabels(star(v));
  m_Envelope.attach({ t });
  ++m_Counts.relabels;
  return true;
}

} // namespace surgicalmesher
