// SPDX-License-Identifier: Apache-2.0
#pragma once
/// How a mesh evolves from sweep to sweep.

#include "BackgroundMesh.h"
#include "GuardedOperations.h"

#include <string>
#include <vector>

namespace surgicalmesher
{

/// The mesh after one step.
struct EvolutionStep
{
  std::string stage;
  std::size_t tetrahedra = 0; ///< of tissues
  std::size_t faces = 0;      ///< between labels
  double meanDistance = 0;    ///< mm, of the map's smoothed boundary to the surface
  double maximumDistance = 0; ///< mm
  std::size_t beyond = 0;     ///< samples farther than their tolerance
  OperationCounts operations; ///< since the step before
};

/// What `background` is like now, after `operations` of a stage called `stage`; with no faces if it does not know its
/// neighbours.
EvolutionStep evolutionStep(const BackgroundMesh& background, const std::string& stage,
                            const OperationCounts& operations);

} // namespace surgicalmesher
