// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Report of a run of the volume stage: JSON, and a line for the terminal.

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
  std::optional<StiffnessConditioning> conditioning; ///< only on request, since it takes time
  bool fromBackground;                               ///< started from background tetrahedra, not from the surface alone
  std::vector<std::string> warnings;
};

std::string reportJson(const MeshReport& report);

/// Returns a sentence with the numbers of tetrahedra and points, angles, lengths, and measures that matter to solvers.
std::string summaryOf(const MeshReport& report);

} // namespace surgicalmesher
