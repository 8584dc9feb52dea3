// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Hexahedra in layers between the outer and the inner surface of a slab of soft tissue.

#include "SlabParameterisation.h"

namespace surgicalmesher
{

struct HexOptions
{
  std::array<int, 3> divisions{ 78, 8, 78 }; ///< from right to left, through the tissue, from bottom to top
  int layers = 3;                            ///< kinds of tissue from outside to inside: skin, muscle, mucosa
  double outermost = 2;                      ///< mm, of the outermost and the innermost layer of elements
  int repairRounds = 12;                     ///< at most, while an element is invalid
};

/// Depths of the layers' borders as fractions of the tissue's thickness (mm), from 0 at the outer to 1 at the inner
/// surface. Up to layers * outermost mm all are alike (as in the paper); from four thirds of that on, the outermost and
/// the innermost one are `outermost` mm thick; between, the thickness goes from the one to the other, so that
/// neighbouring columns match.
std::vector<double> layerDepths(double thickness, const HexOptions& options);

/// A structured mesh with its columns in the holes left out.
struct LayeredMesh
{
  ElementMesh mesh;
  std::vector<std::array<std::int32_t, 3>> cells; ///< place of each element among the divisions
  std::vector<std::array<std::int32_t, 3>> nodes; ///< and of each node
  std::array<int, 3> divisions{};
  std::vector<char> atHole; ///< per node
};

/// Maps the divided unit cube to the slab: nodes on its front to the outer surface, on its back to the inner surface,
/// by their coordinates, those between evenly on the segment that joins them (Kim et al. 2018, section 3.2.2), but for
/// layerDepths(). Columns of elements that lie in a hole by more than half are left out; the nodes around them go to
/// the hole's border, and elements there are improved as those of a template are (FitEnergy.h). A hole narrower than
/// an element is closed. Throws EngineError, with the place, if an element remains invalid.
LayeredMesh layeredHexahedra(const SlabParameterisation& slab, const HexOptions& options,
                             const Progress& progress = {});

} // namespace surgicalmesher
