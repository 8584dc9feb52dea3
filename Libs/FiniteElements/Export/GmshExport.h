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

/// Version 2.2 as SimNIBS 4 reads it: in RAS, the tag of a tetrahedron its label, those of a tissue's faces 1000 more. A
/// face between two tissues is listed once, wound out of that of its two that SimNIBS ranks first (white matter, gray
/// matter, blood, cerebrospinal fluid, bone, spongy and compact bone, eyes, muscle, skin, others). Throws InputError for
/// labels from 100 on, which are electrodes to it, and UsageError for other elements than tetrahedra; no shells and curves.
void writeSimnibs(const FiniteElementModel& model, const std::string& file, const Destination& destination);

} // namespace surgicalmesher
