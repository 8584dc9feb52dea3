// SPDX-License-Identifier: Apache-2.0
#include "GuardedOperations.h"

#include "Folds.h"

namespace surgicalmesher
{

bool GuardedOperations::moveWithin(std::int32_t v, const Vec3& p)
{
  if (m_Curves && !m_Curves->mayMove(v, p)) return false;
  if (m_Complex.onInterface[v])
  {
    if (m_Envelope.isHeld()) return false;
    const Sheet& faces = sheet(v);
    if (!m_Envelope.allowsSheetAt(p)) return false; // before folds, as it is cheaper and refuses most
    constexpr double rounding = 1e-6;
    if (m_KeepsFolds && foldedMore(m_Complex, v, p, faces) > rounding * m_Complex.lengths[v]) return false;
    m_Envelope.handOn();
  }
  place(v, p);
  ++m_Counts.moves;
  return true;
}

void GuardedOperations::moveBack(std::int32_t v, const Vec3& p)
{
  if (m_Complex.onInterface[v])
  {
    sheet(v);
    m_Envelope.handToNearest(p);
  }
  place(v, p);
  --m_Counts.moves;
}

void GuardedOperations::reassignSamples(std::int32_t v)
{
  if (!m_Complex.onInterface[v]) return;
  sheet(v);
  if (m_Envelope.hasSampleBeyondTolerance()) m_Envelope.handToNearest(m_Complex.points[v]);
}

void GuardedOperations::place(std::int32_t v, const Vec3& p)
{
  m_Complex.points[v] = p;
  m_Complex.lengths[v] = float(m_Length(p));
  if (m_Curves) m_Curves->moved(v);
  if (m_Star.vertex != v) m_Star.isMeasured = false;
  for (Star& star : m_Targets)
    if (star.vertex != v) star.isMeasured = false;
  for (Star& star : m_Recent)
    if (star.vertex != v) star.isMeasured = false;
}

} // namespace surgicalmesher
