// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What a run of the surface stage did, as JSON, and the evolution of its mesh as CSV.

#include "HangingPieces.h"
#include "LocalThickness.h"
#include "RepeatedVoxels.h"
#include "ScaledPreparation.h"
#include "Structures.h"
#include "SurfaceFolds.h"
#include "TissueFidelity.h"
#include "TissueMesher.h"
#include "TissueSettings.h"

#include <map>
#include <string>
#include <vector>

namespace surgicalmesher
{

struct SurfaceReport
{
  VoxelRepeats repeats;      ///< in the label map as it was read; what is meshed is without them
  TissueTable tissues;       ///< of the map that was meshed
  TissueSettings settings;   ///< as followed: groups joined, shells with their lengths
  TissueSelection selection; ///< groups, and what was left out
  double featureScale = 0;
  ScaledPreparationReport preparation;
  std::map<Label, Betti> topology; ///< of the prepared map
  std::vector<Structure> structures;
  LocalThickness thickness; ///< against the edge length asked for
  bool followsThickness = false;
  std::size_t points = 0, triangles = 0;
  std::vector<EvolutionStep> evolution;
  double smoothing = 0;                     ///< voxels
  std::vector<MapChange> smoothed;          ///< between the prepared map and the one whose boundary was meshed
  Grid world;                               ///< the frame of the map that was meshed; places below are in its own
  double maximumDistance = 0;               ///< mm, as asked for; 0: nothing was
  std::map<Label, TissueFidelity> fidelity; ///< to the prepared map; empty: not assessed
  SurfaceFolds folds;                       ///< of the surface, assessed with its fidelity
  std::vector<HangingPiece> ears;           ///< of its tissues' ambient tetrahedra, free ones first
  std::vector<std::string> warnings;
};

/// Of the file, that so many voxels of the map that was meshed stand for.
std::size_t voxelsOfFile(std::size_t voxels, const SurfaceReport& report);

/// Numbers of voxels are those of the file.
std::string reportJson(const SurfaceReport& report);

/// One row per step: step, stage, tetrahedra, meanDistance, maximumDistance (mm), and the operations since the step
/// before by their names in the simplex mesh: T1 (collapses), T2 (splits), T7 (flips), moves.
std::string evolutionCsv(const std::vector<EvolutionStep>& evolution);

} // namespace surgicalmesher
