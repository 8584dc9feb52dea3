// SPDX-License-Identifier: Apache-2.0
#include "CurveChains.h"

#include <algorithm>

namespace surgicalmesher
{

namespace
{

constexpr double leastGap = 0.02; // between vertices of a chain along the curve, in target lengths

} // namespace

CurveChains::CurveChains(const CurveNetwork& network, const TetComplex& complex, double tolerance)
  : m_Network(network), m_Complex(complex), m_Tolerance(tolerance), m_NodeVertices(network.nodes.size(), -1)
{
}

// --- building -------------------------------------------------------------------------------------------------------

void CurveChains::setNode(int node, std::int32_t vertex)
{
  m_NodeVertices[node] = vertex;
  m_Stations[vertex];
}

void CurveChains::link(std::size_t arc, std::int32_t a, double from, std::int32_t b, double to)
{
  addedStation(a, arc, from).next = b;
  addedStation(b, arc, to).previous = a;
}

CurveChains::Station& CurveChains::addedStation(std::int32_t v, std::size_t arc, double s)
{
  Stations& stations = m_Stations[v];
  for (Station& station : stations)
    if (station.arc == arc && station.s == s) return station;
  stations.push_back({ arc, s, -1, -1 });
  return stations.back();
}

// --- queries --------------------------------------------------------------------------------------------------------

const CurveChains::Stations& CurveChains::stationsOf(std::int32_t v) const
{
  static const Stations none;
  const auto found = m_Stations.find(v);
  return found == m_Stations.end() ? none : found->second;
}

bool CurveChains::isEdge(std::int32_t a, std::int32_t b) const
{
  const Stations& stations = stationsOf(a);
  return std::any_of(stations.begin(), stations.end(),
                     [&](const Station& station) { return station.previous == b || station.next == b; });
}

std::vector<CurveChains::Vertex> CurveChains::chain(std::size_t arc) const
{
  std::vector<Vertex> result;
  std::int32_t v = m_NodeVertices[m_Network.arcs[arc].nodes[0]], before = -1;
  while (v >= 0)
  {
    const Stations& stations = stationsOf(v);
    const auto at =
      std::find_if(stations.begin(), stations.end(),
                   [&](const Station& station) { return station.arc == arc && station.previous == before; });
    result.push_back({ v, at->s });
    before = v;
    v = at->next;
  }
  return result;
}

CurveChains::Station* CurveChains::stationBeside(std::int32_t v, std::size_t arc, std::int32_t neighbour)
{
  for (Station& station : m_Stations.at(v))
    if (station.arc == arc && (station.previous == neighbour || station.next == neighbour)) return &station;
  return nullptr;
}

/// Returns the arc length of v on an arc whose chain contains the edge from v to `neighbour`.
double CurveChains::placeBeside(std::int32_t v, std::size_t arc, std::int32_t neighbour) const
{
  return const_cast<CurveChains*>(this)->stationBeside(v, arc, neighbour)->s;
}

// --- guards ---------------------------------------------------------------------------------------------------------

/// Returns the arc length of a vertex at p, between those of its neighbours; ends of an arc keep theirs.
double CurveChains::placeOf(const Station& station, const Beside& previous, const Beside& next, const Vec3& p) const
{
  return station.isEnd() ? station.s : m_Network.arcs[station.arc].nearest(p, previous.s, next.s);
}

bool CurveChains::mayLie(const Station& station, const Beside& previous, const Beside& next, const Vec3& p) const
{
  const CurveArc& arc = m_Network.arcs[station.arc];
  const double at = placeOf(station, previous, next, p), gap = leastGap * arc.lengthAt(at);
  if (previous.vertex >= 0 &&
      (at < previous.s + gap || !arc.isFollowed(previous.s, m_Complex.points[previous.vertex], at, p, m_Tolerance)))
    return false;
  return next.vertex < 0 ||
         (at <= next.s - gap && arc.isFollowed(at, p, next.s, m_Complex.points[next.vertex], m_Tolerance));
}

/// Returns `neighbour`, the vertex before or after v's station, with its arc length; the vertex beyond if it is `gone`.
CurveChains::Beside CurveChains::besideOf(std::int32_t v, const Station& station, std::int32_t neighbour,
                                          std::int32_t gone) const
{
  if (neighbour < 0) return { -1, 0 };
  if (neighbour != gone) return { neighbour, placeBeside(neighbour, station.arc, v) };
  const std::int32_t beyond = stationsOf(gone).front().beyond(v);
  return { beyond, placeBeside(beyond, station.arc, gone) };
}

/// Whether v may lie at p once its neighbour `gone` (-1: none) has been merged into it.
bool CurveChains::mayLie(std::int32_t v, const Vec3& p, std::int32_t gone) const
{
  const Stations& stations = stationsOf(v);
  return m_IsLifted || std::all_of(stations.begin(), stations.end(),
                                   [&](const Station& station) {
                                     return mayLie(station, besideOf(v, station, station.previous, gone),
                                                   besideOf(v, station, station.next, gone), p);
                                   });
}

bool CurveChains::mayMove(std::int32_t v, const Vec3& p) const { return mayLie(v, p, -1); }

void CurveChains::moved(std::int32_t v)
{
  const auto found = m_Stations.find(v);
  if (found == m_Stations.end()) return;
  for (Station& station : found->second)
    station.s = placeOf(station, besideOf(v, station, station.previous, -1), besideOf(v, station, station.next, -1),
                        m_Complex.points[v]);
}

bool CurveChains::mayCollapse(std::int32_t u, std::int32_t v) const
{
  const Stations& stations = stationsOf(u);
  if (!isOn(u)) return true;
  if (stations.size() != 1 || stations.front().isEnd()) return false;
  const Station& station = stations.front();
  return (station.previous == v || station.next == v) && !isEdge(station.beyond(v), v);
}

bool CurveChains::mayCollapse(std::int32_t u, std::int32_t v, const Vec3& p) const
{
  if (!mayCollapse(u, v)) return false;
  if (isOn(u)) return mayLie(v, p, u);
  return !isOn(v) || p == m_Complex.points[v] || mayMove(v, p);
}

void CurveChains::collapsed(std::int32_t u, std::int32_t v)
{
  if (isOn(u))
  {
    const Station gone = stationsOf(u).front();
    const std::int32_t beyond = gone.beyond(v);
    Station &atV = *stationBeside(v, gone.arc, u), &atBeyond = *stationBeside(beyond, gone.arc, u);
    (atV.previous == u ? atV.previous : atV.next) = beyond;
    (atBeyond.previous == u ? atBeyond.previous : atBeyond.next) = v;
    m_Stations.erase(u);
  }
  moved(v);
}

bool CurveChains::maySplit(std::int32_t a, std::int32_t b, const Vec3& p) const
{
  if (m_IsLifted || !isEdge(a, b)) return true;
  for (const Station& station : stationsOf(a))
  {
    if (station.previous != b && station.next != b) continue;
    const Beside atA{ a, station.s }, atB{ b, placeBeside(b, station.arc, a) };
    const Station middle{ station.arc, 0, a, b };
    if (!mayLie(middle, station.next == b ? atA : atB, station.next == b ? atB : atA, p)) return false;
  }
  return true;
}

void CurveChains::split(std::int32_t a, std::int32_t b, std::int32_t middle)
{
  if (!isEdge(a, b)) return;
  for (Station& station : m_Stations.at(a))
  {
    if (station.previous != b && station.next != b) continue;
    Station& atB = *stationBeside(b, station.arc, a);
    const bool isForward = station.next == b;
    const Station fresh{ station.arc, 0.5 * (station.s + atB.s), isForward ? a : b, isForward ? b : a };
    (isForward ? station.next : station.previous) = middle;
    (isForward ? atB.previous : atB.next) = middle;
    m_Stations[middle].push_back(fresh);
    break;
  }
  moved(middle);
}

} // namespace surgicalmesher
