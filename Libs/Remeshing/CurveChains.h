// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Curves along the edges of a TetComplex, and whether an operation leaves each a chain of edges within its tolerance:
/// vertices slide along their curve and merge along it; edges of a chain are split, but never removed.

#include "CurveNetwork.h"
#include "TetComplex.h"

#include <unordered_map>

namespace surgicalmesher
{

class CurveChains
{
public:
  /// `tolerance`: of a curve to its chain and back, target lengths. Both arguments must live as long.
  CurveChains(const CurveNetwork& network, const TetComplex& complex, double tolerance);

  // --- building
  /// Names the vertex of a node; chains begin there.
  void setNode(int node, std::int32_t vertex);
  std::int32_t nodeVertex(int node) const { return m_NodeVertices[node]; }
  /// Goes on with the chain of an arc: from its vertex a, at arc length `from`, by the edge ab to `to`.
  void link(std::size_t arc, std::int32_t a, double from, std::int32_t b, double to);

  // --- queries
  const CurveNetwork& network() const { return m_Network; }
  double tolerance() const { return m_Tolerance; }
  bool isOn(std::int32_t v) const { return m_Stations.count(v) > 0; }
  bool isEdge(std::int32_t a, std::int32_t b) const;
  struct Vertex
  {
    std::int32_t vertex;
    double s;
  };
  /// The chain of an arc from its first node to its second.
  std::vector<Vertex> chain(std::size_t arc) const;

  // --- guards; each is asked before the change, and told after it
  bool mayMove(std::int32_t v, const Vec3& p) const;
  void moved(std::int32_t v);
  /// Whether u may go into v at all.
  bool mayCollapse(std::int32_t u, std::int32_t v) const;
  /// The same with v at p.
  bool mayCollapse(std::int32_t u, std::int32_t v, const Vec3& p) const;
  void collapsed(std::int32_t u, std::int32_t v);
  bool maySplit(std::int32_t a, std::int32_t b, const Vec3& p) const;
  void split(std::int32_t a, std::int32_t b, std::int32_t middle);

  /// While set, chains may lie anywhere: to take back what was so before.
  void setLifted(bool isLifted) { m_IsLifted = isLifted; }

private:
  /// A vertex on an arc. The vertex of a node has one for each end of an arc there.
  struct Station
  {
    std::size_t arc;
    double s;
    std::int32_t previous, next; ///< along the arc; -1: the arc ends here

    bool isEnd() const { return previous < 0 || next < 0; }
    std::int32_t beyond(std::int32_t v) const { return previous == v ? next : previous; }
  };
  using Stations = std::vector<Station>;

  /// An end of a chain's edge and where on the arc it is.
  struct Beside
  {
    std::int32_t vertex;
    double s;
  };

  const Stations& stationsOf(std::int32_t v) const;
  Station& addedStation(std::int32_t v, std::size_t arc, double s);
  Station* stationBeside(std::int32_t v, std::size_t arc, std::int32_t neighbour);
  double placeBeside(std::int32_t v, std::size_t arc, std::int32_t neighbour) const;
  double placeOf(const Station& station, const Beside& previous, const Beside& next, const Vec3& p) const;
  bool mayLie(const Station& station, const Beside& previous, const Beside& next, const Vec3& p) const;
  Beside besideOf(std::int32_t v, const Station& station, std::int32_t neighbour, std::int32_t gone) const;
  bool mayLie(std::int32_t v, const Vec3& p, std::int32_t gone) const;

  const CurveNetwork& m_Network;
  const TetComplex& m_Complex;
  const double m_Tolerance;
  bool m_IsLifted = false;
  std::vector<std::int32_t> m_NodeVertices;
  std::unordered_map<std::int32_t, Stations> m_Stations; ///< looked up only, never iterated
};

} // namespace surgicalmesher
