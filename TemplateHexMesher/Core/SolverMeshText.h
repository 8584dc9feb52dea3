// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Meshes in the text files of solvers: Abaqus input decks and Ansys node and element lists.

#include "ElementMesh.h"

#include <map>
#include <string>
#include <vector>

namespace surgicalmesher
{

/// Ids are the file's own; `mesh` counts from 0 in the file's order.
struct SolverMesh
{
  ElementMesh mesh;
  std::vector<std::int64_t> nodeIds, elementIds;
  std::map<std::string, std::vector<std::int32_t>> nodeSets, elementSets; ///< indices into `mesh`, ascending
};

/// Throws InputError for an element type other than C3D4, C3D6, C3D8, S3 and S4 with their variants (C3D8R, ...), an id
/// that stands twice, or a node that is not there. Keywords that don't describe the mesh are passed over.
SolverMesh readAbaqusMesh(const std::string& file);

/// `nodeFile` has an id and three coordinates on a line, in columns of 8, 20, 20 and 20 characters, of which zeros at
/// the end may be missing, or parted by blanks; `elementFile` has eight node ids first and the element's id last of at
/// least nine, in columns of 6 characters or parted by blanks.
SolverMesh readAnsysMesh(const std::string& nodeFile, const std::string& elementFile);

/// The text of an Abaqus deck or an Ansys node list with other coordinates, a column per node in the file's order.
std::string abaqusWithPoints(const std::string& file, const Points& points);
std::string ansysNodesWithPoints(const SolverMesh& mesh);

} // namespace surgicalmesher
