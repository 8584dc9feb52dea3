// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Estimate of the size of the mesh of a label map, before anything is meshed.

#include "ScaleField.h"
#include "TissueMap.h"

namespace surgicalmesher
{

struct MeshSizeEstimate
{
  double triangles = 0;  ///< of the surface complex: a face between two tissues counts once
  double tetrahedra = 0; ///< inside tissue
};

/// Returns the expected numbers of elements for this map at this scale; the aim is an accuracy within a factor of 1.5.
///
/// Elements have edge length L, or less where a tissue is thinner than L. The thickness of a tissue near a voxel is
/// estimated as 4 V / A, with its volume V and its boundary area A in the 12 mm around the voxel (a plate of thickness
/// h gives 2 h, a rod or ball of radius r gives 2 r or 4/3 r). Then, with A_s the area of smooth interface that a voxel
/// face represents,
///
///     triangles  = sum over interface faces of A_s / (sqrt(3)/4 (s L)^2)
///     tetrahedra = sum over tissue voxels of dV / (c L^3) + b * triangles
///
/// The last term counts the tetrahedra of thin sheets and small tissues, which have surface but hardly any volume. The
/// constants are at the top of MeshSizeEstimate.cxx; the accuracy reached is in Docs/Benchmarks.md#estimates.
MeshSizeEstimate estimateMeshSize(const TissueMap& map, const ScaleField& scale);

} // namespace surgicalmesher
