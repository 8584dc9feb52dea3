// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Meshes in the text files of solvers: Abaqus input decks and Ansys node and element lists.

#include "ElementMesh.h"

#include <map>
#include <string>
#include <vector>

namespace surgicalmesher
{

/// A mesh and its ids and sets in the file. Ids are those of the file; `mesh` counts from 0 in the file's order.
struct SolverMesh
{
  ElementMesh mesh;
  std::vector<std::int64_t> nodeIds, elementIds;
  std::map<std::string, std::vector<std::int32_t>> nodeSets, elementSets; ///< indices into `mesh`, ascending
};

/// Reads an Abaqus input deck. Throws InputError for an element type other than C3D4, C3D6, C3D8, S3 and S4 and their
/// variants (C3D8R, ...), a repeated id, a missing node, or nodes in a system of coordinates other than the global
/// rectangular one. A generated set has those of its ids that exist. Keywords that do not describe the mesh are
/// ignored.
SolverMesh readAbaqusMesh(const std::string& file);

/// Reads Ansys node and element lists. A line of `nodeFile` has an id and three coordinates, either in columns of 8,
/// 20, 20 and 20 characters, where trailing zeros may be omitted, or separated by blanks; what follows, such as
/// rotation angles, is ignored. A line of `elementFile` has
/// at least nine ids, eight nodes first and the element's id last, in columns of 6 characters or separated by blanks.
SolverMesh readAnsysMesh(const std::string& nodeFile, const std::string& elementFile);

/// Return the text of an Abaqus deck or an Ansys node list with other coordinates; a column per node in the file's
/// order.
std::string abaqusWithPoints(const std::string& file, const Points& points);
std::string ansysNodesWithPoints(const std::string& nodeFile, const Points& points);

} // namespace surgicalmesher
