// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Properties that the mesh of every map must have; shared by the tests and the fuzzer.

#include "DigitalTopology.h"
#include "Errors.h"
#include "FaceAdjacency.h"
#include "GuardedOperations.h"
#include "MeshChecks.h"
#include "TissueMesher.h"
#include "Triangle.h"

#include <cmath>
#include <map>
#include <sstream>
#include <string>

namespace surgicalmesher::test
{

/// Returns the first fault of the mesh of `map`, or an empty text. The mesh must be sound, every tissue must have the
/// topology of the map, and every sample must lie on a face between a larger and a smaller label, within its tolerance.
inline std::string faultOf(const MeshedMap& result, const TissueMap& map)
{
  const TetMesh& mesh = result.background.mesh;
  try
  {
    requireSound(mesh, "mesh");
  }
  catch (const EngineError& error)
  {
    return error.what();
  }
  std::ostringstream fault;
  const auto wanted = tissueTopology(map), got = meshTopology(mesh);
  for (const auto& [label, betti] : wanted)
  {
    const auto at = got.find(label);
    const Betti is = at == got.end() ? Betti{} : at->second;
    if (is == betti) continue;
    fault << "tissue " << label << " has " << is.components << " components, " << is.tunnels << " tunnels and "
          << is.cavities << " cavities, expected " << betti.components << ", " << betti.tunnels << " and "
          << betti.cavities;
    return fault.str();
  }
  if (got.size() != wanted.size()) return "there are tissues that the map does not have";
  if (result.background.lengths.size() != mesh.points.size()) return "there is not one target length per point";
  const auto neighbours = faceAdjacency(mesh);
  const Vec3 h = map.grid.spacing;
  constexpr double widestTolerance = 2.1, separatedFactor = 2; // see Schedule.cxx and EnvelopeBounds
  const auto allowed = [&](double tolerance) {
    return separatedFactor * widestTolerance * tolerance + std::min({ h.x, h.y, h.z });
  };
  for (const auto& e : result.background.samples)
  {
    const std::int32_t n = neighbours.across[e.tetrahedron][e.face];
    if (n < 0 || mesh.labels[n] >= mesh.labels[e.tetrahedron])
      return "samples at " + place(e.position) + " is off the interface";
    const auto corner = [&](int k) { return mesh.points[mesh.tetrahedra[e.tetrahedron][(e.face + k) & 3]]; };
    const double distance = std::sqrt(squaredDistanceToTriangle(e.position, corner(1), corner(2), corner(3)));
    if (distance <= allowed(e.tolerance) * (1 + 1e-5)) continue;
    fault << "samples at " << place(e.position) << " is " << distance << " mm away, allowed " << allowed(e.tolerance);
    return fault.str();
  }
  return "";
}

} // namespace surgicalmesher::test
