// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The smooth boundary of all tissues at once, with sub-voxel accuracy: the positions of the boundary samples.
///
/// A sample starts at the centre of a voxel face between labels a and b and moves in three steps:
///   1. To where the labels' smoothed indicators are equal, G * 1_a = G * 1_b, with the same Gaussian G for all labels,
///      as if each point had the label of the largest smoothed indicator. Where a tissue is so thin that its indicator
///      is nowhere the largest, narrower Gaussians are used.
///   2. Onto the quadric that moving least squares fits to the samples of the same two labels around it (D. Levin,
///      "Mesh-independent surface interpolation", 2003). This keeps curvature and removes the terraces that a Gaussian
///      of this width leaves. Where one quadric fits a wider part of the boundary, the fit is up to five times as wide
///      and shared by the samples of a small cell. No sample's plane comes closer than 0.14 voxel to the centres of the
///      two voxels beside the sample's face, unless L is longer than eight voxels.
///   3. Along its normal: the boundary of every tissue is offset by one distance per tissue, 0.3 voxel at most, which
///      preserves the tissue's volume (u_0 in "Unstructured mesh generation from the Virtual Family models", section
///      3.1, for all tissues together).
///
/// Where L is longer than eight voxels, G is up to 2.5 times and the fit up to four times as wide, but neither by a
/// factor above half the number of voxels across the thinner tissue.

#include "KuhnLattice.h"

#include <map>

namespace surgicalmesher
{

struct SmoothBoundaryOptions
{
  double voxels = 0.7;                    ///< standard deviation of G along each axis, in voxels; positive
  bool isWiderWithL = true;               ///< whether smoothing is wider where L is longer than eight voxels
  std::map<Label, double> thickness = {}; ///< mean thickness of tissues that wider smoothing must not flatten, mm
  double minimumAngle = 10;               ///< degrees; dihedral angle that moves of lattice vertices must leave
};

/// Moves the samples of a new lattice to the smooth boundary of `map` and sets their normals (BackgroundMesh::Sample);
/// the lattice's interface vertices follow as far as dihedral angles allow. The lattice is that of `map` or of its
/// uniform blocks (SampleTransfer.h).
void moveToSmoothBoundary(KuhnLattice& lattice, const TissueMap& map, const SmoothBoundaryOptions& options);

/// A point of the smooth boundary, mm in the grid frame of the map.
struct SmoothBoundaryPoint
{
  std::array<int, 3> voxel;    ///< the voxel of the larger label beside the point's voxel face
  std::array<Label, 2> labels; ///< the larger one first
  Vec3 position;
  Vec3 normal; ///< unit, out of the larger label
};

/// Returns one point for each face between voxels of two labels, ordered by voxels with the first axis fastest.
/// `voxels`: standard deviation of G.
std::vector<SmoothBoundaryPoint> smoothBoundaryPoints(const TissueMap& map, double voxels);

} // namespace surgicalmesher
