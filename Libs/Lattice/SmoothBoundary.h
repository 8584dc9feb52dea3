// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The smooth boundary of all tissues at once, below the size of a voxel: where the samples of the boundary belong.
///
/// A sample is the centre of a voxel face between labels a and b. It moves to where the labels' smoothed indicators
/// are equal, G * 1_a = G * 1_b with one Gaussian G for all labels, as the largest of them would part the space; then
/// to the quadric that moving least squares fits to the samples of the same two labels around it (D. Levin,
/// "Mesh-independent surface interpolation", 2003), which keeps curvature and takes away the terraces that a Gaussian
/// of this width leaves; the fit is up to five times as wide where the boundary is one quadric that far, and then one
/// for the points of a cell. Where L is more than eight voxels, G is up to 2.5, the fit up to four times as wide, no
/// more than half as many times as thin tissues have voxels across. Where a tissue is so thin that its indicator
/// loses, narrower Gaussians take the place of the first. No sample's plane comes within 0.14 voxel of the centres of
/// the two voxels beside its face, but where L is that long. After that the boundary of every tissue is offset by one
/// length, 0.3 voxel at most, so that the tissue keeps its volume (u_0 in "Unstructured mesh generation from the
/// Virtual Family models", section 3.1, for all tissues together).

#include "KuhnLattice.h"

#include <map>

namespace surgicalmesher
{

struct SmoothBoundaryOptions
{
  double voxels = 0.7;                    ///< standard deviation of G along each axis, positive
  bool isWiderWithL = true;               ///< where L is more than eight voxels
  std::map<Label, double> thickness = {}; ///< mean, mm, of tissues that wider smoothing is not to flatten
  double minimumAngle = 10;               ///< degrees, dihedral: that the interface of the lattice leaves
};

/// Moves the samples of a fresh lattice, of `map` or of blocks that stand for it, to the smooth boundary of `map`, and
/// gives them its normals; its interface follows them as far as the angles allow.
void moveToSmoothBoundary(KuhnLattice& lattice, const TissueMap& map, const SmoothBoundaryOptions& options);

/// A point of the smooth boundary, mm in the grid frame of the map.
struct SmoothBoundaryPoint
{
  std::array<int, 3> voxel;    ///< beside it, of the larger label
  std::array<Label, 2> labels; ///< the larger one first
  Vec3 position;
  Vec3 normal; ///< unit, out of the larger label
};

/// One for each face between voxels of two labels, in the order of their rows along the first axis.
std::vector<SmoothBoundaryPoint> smoothBoundaryPoints(const TissueMap& map, double voxels);

} // namespace surgicalmesher
