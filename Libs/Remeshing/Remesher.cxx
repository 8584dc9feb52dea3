// SPDX-License-Identifier: Apache-2.0
#include "Remesher.h"

#include <mutex>

namespace surgicalmesher
{

namespace
{

struct RunPass
{
  GuardedOperations& operations;

  void operator()(const Coarsen& pass) const { coarsenBlock(operations, pass.size, pass.options); }
  void operator()(const Relax& pass) const { relaxBlock(operations, pass.options); }
  void operator()(const Polish& pass) const { polishBlock(operations, pass.options); }
  void operator()(const Improve& pass) const { improveBlock(operations, pass.options); }
  void operator()(const SwapEdges& pass) const { swapEdgesOfBlock(operations, pass.options); }
  void operator()(const RaiseHeights& pass) const { raiseHeightsOfBlock(operations, pass.options); }
  void operator()(const SoftenPairs& pass) const { softenPairsOfBlock(operations, pass.options); }
  void operator()(const EvenOut& pass) const { evenLengthsOfBlock(operations, pass.options); }
  void operator()(const OpenFolds& pass) const { openFoldsOfBlock(operations, pass.options); }
  void operator()(const ReturnVertices& pass) const { returnVerticesOfBlock(operations, pass.options); }
  void operator()(const MoveInterface& pass) const { moveInterfaceOfBlock(operations, pass.options); }
  void operator()(const MeetProximity& pass) const { meetProximityOfBlock(operations, pass.options); }
  void operator()(const OffsetTissues& pass) const { offsetTissuesOfBlock(operations, pass.options); }
  void operator()(const RestoreVolumes& pass) const { restoreVolumesOfBlock(operations, pass.options); }
  void operator()(const RelabelInterface& pass) const { relabelBlock(operations, pass.keptAngle, pass.mostLeft); }
  void operator()(const RemoveSpikes& pass) const { cutSpikesOfBlock(operations, pass.options); }
  void operator()(const RemoveEars& pass) const { removeEarsOfBlock(operations, pass.few); }
};

EnvelopeBounds boundsOf(const Stage& stage, const RemesherOptions& options)
{
  EnvelopeBounds bounds = stage.bounds;
  bounds.featureAngle = options.featureAngle;
  bounds.sampleSpacing = options.sampleSpacing;
  if (options.tolerancesAreHard) bounds.toleranceFactor = 1;
  else bounds.separatedFactor = options.separatedFactor;
  return bounds;
}

} // namespace

OperationCounts runSweep(TetComplex& block, const SizingFunction& length, const Sweep& sweep,
                         const RemesherOptions& options, const Progress& progress, CurveChains* curves)
{
  OperationCounts counts;
  for (std::size_t n = 0; n < sweep.stages.size(); ++n)
  {
    report(progress, double(n) / double(sweep.stages.size()), sweep.name);
    const Stage& stage = sweep.stages[n];
    GuardedOperations operations(block, length, boundsOf(stage, options), sweep.stiff ? options.rigidity : 0, curves);
    for (const Pass& pass : stage.passes) std::visit(RunPass{ operations }, pass);
    counts += operations.counts();
  }
  return counts;
}

Remesher::Remesher(BackgroundMesh mesh, SizingFunction length, const RemesherOptions& options, const Progress& progress,
                   std::size_t sweeps)
  : m_Background(std::move(mesh)), m_Length(std::move(length)), m_Options(options), m_Progress(progress),
    m_Sweeps(sweeps)
{
}

void Remesher::run(const Sweep& sweep)
{
  m_Counts = {};
  std::mutex mutex;
  const Progress progress = [&](double fraction, const std::string&)
  { report(m_Progress, (double(m_Round) + fraction) / double(m_Sweeps), sweep.name); };
  const auto work = [&](TetComplex& block)
  {
    const Progress ofStages = sweep.whole ? progress : Progress(); // otherwise progress is reported per block
    const OperationCounts counts = runSweep(block, m_Length, sweep, m_Options, ofStages);
    const std::lock_guard<std::mutex> lock(mutex);
    m_Counts += counts;
  };
  sweepBlocks(m_Background, int(m_Round), sweep.whole ? wholeMesh : defaultBlockSize(m_Background.mesh), work,
              progress);
  ++m_Round;
}

} // namespace surgicalmesher
