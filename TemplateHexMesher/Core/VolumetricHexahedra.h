// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Layered hexahedral meshes between the outer and the inner surface of a slab of soft tissue.

#include "SlabParameterisation.h"

namespace surgicalmesher
{

struct HexOptions
{
  /// Number of elements from right to left, through the tissue, and from bottom to top.
  std::array<int, 3> divisions{ 78, 8, 78 };
  int layers = 3;        ///< number of tissue layers from outside to inside: skin, muscle, mucosa
  double outermost = 2;  ///< thickness (mm) of the outermost and the innermost layer of elements
  int repairRounds = 12; ///< largest number of repair rounds, while an element is invalid
};

/// Returns the depths of the borders between layers of elements as fractions of the tissue's `thickness` (mm), from 0
/// at the outer to 1 at the inner surface. Up to a thickness of layers * outermost, all layers are equally thick (as in
/// the paper). From 4/3 of that thickness on, the outermost and the innermost layer are `outermost` thick. In between,
/// their thickness is interpolated, so that neighbouring columns match.
std::vector<double> layerDepths(double thickness, const HexOptions& options);

/// A structured mesh without the columns that lie in holes.
struct LayeredMesh
{
  ElementMesh mesh;
  std::vector<std::array<std::int32_t, 3>> cells; ///< by element: its indices in the grid of divisions
  std::vector<std::array<std::int32_t, 3>> nodes; ///< by node: its indices in that grid
  std::array<int, 3> divisions{};
  std::vector<char> atHole; ///< by node: whether it lies at a hole
};

/// Maps a grid on the unit cube to the slab (Kim et al. 2018, section 3.2.2). Nodes on the front and back of the cube
/// are placed on the outer and the inner surface by their coordinates; nodes between them lie on the segment that joins
/// the two, at the depths of layerDepths() instead of evenly. Columns of elements of which more than half lies in a
/// hole are left out; the nodes around them are moved to the hole's border, and the elements there are improved like
/// those of a template (FitEnergy.h). A hole narrower than an element is closed. Throws EngineError with the position
/// of the worst element if an element remains invalid.
LayeredMesh layeredHexahedra(const SlabParameterisation& slab, const HexOptions& options,
                             const Progress& progress = {});

} // namespace surgicalmesher
