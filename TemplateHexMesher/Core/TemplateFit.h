// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A template's shape on a patient: landmarks by a thin-plate spline, then the whole surface, with every element valid.

#include "Landmarks.h"
#include "Progress.h"
#include "TargetSurface.h"

namespace surgicalmesher
{

struct FitOptions
{
  double alpha = 1;           ///< smoothness of the displacements from the spline in the last rounds; see EnergyWeights
  int iterations = 15;        ///< steps of each round
  double landmarkWeight = 50; ///< of squared distances to landmarks, mm^-2; the surface's weight is 1
  int repairRounds = 12;      ///< at most, after the fit, while an element is invalid or has less than
  double minimumScaledJacobian = 0.3; ///< at a corner; for that alone no longer than each round brings more
};

struct FitResult
{
  Points points;    ///< of the fitted mesh, a column per point of the template
  Points spline;    ///< the same by the spline of the landmarks alone
  Points landmarks; ///< where the template's landmarks have come to
  int repairRounds = 0;
  std::size_t turnedFacets = 0; ///< surface elements turned over against the spline, after all repair
};

/// Fits `mesh` to `target`, both in mm. The template's surface is taken from its volume elements; a mesh of surface
/// elements alone is fitted as it is.
///
/// After Kim et al., "An eFTD-VP framework ...", Biomech. Model. Mechanobiol. 17, 2018, section 3.1, with two changes:
/// the Laplacian of equation 1 acts on the displacements from the spline, so that it does not flatten the template, and
/// the quality of every element takes part in the fit (FitEnergy.h), so that it stays valid while its surface slides on
/// the target. Closest points agree in their normals; what lies nearest to an open border of the target is left alone.
///
/// Throws EngineError, with the worst element's place, if an element remains invalid.
FitResult fitTemplate(const ElementMesh& mesh, const LandmarkPairs& landmarks, TargetSurface target,
                      const FitOptions& options = {}, const Progress& progress = {});

} // namespace surgicalmesher
