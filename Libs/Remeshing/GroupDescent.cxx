// SPDX-License-Identifier: Apache-2.0
#include "GroupDescent.h"

#include "VertexSteps.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace surgicalmesher
{

GroupDescent::GroupDescent(GuardedOperations& operations, double target, double ease)
  : m_Operations(operations), m_Complex(operations.complex()), m_Target(target), m_Ease(ease)
{
}

void GroupDescent::setAround(std::int32_t v)
{
  std::vector<std::int32_t> vertices;
  if (!m_Complex.locked[v]) vertices.push_back(v);
  for (const auto& n : m_Operations.neighbours(v))
    if (!m_Complex.locked[n.vertex]) vertices.push_back(n.vertex);
  set(std::move(vertices));
}

void GroupDescent::set(std::vector<std::int32_t> vertices)
{
  m_Vertices = std::move(vertices);
  m_Moves.clear();
}

double GroupDescent::worst()
{
  double worst = std::numeric_limits<double>::max();
  for (const std::int32_t v : m_Vertices) worst = std::min(worst, m_Operations.qualityAt(v));
  return worst;
}

bool GroupDescent::step(double floor)
{
  const std::size_t soFar = m_Moves.size();
  for (const std::int32_t v : m_Vertices)
    if (const Vec3 p = m_Complex.points[v]; descend(v, floor)) m_Moves.push_back({ v, p });
  return m_Moves.size() > soFar;
}

void GroupDescent::takeBack()
{
  for (auto m = m_Moves.rbegin(); m != m_Moves.rend(); ++m) m_Operations.moveBack(m->first, m->second);
  for (const std::int32_t v : m_Vertices) m_Operations.reassignSamples(v);
  m_Moves.clear();
}

/// Returns the sum over the star of v, if v were at p, of the squared deficits of the sines, up to a quality of 1.15
/// target.
double GroupDescent::lack(std::int32_t v, const Vec3& p)
{
  const double enough = 1.15 * m_Target * (1 + 1e-9), wanted = std::sqrt(1.15 * m_Target);
  double sum = 0;
  StarQuality& star = m_Operations.measured(v);
  const std::vector<double>& qualities = star.each(p);
  for (std::size_t i = 0; i < star.size(); ++i)
  {
    if (qualities[i] > enough) continue;
    const double missing = wanted - std::sqrt(std::max(0.0, qualities[i]));
    if (missing > 0) sum += missing * missing;
  }
  return sum;
}

/// Moves v down the gradient of lack(), along the interface rather than across it. Returns whether v has moved.
bool GroupDescent::descend(std::int32_t v, double floor)
{
  const Vec3 p = m_Complex.points[v];
  const double now = lack(v, p), size = m_Complex.lengths[v], h = 1e-4 * size;
  if (!(now > 0)) return false;
  Vec3 direction;
  for (int a = 0; a < 3; ++a)
  {
    Vec3 q = p;
    q[a] += h;
    direction[a] = now - lack(v, q);
  }
  direction = easiest(m_Operations, v, heldAt(m_Operations, v, m_Ease), direction);
  for (double step : { 0.1, 0.03, 0.01, 0.003 })
  {
    const Vec3 q = p + step * size * direction;
    if (lack(v, q) < now && m_Operations.move(v, q, floor)) return true;
  }
  return false;
}

} // namespace surgicalmesher
