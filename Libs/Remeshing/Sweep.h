// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A sweep: the passes that a remesher runs on every block of a mesh, grouped into stages that share an envelope.

#include "Coarsening.h"
#include "EdgeSwaps.h"
#include "EvenLengths.h"
#include "FoldOpening.h"
#include "HeightRaising.h"
#include "Improvement.h"
#include "InterfaceMotion.h"
#include "InterfaceRelabelling.h"
#include "Polishing.h"
#include "ProximitySplits.h"
#include "Relaxation.h"
#include "SpikeRemoval.h"
#include "StiffPairs.h"
#include "TissueOffsets.h"
#include "VertexReturn.h"
#include "VolumeRestoring.h"

#include <string>
#include <variant>
#include <vector>

namespace surgicalmesher
{

struct Coarsen ///< coarsenBlock
{
  double size; ///< mm, see there
  CoarseningOptions options;
};
struct Relax ///< relaxBlock
{
  RelaxationOptions options;
};
struct Polish ///< polishBlock
{
  PolishingOptions options;
};
struct Improve ///< improveBlock
{
  ImprovementOptions options;
};
struct SwapEdges ///< swapEdgesOfBlock
{
  SwapOptions options;
};
struct RaiseHeights ///< raiseHeightsOfBlock
{
  HeightOptions options;
};
struct SoftenPairs ///< softenPairsOfBlock
{
  StiffPairOptions options;
};
struct EvenOut ///< evenLengthsOfBlock
{
  EdgeLengthOptions options;
};
struct OpenFolds ///< openFoldsOfBlock
{
  FoldOptions options;
};
struct ReturnVertices ///< returnVerticesOfBlock
{
  VertexReturnOptions options;
};
struct MoveInterface ///< moveInterfaceOfBlock
{
  InterfaceMotionOptions options;
};
struct MeetProximity ///< meetProximityOfBlock
{
  ProximityOptions options;
};
struct OffsetTissues ///< offsetTissuesOfBlock
{
  TissueOffsetOptions options;
};
struct RestoreVolumes ///< restoreVolumesOfBlock
{
  VolumeRestoringOptions options;
};
struct RelabelInterface ///< relabelBlock
{
  double keptAngle; ///< degrees
  double mostLeft;  ///< see relabelBlock
};
struct RemoveSpikes ///< cutSpikesOfBlock
{
  SpikeOptions options;
};
struct RemoveEars ///< removeEarsOfBlock
{
  std::size_t few; ///< tetrahedra
};

using Pass = std::variant<Coarsen, Relax, Polish, Improve, SwapEdges, RaiseHeights, SoftenPairs, EvenOut, OpenFolds,
                          ReturnVertices, MoveInterface, MeetProximity, OffsetTissues, RestoreVolumes, RelabelInterface,
                          RemoveSpikes, RemoveEars>;

struct Stage
{
  EnvelopeBounds bounds;
  std::vector<Pass> passes; ///< in this order
};

struct Sweep
{
  std::string name; ///< for progress and reports
  std::vector<Stage> stages;
  /// Whether the whole mesh is one block: borders between blocks are locked, and after sweeps by blocks the tetrahedra
  /// that are still bad lie at them.
  bool whole = false;
  /// Whether the interface resists bending (RemesherOptions::rigidity).
  bool stiff = true;
};

} // namespace surgicalmesher
