// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Gmsh meshes in text form: .msh is version 4.1, .msh2 is version 2.2, as in Gmsh itself.
///
/// Nodes and volume elements have the numbers of the mesh, counted from 1; only SimNIBS files number the faces first.

#include "Export.h"

namespace surgicalmesher
{

/// Writes version 4.1. Every set is a physical group with its name, its tag (see SetTags.h) and all its elements:
/// element sets of dimension 3; interfaces, outer boundary, named surfaces and shells of dimension 2; curves of
/// dimension 1; null-displacement nodes of dimension 0. Entities are the disjoint pieces of the sets.
void writeGmsh41(const FiniteElementModel& model, const std::string& file, const Destination& destination);

/// Writes version 2.2, in which an element has one physical group: for a volume element its tissue, for a face its
/// piece (see SetTags.h), for an edge its curve.
void writeGmsh22(const FiniteElementModel& model, const std::string& file, const Destination& destination);

/// Writes version 2.2 as SimNIBS 4 reads it: in RAS, with the label of a tetrahedron as its tag, and 1000 plus the
/// label for the faces of a tissue. A face between two tissues is listed once, oriented out of the one that SimNIBS
/// ranks first (white matter, gray matter, blood, cerebrospinal fluid, bone, spongy and compact bone, eyes, muscle,
/// skin, others). Shells and curves are left out. Throws InputError for labels of 100 and above, which denote
/// electrodes in SimNIBS, and UsageError for other elements than four-node tetrahedra.
void writeSimnibs(const FiniteElementModel& model, const std::string& file, const Destination& destination);

} // namespace surgicalmesher
