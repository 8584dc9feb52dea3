// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Runs sweeps over the background tetrahedra, block by block, on all processors.

#include "BlockSweep.h"
#include "Sweep.h"

namespace surgicalmesher
{

struct RemesherOptions
{
  /// The tolerances of the samples are hard bounds: factors on them in the sweeps count as 1.
  bool tolerancesAreHard = false;
  /// EnvelopeBounds::separatedFactor of all stages; 1 if tolerances are hard.
  double separatedFactor = 1;
  double featureAngle = 0;  ///< EnvelopeBounds::featureAngle of all stages
  double sampleSpacing = 0; ///< EnvelopeBounds::sampleSpacing of all stages, mm
  double rigidity = 0;      ///< of the interface against bending, see quadricOf
};

/// Runs the stages of a sweep on one block. `progress` gets the share of them done; `curves`: see GuardedOperations.
OperationCounts runSweep(TetComplex& block, const SizingFunction& length, const Sweep& sweep,
                         const RemesherOptions& options, const Progress& progress = {}, CurveChains* curves = nullptr);

class Remesher
{
public:
  /// Takes the mesh (positively wound, face-to-face, a whole box or body: vertices on its hull stay). `length` is in
  /// the frame of its points. `progress` gets the share done of `sweeps` sweeps.
  Remesher(BackgroundMesh mesh, SizingFunction length, const RemesherOptions& options = {},
           const Progress& progress = {}, std::size_t sweeps = 1);

  /// Labels keep their topology, and no operation lowers the worst quality of what it touches below what its pass
  /// allows. The result depends on neither the number of threads nor their timing. If the progress throws, so does
  /// this, and the mesh is as it was before the sweep.
  void run(const Sweep& sweep);

  const BackgroundMesh& background() const { return m_Background; }
  BackgroundMesh& background() { return m_Background; } ///< to move samples; tetrahedra and neighbours stay as they are

  /// Of the last sweep.
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
