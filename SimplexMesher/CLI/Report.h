// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Report of a run of the surface stage as JSON, and the evolution of its mesh as CSV.

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
  VoxelRepeats repeats;      ///< of the label map as read; they are removed before meshing
  TissueTable tissues;       ///< of the meshed map
  TissueSettings settings;   ///< as applied: groups joined, shells with their lengths
  TissueSelection selection; ///< groups, and tissues left out
  double featureScale = 0;
  ScaledPreparationReport preparation;
  std::map<Label, Betti> topology; ///< of the prepared map
  std::vector<Structure> structures;
  LocalThickness thickness; ///< relative to the requested edge length
  bool followsThickness = false;
  std::size_t points = 0, triangles = 0;
  std::vector<EvolutionStep> evolution;
  double smoothing = 0;                     ///< voxels
  std::vector<MapChange> smoothed;          ///< changes between the prepared map and the one whose boundary was meshed
  Grid world;                               ///< frame of the meshed map; the places below are in the map's own frame
  double maximumDistance = 0;               ///< mm, as requested; 0: none
  std::map<Label, TissueFidelity> fidelity; ///< relative to the prepared map; empty: not assessed
  SurfaceFolds folds;                       ///< of the surface, assessed for reports only
  std::vector<HangingPiece> ears;           ///< hanging pieces of tissues in the ambient tetrahedra, free ones first
  std::vector<std::string> warnings;
};

/// Returns the number of voxels of the input file that `voxels` of the meshed map represent.
std::size_t voxelsOfFile(std::size_t voxels, const SurfaceReport& report);

/// Returns the report; numbers of voxels refer to the input file.
std::string reportJson(const SurfaceReport& report);

/// Returns CSV text with one row per step: step, stage, tetrahedra, faces, meanDistance, maximumDistance (mm), and the
/// operations since the previous step: on the interface by their names in the simplex mesh, T1 (collapses), T2 (splits)
/// and T7 (flips), then relabels and moves, and collapses, splits and flips of any edge.
std::string evolutionCsv(const std::vector<EvolutionStep>& evolution);

} // namespace surgicalmesher
