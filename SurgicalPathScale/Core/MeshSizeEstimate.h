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
/// constants are at the top of MeshSizeEstimate.cxx. Estimate over real number, measured on maps whose islands under 30
/// mm^3 were removed only before meshing (a noisy map has less to mesh then, and is overestimated):
///
///                                                          triangles   tetrahedra
///     jhu189, 189 brain tissues, L 1 to 8 mm                    1.00         1.02
///     the same, L 2 to 10 mm                                    0.90         0.91
///     inia19, 724 tissues, 1 to 8 mm                            1.08         0.92
///     SPL atlas, 312 tissues, many of them thin, 1 to 8 mm      0.55         0.47
///     heads of 53 tissues, noisy, 1 to 8 mm             1.11 .. 1.36 0.75 .. 0.77
///     21 organs of a CT, 0.98 x 0.98 x 2.5 mm, 1 to 8 mm        1.21         1.04
///     boxes of 40 mm of jhu189, L 2, 6, 1 to 8 mm       1.07 .. 1.21 1.10 .. 1.14
MeshSizeEstimate estimateMeshSize(const TissueMap& map, const ScaleField& scale);

} // namespace surgicalmesher
