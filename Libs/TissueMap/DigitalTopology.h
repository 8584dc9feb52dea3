#pragma once
/// Betti numbers of every tissue of a label map, under (6, 26) connectivity.

#include "TissueMap.h"

#include <map>

namespace surgicalmesher
{

struct Betti
{
  int components = 0; ///< b0
  int tunnels = 0;    ///< b1
  int cavities = 0;   ///< b2

  int euler() const { return components - tunnels + cavities; }
};

inline bool operator==(const Betti& a, const Betti& b)
{
  return a.components == b.components && a.tunnels == b.tunnels && a.cavities == b.cavities;
}

/// Topology of every tissue present (background excluded), in one pass over the grid plus union-find; voxels beyond the
/// grid count as background.
std::map<Label, Betti> tissueTopology(const TissueMap& map);

} // namespace surgicalmesher
