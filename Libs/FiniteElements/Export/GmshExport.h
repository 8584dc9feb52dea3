// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Gmsh meshes: .msh is version 4.1, .msh2 is 2.2, as Gmsh itself has it. Text.
///
/// Elements have the numbers that they have in the mesh, from 1; nodes likewise.

#include "Export.h"

namespace surgicalmesher
{

/// Version 4.1. Every set is a physical group, with its name, its tag (see SetTags.h) and all its elements: element
/// sets of dimension 3, interfaces, outer boundary and shells of dimension 2, null-displacement nodes of dimension 0.
/// Entities are the disjoint pieces of the sets.
void writeGmsh41(const FiniteElementModel& model, const std::string& file, const Destination& destination);

/// Version 2.2, in which an element has one physical group: an element its tissue, a face its piece (see
/// SetTags.h).
void writeGmsh22(const FiniteElementModel& model, const std::string& file, const Destination& destination);

} // namespace surgicalmesher
