// SPDX-License-Identifier: Apache-2.0
#include "TissueMesher.h"

#include "BoundaryCurvature.h"
#include "InterfaceSmoothing.h"
#include "KuhnLattice.h"
#include "LabelSmoothing.h"
#include "Remesher.h"
#include "SampleTolerances.h"
#include "SampleTransfer.h"
#include "Schedule.h"
#include "SmoothBoundary.h"
#include "TissueScale.h"
#include "UniformBlocks.h"
#include "VolumeBalance.h"

#include <algorithm>
#include <limits>
#include <vector>

namespace surgicalmesher
{

namespace
{

bool isBounded(const TissueMesherOptions& options) { return options.maximumDistance > 0; }

/// Returns the height, mm, up to which spikes may be cut.
double mostOfSpikes(const TissueMesherOptions& options)
{
  if (isBounded(options)) return options.maximumDistance;
  return options.proximity.isAsked() ? options.proximity.near : std::numeric_limits<double>::infinity();
}

/// Returns the map whose boundary is meshed.
SmoothedLabels withoutRoughness(const TissueMap& map, const ScaleField& scale, const TissueMesherOptions& options)
{
  constexpr double wider = 1.7; // a crack of one voxel survives the Gaussian that smooths walls
  if (!leavesVoxels(options)) return { map, {} };
  return smoothLabels(map, scale,
                      { .sigma = wider * options.smoothing, .protectedLabels = options.features.protectedLabels });
}

MeshSizes sizesOf(const TissueMap& map, const ScaleField& scale, const TissueMesherOptions& options)
{
  return { map.grid.smallestSpacing(), *std::max_element(scale.lengths.begin(), scale.lengths.end()),
           mostOfSpikes(options) };
}

/// Returns the number of samples of `map` for a triangle of edge length L. Fewer samples cost accuracy, except where
/// voxels are fine and the tissues beside the face are not much thinner than L on average.
SampleTransferOptions samplingOf(const TissueMap& map, const std::map<Label, double>& thickness, bool isFine)
{
  constexpr double usual = 16, few = 10, thin = 0.5; // `thin` relative to L
  if (!isFine) return { [=](const VoxelFace&, double) { return usual; } };
  // An array, since every face looks up two labels.
  std::vector<double> thicknessOf(labelCount, std::numeric_limits<double>::infinity());
  for (const auto& [label, mm] : thickness) thicknessOf[label] = mm;
  return { [=, &map](const VoxelFace& face, double length)
           {
             const double least =
               std::min(thicknessOf[labelAt(map, face.lower)], thicknessOf[labelAt(map, face.upper())]);
             return least < thin * length ? usual : few;
           } };
}

/// Returns the lattice of `map`: of its voxels where these are not much smaller than L, of blocks of voxels elsewhere.
/// Samples are still those of `map`, limited in number per triangle.
KuhnLattice latticeOf(const TissueMap& map, const ScaleField& scale, const std::map<Label, double>& thickness,
                      const SizingFunction& length, const TissueMesherOptions& options, const Progress& progress)
{
  constexpr double blockSize = 0.34; // larger blocks cost smoothness
  if (!leavesVoxels(options)) return kuhnLattice(map, scale, {}, progress);
  const TissueMap blocks = withUniformBlocks(map, scale, { blockSize, options.features.protectedLabels });
  const SampleTransferOptions sampling = samplingOf(map, thickness, hasFineVoxels(sizesOf(map, scale, options)));
  return latticeWithSamplesOf(map, blocks, scale, length, sampling, progress);
}

struct StartingMesh
{
  BackgroundMesh background; ///< without adjacency
  std::size_t faces = 0;     ///< between labels
};

/// Returns that lattice with a smooth interface and with tolerances of its samples.
StartingMesh startingMesh(const TissueMap& map, const ScaleField& scale, const std::map<Label, double>& thickness,
                          const SizingFunction& length, const TissueMesherOptions& options, const Progress& progress)
{
  const auto [shortest, longest] = std::minmax_element(scale.lengths.begin(), scale.lengths.end());
  KuhnLattice lattice = latticeOf(map, scale, thickness, length, options, progress);
  setTolerances(
    lattice.background, map, thickness, length,
    { options.maximumDistance, options.features, options.proximity, *shortest, *longest, options.smoothing > 0 });
  if (options.smoothing > 0)
    moveToSmoothBoundary(
      lattice, map, { .voxels = options.smoothing, .isWiderWithL = leavesVoxels(options), .thickness = thickness });
  else smoothInterface(lattice, map.grid.spacing);
  return { std::move(lattice.background), lattice.interfaceFaces.size() };
}

RemesherOptions remesherOptions(const TissueMesherOptions& options, double voxel)
{
  constexpr double betweenFaces = 0.8; // voxels: half the diagonal of a face, plus the motion of its sample
  RemesherOptions result;
  if (options.smoothing > 0) result.sampleSpacing = betweenFaces * voxel; // tolerances are then narrower
  result.tolerancesAreHard = isBounded(options) || options.proximity.isAsked();
  result.separatedFactor = 2;
  result.rigidity = options.rigidity;
  return result;
}

/// Returns a balance that keeps the volumes of the map by displacements of at most half a voxel.
VolumeBalance balanceOf(const TissueMap& map)
{
  const Vec3 h = map.grid.spacing;
  std::map<Label, double> volumes;
  for (const auto& [label, voxels] : countVoxels(map)) volumes[label] = double(voxels) * h.x * h.y * h.z;
  return { std::move(volumes), 0.5 * map.grid.smallestSpacing() };
}

/// A remesher that records its steps and, unless the distance is bounded, keeps the volumes of tissues.
class TissueRemesher
{
public:
  /// `map` gives the volumes to keep.
  TissueRemesher(StartingMesh start, const TissueMap& map, const SizingFunction& length,
                 const TissueMesherOptions& options, const Progress& progress, std::size_t sweeps)
    : m_Remesher(std::move(start.background), length, remesherOptions(options, map.grid.smallestSpacing()), progress,
                 sweeps),
      m_Balance(balanceOf(map)), m_Balances(!isBounded(options))
  {
    m_Evolution.push_back(evolutionStep(m_Remesher.background(), "lattice", {}));
    m_Evolution.back().faces = start.faces;
  }

