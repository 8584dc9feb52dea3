// SPDX-License-Identifier: Apache-2.0
#pragma once
/// How large the mesh of a map will be, before anything is meshed.

#include "ScaleField.h"
#include "TissueMap.h"

namespace surgicalmesher
{

struct MeshSizeEstimate
{
  double triangles = 0;  ///< of the surface complex: a face between two tissues counts once
  double tetrahedra = 0; ///< inside tissue
};

/// Expected numbers for this map at this scale; the aim is a factor of 1.5.
///
/// Elements have edge L, or less where a tissue is thinner than that: a tissue's thickness near a voxel is taken as 4 V
/// / A, with V its volume and A its boundary area in the 12 mm around (a plate of thickness h gives 2 h, a rod or ball
/// of radius r gives 2 r or 4/3 r). Then, with A_s the area of smooth interface that a voxel face stands for,
///
///     triangles  = sum over interface faces of A_s / (sqrt(3)/4 (s L)^2)
///     tetrahedra = sum over tissue voxels of dV / (c L^3) + b * triangles
///
/// The last term counts the tetrahedra of thin sheets and small tissues, which have surface but hardly volume. The
/// constants are at the top of MeshSizeEstimate.cxx; what the estimate reaches is in Docs/Benchmarks.md#estimates.
MeshSizeEstimate estimateMeshSize(const TissueMap& map, const ScaleField& scale);

} // namespace surgicalmesher
