// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The structures of a map: the connected components of each tissue.

#include "DigitalTopology.h"

#include <string>
#include <vector>

namespace surgicalmesher
{

/// A face-connected component of a tissue.
struct Structure
{
  Label label = 0;
  std::string name; ///< that of the tissue ("tissue 12" if it has none), numbered if the tissue has several
  std::size_t voxels = 0;
  Vec3 centre; ///< mean position of its voxels, world, mm
  Betti topology;
};

/// Returns all structures by tissue, then largest first (of equals, the one whose first voxel comes first).
std::vector<Structure> structuresOf(const TissueMap& map);

/// The name of a tissue in `table`, or "tissue 12"; "background" for label 0.
std::string nameOf(Label label, const TissueTable& table);

} // namespace surgicalmesher
