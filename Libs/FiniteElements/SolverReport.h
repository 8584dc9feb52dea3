// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Measures of a mesh that matter to solvers, as JSON objects for reports. Their members are described in
/// Docs/FuchsTetrahedralizer.md.

#include "ExplicitStep.h"
#include "StiffnessConditioning.h"

namespace surgicalmesher
{

/// Returns the explicit steps by tissue and the smallest tetrahedra with their reasons. `content` as for
/// smallestTetrahedra().
std::string explicitJSON(const MeshFile& content, const std::map<Label, ExplicitStep>& steps);

std::string stiffnessJSON(const StiffnessConditioning& conditioning, const TissueTable& tissues);

/// Returns a one-line summary for display.
std::string summaryOf(const StiffnessConditioning& conditioning);

} // namespace surgicalmesher
