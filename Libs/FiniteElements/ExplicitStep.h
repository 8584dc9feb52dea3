// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Stable time steps of explicit solvers.

#include "FiniteElementModel.h"

namespace surgicalmesher
{

/// Returns the critical time step, s, of central differences for a linear tetrahedron (corners in mm, positively
/// oriented) of this material, linear elastic with a quarter of its mass lumped at each corner: 2 / omega, where omega
/// is its highest angular frequency. No frequency of a mesh is higher than the highest one of its elements (Irons,
/// Treharne, Shock and Vibration Bulletin 41, 1971). The step is about the least height over the speed of pressure
/// waves.
double criticalStep(const std::array<Vec3, 4>& corners, const TissueMaterial& material);

/// The time step that a tissue requires of an explicit solver.
struct ExplicitStep
{
  double leastHeight = 0;        ///< mm, over its tetrahedra
  double step = 0;               ///< s, smallest critical step of the tetrahedra that can move; 0: none can
  std::int32_t tetrahedron = -1; ///< the one with that step; -1: none
};

/// Returns the steps by tissue; tissues without a row in `materials` have the default material. Null-displacement
/// tetrahedra are left out of the step.
std::map<Label, ExplicitStep> explicitSteps(const MeshFile& content, const std::map<Label, TissueMaterial>& materials);

/// Returns the smallest step over all tissues that can move, s; 0 if none can.
double smallestStep(const std::map<Label, ExplicitStep>& steps);

} // namespace surgicalmesher
