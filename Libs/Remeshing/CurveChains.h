// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Curves as chains of edges of a TetComplex, with guards that keep each chain within tolerance of its curve: vertices
/// slide along their curve and merge along it; edges of a chain are split, but never removed.

#include "CurveNetwork.h"
#include "TetComplex.h"

#include <unordered_map>

namespace surgicalmesher
{

class CurveChains
{
public:
  /// `tolerance`: greatest distance between a curve and its chain, both ways, in target lengths. `network` and
  /// `complex` must outlive this object.
  CurveChains(const CurveNetwork& network, const TetComplex& complex, double tolerance);

  // --- building
  /// Sets the vertex of a node of the network; chains begin and end at nodes.
  void setNode(int node, std::int32_t vertex);
  std::int32_t nodeVertex(int node) const { return m_NodeVertices[node]; }
  /// Appends edge ab to the chain of an arc. `from`, `to`: arc lengths of a and b.
  void link(std::size_t arc, std::int32_t a, double from, std::int32_t b, double to);

  // --- queries
  const CurveNetwork& network() const { return m_Network; }
  double tolerance() const { return m_Tolerance; }
  bool isOn(std::int32_t v) const { return m_Stations.count(v) > 0; }
  bool isEdge(std::int32_t a, std::int32_t b) const;
  struct Vertex
  {
    std::int32_t vertex;
    double s; ///< arc length
  };
  /// Returns the vertices of the chain of an arc, from its first node to its second.
  std::vector<Vertex> chain(std::size_t arc) const;

  // --- guards: mayX() before the change of the complex, the past participle after it
  bool mayMove(std::int32_t v, const Vec3& p) const;
  void moved(std::int32_t v);
  /// Whether u may be merged into v, whatever the position of v then.
  bool mayCollapse(std::int32_t u, std::int32_t v) const;
  /// Whether u may be merged into v with v at p.
  bool mayCollapse(std::int32_t u, std::int32_t v, const Vec3& p) const;
  void collapsed(std::int32_t u, std::int32_t v);
  bool maySplit(std::int32_t a, std::int32_t b, const Vec3& p) const;
  void split(std::int32_t a, std::int32_t b, std::int32_t middle);

  /// While lifted, chains may leave their tolerance: for undoing an operation.
  void setLifted(bool isLifted) { m_IsLifted = isLifted; }

private:
  /// The place of a vertex on an arc. The vertex of a node has one station for each arc end at the node.
  struct Station
  {
    std::size_t arc;
    double s;                    ///< arc length
    std::int32_t previous, next; ///< neighbouring vertices along the arc; -1: the arc ends here

    bool isEnd() const { return previous < 0 || next < 0; }
    std::int32_t beyond(std::int32_t v) const { return previous == v ? next : previous; }
  };
  using Stations = std::vector<Station>;

  /// A neighbouring vertex in a chain, and its arc length.
  struct Beside
  {
    std::int32_t vertex; ///< -1: none
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
  std::unordered_map<std::int32_t, Stations> m_Stations; ///< by vertex; never iterated: the order is arbitrary
};

} // namespace surgicalmesher
