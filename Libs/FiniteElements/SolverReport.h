// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What solvers feel of a mesh, as JSON objects for reports. Their members are explained in
/// Docs/FuchsTetrahedralizer.md.

#include "ExplicitStep.h"
#include "StiffnessConditioning.h"

namespace surgicalmesher
{

/// Explicit steps by tissue, and the smallest tetrahedra with their reasons. `content` as smallestTetrahedra() has it.
std::string explicitJSON(const MeshFile& content, const std::map<Label, ExplicitStep>& steps);

std::string stiffnessJSON(const StiffnessConditioning& conditioning, const TissueTable& tissues);

/// In one line, for people.
std::string summaryOf(const StiffnessConditioning& conditioning);

} // namespace surgicalmesher