  void run(const Sweep& sweep)
  {
    m_Remesher.run(sweep);
    m_Evolution.push_back(evolutionStep(m_Remesher.background(), sweep.name, m_Remesher.counts()));
  }
  void run(const std::vector<Sweep>& sweeps)
  {
    for (const Sweep& sweep : sweeps) run(sweep);
  }
  /// Balances the volumes of tissues before each sweep.
  void balanceAndRun(const std::vector<Sweep>& sweeps)
  {
    constexpr double gain = 1.5; // since angles hold vertices back
    for (const Sweep& sweep : sweeps)
    {
      if (m_Balances) m_Balance.apply(m_Remesher.background(), gain);
      run(sweep);
    }
  }

  /// Moves whole boundaries by the volume that tissues still lack.
  void offsetTissues(const MeshTargets& targets)
  {
    constexpr double leastShare = 0.0002; // of the volume of a tissue
    for (std::size_t round = 0; m_Balances && round < offsetRounds; ++round)
    {
      TissueOffsets offsets = m_Balance.offsets(m_Remesher.background(), leastShare);
      if (offsets.empty()) return;
      run(offsetSweep(targets, std::move(offsets)));
    }
  }

  bool hasUnresolvedFeatures() const { return surgicalmesher::hasUnresolvedFeatures(m_Remesher.background().mesh); }
  MeshedMap result(double targetAngle) &&
  {
    return { std::move(m_Remesher.background()), targetAngle, std::move(m_Evolution), {} };
  }

private:
  Remesher m_Remesher;
  VolumeBalance m_Balance;
  const bool m_Balances;
  std::vector<EvolutionStep> m_Evolution;
};

/// Coarsens level by level, or directly to the last level once features turn out to be unresolved. Returns the targets
/// of the improvement.
MeshTargets coarsen(TissueRemesher& remesher, const MeshSizes& sizes)
{
  const std::vector<double> levels = sizeLevels(sizes);
  bool isNoisy = false;
  for (std::size_t i = 0; i + 1 < levels.size() && !isNoisy; ++i)
  {
    remesher.run(coarsenTo(levels[i], sizes));
    isNoisy = isCoarse(levels[i], sizes) && remesher.hasUnresolvedFeatures();
  }
  remesher.run(coarsenToLast(sizes, !isNoisy));
  return isNoisy || remesher.hasUnresolvedFeatures() ? noisyTargets : usualTargets;
}

} // namespace

ScaleField followBoundary(const TissueMap& map, const ScaleField& scale, const TissueMesherOptions& options,
                          double chordError, double gradation)
{
  const double voxels = options.smoothing > 0 ? options.smoothing : TissueMesherOptions().smoothing;
  const TissueMap smoothed = withoutRoughness(map, scale, options).map;
  return followCurvature(scale, map, boundaryCurvatures(smoothed, voxels), chordError, gradation);
}

MeshedMap meshTissues(const TissueMap& prepared, const ScaleField& wanted, const TissueMesherOptions& options,
                      const Progress& progress)
{
  const Grid& grid = prepared.grid;
  SmoothedLabels smoothed = withoutRoughness(prepared, wanted, options);
  const std::map<Label, double> thickness = meanThickness(smoothed.map);
  const ScaleField scale = followSmallTissues(wanted, smoothed.map, thickness);
  const SizingFunction length = [&](const Vec3& p) { return double(float(scale(grid.gridToWorld(p)))); };
  const MeshSizes sizes = sizesOf(prepared, scale, options);
  StartingMesh start = startingMesh(smoothed.map, scale, thickness, length, options, subProgress(progress, 0, 0.06));
  smoothed.map = {}; // frees memory: it is as large as `prepared`
  TissueRemesher remesher(std::move(start), prepared, length, options, subProgress(progress, 0.1, 1),
                          surfaceSweepCount(sizes));

  MeshTargets targets = coarsen(remesher, sizes);
  targets.opensFolds = options.smoothing > 0;
  remesher.run(firstImprovement(targets, sizes));
  remesher.balanceAndRun(improvementSweeps(targets, sizes));
  remesher.run(repairSweeps(targets, sizes));
  remesher.balanceAndRun({ fittingSweep(targets, sizes) });
  if (options.smoothing > 0) remesher.run(motionSweeps(targets, sizes, options.continuity));
  const bool keepsProximity = options.proximity.isAsked();
  if (keepsProximity) remesher.run(proximitySweeps(targets, sizes));
  remesher.run(secondRepairSweeps(targets, sizes));
  const std::vector<Sweep> last{ finishingSweep(targets, sizes) };
  if (keepsProximity) remesher.run(last); // balancing would move samples beyond the requested distance
  else remesher.balanceAndRun(last);
  remesher.offsetTissues(targets);
  MeshedMap result = std::move(remesher).result(targets.keptAngle);
  result.smoothed = std::move(smoothed.changes);
  return result;
}

} // namespace surgicalmesher
