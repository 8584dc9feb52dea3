// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Runs sweeps over the background tetrahedra, block by block, on all processors.

#include "BlockSweep.h"
#include "Sweep.h"

namespace surgicalmesher
{

struct RemesherOptions
{
  /// Whether the tolerances of the samples are hard bounds: EnvelopeBounds::toleranceFactor then counts as 1 in all
  /// stages.
  bool tolerancesAreHard = false;
  /// EnvelopeBounds::separatedFactor of all stages; 1 if tolerances are hard.
  double separatedFactor = 1;
  double featureAngle = 0;  ///< EnvelopeBounds::featureAngle of all stages
  double sampleSpacing = 0; ///< EnvelopeBounds::sampleSpacing of all stages, mm
  double rigidity = 0;      ///< resistance of the interface to bending, see quadricOf
};

/// Runs the stages of a sweep on one block and returns the number of operations. `progress` is called with the share of
/// stages done; `curves`: see GuardedOperations.
OperationCounts runSweep(TetComplex& block, const SizingFunction& length, const Sweep& sweep,
                         const RemesherOptions& options, const Progress& progress = {}, CurveChains* curves = nullptr);

class Remesher
{
public:
  /// `mesh` must be positively wound and face-to-face, and fill a whole box or body; vertices on its hull do not move.
  /// `length` takes positions in the frame of the mesh's points. `progress` is called with the share done of `sweeps`
  /// sweeps in total.
  Remesher(BackgroundMesh mesh, SizingFunction length, const RemesherOptions& options = {},
           const Progress& progress = {}, std::size_t sweeps = 1);

  /// Runs a sweep on all blocks. Labels keep their topology, and no operation lowers the worst quality of the
  /// tetrahedra that it changes below the floor of its pass. The result depends on neither the number of threads nor
  /// their timing. Rethrows what `progress` throws; the mesh is then as it was before the sweep.
  void run(const Sweep& sweep);

  const BackgroundMesh& background() const { return m_Background; }
  /// For moving samples only; tetrahedra and neighbours must not be changed.
  BackgroundMesh& background() { return m_Background; }

  /// Number of operations in the last sweep.
  const OperationCounts& counts() const { return m_Counts; }

private:
  BackgroundMesh m_Background;
  const SizingFunction m_Length;
  const RemesherOptions m_Options;
  const Progress m_Progress;
  const std::size_t m_Sweeps;
  std::size_t m_Round = 0;
  OperationCounts m_Counts;
};

} // namespace surgicalmesher
