// SPDX-License-Identifier: Apache-2.0
#pragma once
/// How long the time steps of an explicit solver can be.

#include "FiniteElementModel.h"

namespace surgicalmesher
{

/// The longest step, s, at which central differences stay stable on a linear tetrahedron (corners in mm, positively
/// wound) of this material, elastic and with a quarter of its mass at each corner: 2 / omega, omega its highest
/// frequency. A mesh has no higher one than its elements (Irons, Treharne, Shock and Vibration Bulletin 41, 1971). About
/// the least height over the speed of pressure waves.
double criticalStep(const std::array<Vec3, 4>& corners, const TissueMaterial& material);

/// What a tissue asks of an explicit solver.
struct ExplicitStep
{
  double leastHeight = 0;        ///< mm, of its tetrahedra
  double step = 0;               ///< s, the smallest critical one of the tetrahedra that can move; 0: none of them can
  std::int32_t tetrahedron = -1; ///< the one that sets it
};

/// By tissue, those without a row in `materials` with the default material. Tetrahedra of null displacement have no
/// step.
std::map<Label, ExplicitStep> explicitSteps(const MeshFile& content, const std::map<Label, TissueMaterial>& materials);

/// The smallest of all tissues' that can move, s; 0 if none can.
double smallestStep(const std::map<Label, ExplicitStep>& steps);

} // namespace surgicalmesher
