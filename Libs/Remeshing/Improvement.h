#pragma once
/// Quality improvement of a labelled complex by guarded operations: nothing here ever makes the worst dihedral angle of what
/// it touches worse, changes a label's topology, or leaves the samples.

#include "GuardedOperations.h"

namespace surgicalmesher
{

struct RelaxationOptions
{
  double goodAngle = 25; ///< degrees; a move that lowers the worst angle at its vertex is taken only above this
  double spread = 0.8;   ///< weight of the target lengths against the mere middle of the neighbours
  double fit = 1;        ///< weight of the samples against an even spacing of the vertices
  double robust = 0;     ///< mm, see fitOf
};

/// Moves every free vertex once: inside a tissue towards the middle of its neighbours; on a sheet or curve of the interface
/// towards the middle of its neighbours there and, along the normals, to the least-squares fit of its faces to their samples.
void relaxBlock(GuardedOperations& operations, const RelaxationOptions& options = {});

struct PolishOptions
{
  double goodAngle = 29.5; ///< degrees; as in RelaxationOptions
  double fit = 1;          ///< weight of the samples against staying
  double robust = 0;       ///< mm, see fitOf
  double ease = 0.02;      ///< how easily a vertex leaves its samples for better angles: 0 not at all, 1 freely
};

/// Moves every free vertex once to the least-squares fit of its faces to their samples, and once up the sum of the sines of
/// the worst angles at it, on the interface along sheets and curves rather than across.
void polishBlock(GuardedOperations& operations, const PolishOptions& options = {});

struct ImprovementOptions
{
  double targetAngle =
    34; ///< degrees; tetrahedra with a dihedral angle below this, or above 180 minus it, are worked on
  double shortEdge = 0.6; ///< collapses that improve are tried on edges up to this share of the target
  double longEdge = 1.6;
  bool split = true;
  double splitEdge = 1.0; ///< splits are tried on edges from this share of the target on
  double ease = 0.02;     ///< as in PolishOptions
  int trials = 12;        ///< positions tried for each vertex
  int together = 0;       ///< rounds in which the vertices around what resists all else move together
  double worstShare = 1;  ///< of the tetrahedra, the worst, that are worked on in one pass; a hundred at least
  double togetherShare =
    0.001;        ///< of the tetrahedra, the worst, for which that is tried in one pass; of a hundred at least
  int passes = 3; ///< later passes work only where something has changed
};

/// Worst first: edge removal, vertex optimisation, collapse, split, and moves of several vertices together, as they are or
/// with a new one among them, of the tetrahedra below the target, until nothing helps.
void improveBlock(GuardedOperations& operations, const ImprovementOptions& options = {});

} // namespace surgicalmesher
