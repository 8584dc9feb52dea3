// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Fit of a template to a patient: landmarks by a thin-plate spline, then the whole surface, with every element valid.

#include "Landmarks.h"
#include "Progress.h"
#include "TargetSurface.h"

namespace surgicalmesher
{

struct FitOptions
{
  double alpha = 1;           ///< smoothness of the displacements from the spline in the last rounds; see EnergyWeights
  int iterations = 15;        ///< descent steps per round
  double landmarkWeight = 50; ///< of squared distances to landmarks, mm^-2; the surface's weight is 1
  /// Largest number of repair rounds after the fit. Repair goes on while an element is invalid or a surface element is
  /// turned over, or while the least scaled Jacobian is below `minimumScaledJacobian` and increases.
  int repairRounds = 12;
  double minimumScaledJacobian = 0.3;
};

struct FitResult
{
  Points points;    ///< fitted nodes, a column per point of the template
  Points spline;    ///< nodes after the spline of the landmarks alone
  Points landmarks; ///< the template's landmarks after the fit
  int repairRounds = 0;
  std::size_t turnedFacets = 0; ///< surface elements turned over against the spline, after all repair
};

/// Fits `mesh` to `target`, both in mm. If the mesh has volume elements, its outer surface is fitted; a mesh of surface
/// elements only is fitted as a whole.
///
/// After Kim et al., "An eFTD-VP framework ...", Biomech. Model. Mechanobiol. 17, 2018, section 3.1, with two changes:
/// the Laplacian of equation 1 acts on the displacements from the spline, so that it does not flatten the template; and
/// the quality of every element is part of the energy (FitEnergy.h), so that elements stay valid while the surface
/// slides on the target. Closest points must have similar normals. Nodes whose closest point is on an open border of
/// the target are not drawn to it.
///
/// Throws EngineError with the position of the worst element if an element remains invalid.
FitResult fitTemplate(const ElementMesh& mesh, const LandmarkPairs& landmarks, TargetSurface target,
                      const FitOptions& options = {}, const Progress& progress = {});

} // namespace surgicalmesher
