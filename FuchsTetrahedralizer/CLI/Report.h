// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What a run of the volume stage made: JSON, and a line for the terminal.

#include "MeshQuality.h"
#include "Tetrahedralizer.h"

#include <string>
#include <vector>

namespace surgicalmesher
{

struct MeshReport
{
  const FiniteElementMesh& mesh;
  const MeshQuality& quality;
  bool fromBackground;   ///< tetrahedra, not from the surface alone
  bool withConditioning; ///< of the stiffness matrix (stiffnessConditioning), which takes its time
  std::vector<std::string> warnings;
};

std::string reportJson(const MeshReport& report);

/// Tetrahedra, points, angles and lengths in one sentence.
std::string summaryOf(const QualityGroup& whole);

} // namespace surgicalmesher
