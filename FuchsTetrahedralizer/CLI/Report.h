// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What a run of the volume stage made: JSON, and a line for the terminal.

#include "ExplicitStep.h"
#include "MeshChecks.h"
#include "MeshQuality.h"
#include "StiffnessConditioning.h"
#include "Tetrahedralizer.h"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace surgicalmesher
{

struct MeshReport
{
  const FiniteElementMesh& mesh;
  const MeshQuality& quality;
  const std::map<Label, ExplicitStep>& steps;
  const std::map<Label, Betti>& topology;
  std::optional<StiffnessConditioning> conditioning; ///< it takes its time
  bool fromBackground;                               ///< tetrahedra, not from the surface alone
  std::vector<std::string> warnings;
};

std::string reportJson(const MeshReport& report);

/// Tetrahedra, points, angles, lengths and what solvers feel in one sentence.
std::string summaryOf(const MeshReport& report);

} // namespace surgicalmesher
