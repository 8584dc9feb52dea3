// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Record of how the mesh changes from sweep to sweep.

#include "BackgroundMesh.h"
#include "GuardedOperations.h"

#include <string>
#include <vector>

namespace surgicalmesher
{

/// Figures of the mesh after one step.
struct EvolutionStep
{
  std::string stage;
  std::size_t tetrahedra = 0; ///< of tissues
  std::size_t faces = 0;      ///< between labels
  double meanDistance = 0;    ///< mm, from the map's smoothed boundary to the surface
  double maximumDistance = 0; ///< mm
  std::size_t beyond = 0;     ///< samples farther from the surface than their tolerance
  OperationCounts operations; ///< since the previous step
};

/// Returns the figures of `background` after `operations` of the stage `stage`; `faces` is 0 if the mesh has no
/// adjacency yet.
EvolutionStep evolutionStep(const BackgroundMesh& background, const std::string& stage,
                            const OperationCounts& operations);

} // namespace surgicalmesher
