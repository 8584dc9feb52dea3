// SPDX-License-Identifier: Apache-2.0
#include "Fairing.h"

#include "TetQuality.h"

#include <algorithm>

namespace surgicalmesher
{

namespace
{

class Fairing
{
public:
  Fairing(GuardedOperations& operations, const FairingOptions& options)
    : m_Operations(operations), m_Complex(operations.complex()), m_Options(options),
      m_Least(sine2OfDegrees(options.leastAngle)), m_Start(m_Complex.points), m_Umbrella(m_Start.size())
  {
    m_Begin.reserve(m_Start.size() + 1);
    for (std::int32_t v = 0; v < std::int32_t(m_Start.size()); ++v)
    {
      m_Begin.push_back(std::int32_t(m_Neighbours.size()));
      if (m_Complex.vertexTet[v] >= 0 && m_Complex.onInterface[v]) addNeighbours(v);
    }
    m_Begin.push_back(std::int32_t(m_Neighbours.size()));
  }

  void run()
  {
    const std::int32_t count = std::int32_t(m_Start.size());
    for (int round = 0; round < m_Options.rounds; ++round)
    {
      for (std::int32_t v = 0; v < count; ++v) m_Umbrella[v] = umbrella(v, m_Complex.points);
      for (std::int32_t v = 0; v < count; ++v)
        if (hasNeighbours(v) && !m_Complex.locked[v]) flatten(v);
    }
  }

private:
  bool hasNeighbours(std::int32_t v) const { return m_Begin[v] < m_Begin[v + 1]; }

  /// The vertices next to v on its curve if it is on one, on its sheet otherwise; none where curves meet or end.
  void addNeighbours(std::int32_t v)
  {
    m_Faces.clear();
    const std::vector<SheetFace>& faces = m_Operations.sheet(v).faces;
    for (const SheetFace& f : faces)
      for (const std::int32_t u : f.vertices)
        if (u != v) countFace(u);
    const auto differs = [&](const SheetFace& f) { return f.labels != faces[0].labels; };
    const bool isOnCurve = std::any_of(faces.begin(), faces.end(), differs);
    const auto isAlong = [](const auto& n) { return n.second > 2; };
    if (std::count_if(m_Faces.begin(), m_Faces.end(), isAlong) != (isOnCurve ? 2 : 0)) return;
    for (const auto& n : m_Faces)
      if (!isOnCurve || isAlong(n)) m_Neighbours.push_back(n.first);
  }

  void countFace(std::int32_t u)
  {
    const auto at = std::find_if(m_Faces.begin(), m_Faces.end(), [u](const auto& n) { return n.first == u; });
    if (at == m_Faces.end()) m_Faces.push_back({ u, 1 });
    else ++at->second;
  }

  Vec3 umbrella(std::int32_t v, const std::vector<Vec3>& x) const
  {
    if (!hasNeighbours(v)) return {};
    Vec3 sum;
    for (std::int32_t i = m_Begin[v]; i < m_Begin[v + 1]; ++i) sum += x[m_Neighbours[i]];
    return sum / double(m_Begin[v + 1] - m_Begin[v]) - x[v];
  }

  void flatten(std::int32_t v)
  {
    constexpr double factor = 0.4; // of U(U(p)); stable up to 0.5
    const Vec3 p = m_Complex.points[v];
    const Vec3 step = withinReach(v, p - factor * umbrella(v, m_Umbrella)) - p;
    const double floor = std::min(m_Least, m_Operations.qualityAt(v));
    for (const double share : { 1.0, 0.5, 0.25 })
      if (m_Operations.move(v, p + share * step, floor)) return;
  }

  Vec3 withinReach(std::int32_t v, const Vec3& p) const
  {
    const double length = m_Complex.lengths[v], fineness = std::min(1.0, m_Options.fineLength / length);
    const double reach = std::min(0.3 * length, m_Options.farthest * fineness * fineness);
    const Vec3 way = p - m_Start[v];
    const double distance = norm(way);
    return distance > reach ? m_Start[v] + (reach / distance) * way : p;
  }

  GuardedOperations& m_Operations;
  TetComplex& m_Complex;
  const FairingOptions& m_Options;
  const double m_Least;
  const std::vector<Vec3> m_Start;
  std::vector<Vec3> m_Umbrella;
  std::vector<std::int32_t> m_Begin, m_Neighbours;   ///< those of v are m_Neighbours[m_Begin[v]..m_Begin[v + 1])
  std::vector<std::pair<std::int32_t, int>> m_Faces; ///< neighbours on the interface, and how many faces are at each
};

} // namespace

void fairBlock(GuardedOperations& operations, const FairingOptions& options) { Fairing(operations, options).run(); }

} // namespace surgicalmesher
