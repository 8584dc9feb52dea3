// SPDX-License-Identifier: Apache-2.0

// Angles are dihedral, in degrees; tolerances are factors on those of the samples; lengths are in mm, thresholds for
// edges are shares of L. The numbers come from measurements on jhu189, aal, inia19, hncma and the heads, listed in the
// pages that Schedule.h names.

#include "Schedule.h"

#include "MeshQuality.h"

#include <algorithm>

namespace surgicalmesher
{

namespace
{

constexpr double triangleWeight = 1.033; // triangles of 28 degrees count like dihedral angles of 28.5

constexpr double earTolerance = 1.1;    // with more, the surface recedes where it should be most accurate
constexpr double spikeTolerance = 2.1;  // of the samples where a spike is removed
constexpr double widestTolerance = 2.1; // where an angle cannot be improved otherwise
constexpr double planeDistance = 0.6;   // corresponds to 0.2 voxel where L is one voxel
constexpr double lengthTolerance = 1.5; // for even edge lengths
constexpr double foldTolerance = 1.4;   // for the opening of folds
constexpr double labelTolerance = 1.6;  // for relabelling
constexpr double volumeTolerance = 1.3; // for boundaries without room for the last volume corrections
constexpr double vertexDistance = 1.4;  // vertices farther from all samples are spikes
constexpr double spikeTriangles = 1.6;  // as triangleWeight: triangles may lose some degrees where a spike is removed

constexpr double clearlyNearer = 0.9; // largest share of the squared distances that relabelling may leave
constexpr double farNearer = 0.7;     // the same where relabelling may worsen triangles

constexpr std::size_t earTetrahedra = 4;
constexpr double crowd = 0.07;       // see ImprovementOptions
constexpr double wholeCrowd = 0.005; // the same for repairs of the whole mesh, which run on one thread
constexpr double levelRatio = 1.48;  // of successive size levels

EnvelopeBounds bounds(const MeshTargets& targets, double rmsLimit, double toleranceFactor = 1)
{
  return { .rmsLimit = rmsLimit,
           .toleranceFactor = toleranceFactor,
           .triangleWeight = triangleWeight,
           .vertexDistance = targets.holdsVertices ? vertexDistance : 0,
           .planeDistance = targets.holdsVertices ? planeDistance : 0 };
}

/// `stage`, with the bound that keeps folds open, for stages after the opening of folds.
Stage keepingFolds(const MeshTargets& targets, Stage stage)
{
  stage.bounds.keepsFolds = targets.opensFolds;
  return stage;
}

/// Improvement without splits and group moves, for stages that are followed by more thorough ones.
Improve improve(double angle, int trials, int passes)
{
  return {
    { .targetAngle = angle, .split = false, .splitEdge = 0, .trials = trials, .passes = passes, .crowd = crowd }
  };
}

// --- stages of several sweeps

Stage withoutEars()
{
  return { { .rmsLimit = 1, .toleranceFactor = earTolerance, .vertexDistance = vertexDistance },
           { RemoveEars{ earTetrahedra } } };
}

/// `pullAngle`: see SpikeOptions.
Stage withoutSpikes(const MeshTargets& targets, const MeshSizes& sizes, double pullAngle)
{
  SpikeOptions spikes;
  spikes.vertexDistance = vertexDistance;
  spikes.keptAngle = targets.keptAngle;
  spikes.pullAngle = pullAngle;
  spikes.maximumDistance = sizes.maximumDistance;
  return { { .rmsLimit = 1,
             .toleranceFactor = spikeTolerance,
             .triangleWeight = spikeTriangles,
             .vertexDistance = vertexDistance },
           { RelabelInterface{ targets.keptAngle, farNearer }, RemoveSpikes{ spikes } } };
}

/// Vertices where L is below two voxels stay where the map places them.
Stage evenLengths(const MeshTargets& targets, const MeshSizes& sizes, double goodAngle)
{
  const EvenOut pass{ { .goodAngle = goodAngle, .from = 2 * sizes.voxel, .robust = 0.1 * sizes.voxel } };
  return { bounds(targets, 0.5, lengthTolerance), { pass } };
}

/// As in evenLengths(), vertices where L is below two voxels do not move.
Stage openFolds(const MeshTargets& targets, const MeshSizes& sizes, double goodAngle)
{
  EnvelopeBounds within = bounds(targets, 1, foldTolerance);
  within.planeDistance = 0; // the samples' planes are themselves folded
  return { within, { OpenFolds{ { .goodAngle = goodAngle, .from = 2 * sizes.voxel } } } };
}

Stage relabelled(const MeshTargets& targets)
{
  return { { .rmsLimit = 1, .toleranceFactor = labelTolerance, .triangleWeight = triangleWeight },
           { RelabelInterface{ targets.keptAngle, clearlyNearer } } };
}

Coarsen coarsenAll(const MeshSizes& sizes, double leastAngle = 5)
{
  return { sizes.longest, { .shortEdge = 0.82, .minimumAngle = leastAngle, .quarters = true } };
}

/// Opens the folds that fits have left, before the last repairs, at the cost of angles, which are then improved with
/// the folds open.
std::vector<Stage> withoutFolds(const MeshTargets& targets, const MeshSizes& sizes)
{
  constexpr double lostAngle = 15;
  const double kept = targets.keptAngle;
  return { openFolds(targets, sizes, lostAngle),
           { bounds(targets, 1), { improve(kept, 12, 1) } },
           keepingFolds(targets, evenLengths(targets, sizes, kept)) };
}

Sweep improvement(Stage stage) { return { "improvement", { std::move(stage) } }; }

/// How much a repair may change.
struct Repair
{
  double angle;            ///< target angle
  double tolerance;        ///< factor on the samples' tolerances
  double splitEdge;        ///< 0: no splits
  double ease;             ///< see ImprovementOptions
  int together;            ///< see ImprovementOptions
  bool fitsFollow = false; ///< fits come later: vertices may leave their samples' planes, and `crowd` applies
};

ImprovementOptions optionsOf(const Repair& repair)
{
  return { .targetAngle = repair.angle,
           .split = repair.splitEdge > 0,
           .splitEdge = repair.splitEdge,
           .ease = repair.ease,
           .trials = 20,
           .together = repair.together,
           .passes = 3,
           .crowd = repair.fitsFollow ? crowd : 1 };
}

Sweep repairBlocks(const MeshTargets& targets, const Repair& repair)
{
  EnvelopeBounds within = bounds(targets, 1, repair.tolerance);
  if (repair.fitsFollow) within.planeDistance = 0;
  return improvement({ within, { Improve{ optionsOf(repair) } } });
}

/// For tetrahedra that no other repair improves.
Repair widestRepair(const MeshTargets& targets)
{
  return { .angle = targets.keptAngle, .tolerance = widestTolerance, .splitEdge = 0.3, .ease = 1, .together = 20 };
}

Sweep repairWhole(const MeshTargets& targets, const MeshSizes& sizes, const Repair& repair)
{
  ImprovementOptions options = optionsOf(repair);
  options.worstShare = 0.002; // small, since this runs on one thread
  return { "improvement",
           { withoutEars(),
             withoutSpikes(targets, sizes, 0),
             { bounds(targets, 1, repair.tolerance), { Improve{ options } } } },
           true };
}

} // namespace

const MeshTargets usualTargets{ .firstAngle = 22,
                                .aimedAngle = 28.8,
                                .keptAngle = usualAngle,
                                .holdsVertices = true,
                                .opensFolds = true,
                                .repairsThoroughly = false,
                                .trials = 10,
                                .coarseningSweeps = 3 };

const MeshTargets noisyTargets{ .firstAngle = 22,
                                .aimedAngle = 23.5,
                                .keptAngle = modestAngle,
                                .holdsVertices = false,
                                .opensFolds = true,
                                .repairsThoroughly = true,
                                .trials = 12,
                                .coarseningSweeps = 1 };

bool hasUnresolvedFeatures(const TetMesh& mesh)
{
  constexpr std::size_t many = 20000;
  constexpr double share = 0.07;
  const std::size_t bad = countBelow(mesh, 20);
  return bad > many && double(bad) > share * double(mesh.tetrahedra.size());
}

bool hasFineVoxels(const MeshSizes& sizes)
{
  constexpr double many = 12;
  return sizes.longest > many * sizes.voxel;
}

// --- surface stage: coarsening --------------------------------------------------------------------------------------

std::vector<double> sizeLevels(const MeshSizes& sizes)
{
  std::vector<double> levels{ 1.6 * sizes.voxel };
  for (double level = levels[0] * levelRatio; level < sizes.longest; level *= levelRatio) levels.push_back(level);
  levels.push_back(sizes.longest);
  return levels;
}

namespace
{

/// The unit for thresholds on size levels. Where voxels are fine, each step of coarsenTo() starts one level later,
/// since the next level collapses most of its result. A delay by another two levels degrades the surface of thin
/// tissues.
double grainOf(const MeshSizes& sizes) { return hasFineVoxels(sizes) ? levelRatio * sizes.voxel : sizes.voxel; }

} // namespace

bool isCoarse(double level, const MeshSizes& sizes) { return level > 5 * grainOf(sizes); }

/// The first levels have most of the tetrahedra, in a lattice that is still regular: fitting, thorough collapses and
/// repairs pay off only later, and relaxation at these levels makes the final edge lengths less regular. The interface
/// does not resist bending, which would remove detail that later levels need.
Sweep coarsenTo(double level, const MeshSizes& sizes)
{
  const double grain = grainOf(sizes);
  const bool isFirst = level < 2 * grain, isFine = level <= 3 * grain;
  Stage stage{ { .rmsLimit = 0.45, .vertexDistance = vertexDistance }, {} };
  stage.passes.push_back(Coarsen{ level, { .minimumAngle = 5, .fit = !isFirst, .thorough = level > 7 * grain } });
  if (isCoarse(level, sizes))
  {
    stage.passes.push_back(Relax{});
    stage.passes.push_back(SwapEdges{});
  }
  if (!isFine) stage.passes.push_back(improve(15, 8, 1));
  return { .name = "coarsening", .stages = { stage }, .stiff = false };
}

Sweep coarsenToLast(const MeshSizes& sizes, bool thoroughly)
{
  const Coarsen coarsen{ sizes.longest, { .minimumAngle = 5, .quarters = thoroughly } };
  const Stage stage{ { .rmsLimit = 0.45, .vertexDistance = vertexDistance },
                     { coarsen, Relax{}, SwapEdges{}, improve(15, 8, 1) } };
  return { .name = "coarsening", .stages = { stage }, .stiff = false };
}

// --- surface stage: improvement -------------------------------------------------------------------------------------

namespace
{

/// Stage of sweep number n of those that coarsen and improve. The target angle rises from sweep to sweep.
Stage coarsened(const MeshTargets& targets, const MeshSizes& sizes, int n, double rmsLimit)
{
  const double rise = (targets.aimedAngle - targets.firstAngle) / targets.coarseningSweeps;
  return { bounds(targets, rmsLimit),
           { coarsenAll(sizes), SwapEdges{}, Polish{}, improve(targets.firstAngle + n * rise, 8, 1) } };
}

} // namespace

Sweep firstImprovement(const MeshTargets& targets, const MeshSizes& sizes)
{
  return improvement(coarsened(targets, sizes, 0, 0.4));
}

std::vector<Sweep> improvementSweeps(const MeshTargets& targets, const MeshSizes& sizes)
{
  std::vector<Sweep> sweeps;
  for (int n = 1; n < targets.coarseningSweeps; ++n)
  {
    sweeps.push_back(improvement(coarsened(targets, sizes, n, 0.35)));
    sweeps.back().stages.push_back(evenLengths(targets, sizes, 20)); // low angle: coarsening continues
    sweeps.back().stages.push_back(relabelled(targets));
  }
  return sweeps;
}

/// Unless repairs are thorough, groups of vertices move only in the last sweep, and no sweep works on the whole mesh in
/// one block: fits and motion follow, and the second repairs improve what is then left.
std::vector<Sweep> repairSweeps(const MeshTargets& t, const MeshSizes& sizes)
{
  const double aim = t.aimedAngle, kept = t.keptAngle;
  const int passes = t.repairsThoroughly ? 2 : 1, together = t.repairsThoroughly ? 20 : 0;
  Repair inBlocks = widestRepair(t);
  inBlocks.fitsFollow = true;
  std::vector<Sweep> sweeps{ improvement({ bounds(t, 0.5), { SwapEdges{}, Polish{}, improve(aim, t.trials, passes) } }),
                             improvement({ bounds(t, 0.8, 1.3), { improve(aim, 16, passes) } }) };
  if (t.repairsThoroughly)
    sweeps.push_back(repairBlocks(t, { .angle = aim, .tolerance = 1.6, .splitEdge = 0, .ease = 0.02, .together = 0 }));
  sweeps.push_back(repairBlocks(
    t, { .angle = kept, .tolerance = 1.6, .splitEdge = 0, .ease = 0.02, .together = together, .fitsFollow = true }));
  sweeps.push_back(repairBlocks(t, inBlocks));
  if (t.repairsThoroughly) sweeps.push_back(repairWhole(t, sizes, widestRepair(t)));
  return sweeps;
}

Sweep fittingSweep(const MeshTargets& targets, const MeshSizes& sizes)
{
  const double kept = targets.keptAngle, robust = 0.1 * sizes.voxel;
  constexpr double lostAngle = 20; // the second repairs restore angles that fall to this
  const Relax relax{ { .goodAngle = kept, .spread = 0.9, .fit = 2, .robust = robust } };
  const Polish polish{ { .goodAngle = kept, .fit = 10, .robust = robust } };
  return { "improvement",
           { withoutSpikes(targets, sizes, lostAngle),
             { bounds(targets, 0.3), { coarsenAll(sizes, lostAngle), relax, SwapEdges{}, polish } },
             evenLengths(targets, sizes, kept),
             relabelled(targets) } };
}

std::vector<Sweep> motionSweeps(const MeshTargets& targets, const MeshSizes& sizes, Continuity continuity)
{
  constexpr std::size_t sweeps = 2;       // vertices on a border between blocks are free in the next sweep
  constexpr double motionTolerance = 1.5; // the samples contain the voxel noise that motion is to remove
  constexpr double ofPlanes = 0.5;        // of the usual distance: volume that edges lose would swell flat walls
  InterfaceMotionOptions options;
  options.motion.internalForce.continuity = continuity;
  options.farthest = 0.3 * sizes.voxel;
  options.fineLength = 1.5 * sizes.voxel;
  EnvelopeBounds within = bounds(targets, 1, motionTolerance);
  within.planeDistance *= ofPlanes;
  Sweep sweep{ "motion",
               { { within, { MoveInterface{ options }, SwapEdges{} } },
                 { bounds(targets, 1), { improve(targets.keptAngle, 12, 1) } } } };
  const std::vector<Stage> unfolding = withoutFolds(targets, sizes);
  sweep.stages.insert(sweep.stages.end(), unfolding.begin(), unfolding.end());
  return std::vector<Sweep>(sweeps, sweep);
}

std::vector<Sweep> proximitySweeps(const MeshTargets& targets, const MeshSizes& sizes)
{
  constexpr std::size_t sweeps = 3; // triangles on a border between blocks are free in the next sweep
  const Sweep sweep{ "proximity",
                     { { bounds(targets, 1), { MeetProximity{ { .shortest = 0.6 * sizes.voxel } } } },
                       { bounds(targets, 1), { improve(targets.keptAngle, 12, 1) } } } };
  return std::vector<Sweep>(sweeps, sweep);
}

std::vector<Sweep> secondRepairSweeps(const MeshTargets& t, const MeshSizes& sizes)
{
  const double kept = t.keptAngle;
  Sweep inBlocks =
    repairBlocks(t, { .angle = kept, .tolerance = widestTolerance, .splitEdge = 0.4, .ease = 0.1, .together = 20 });
  for (Stage& stage : inBlocks.stages) stage = keepingFolds(t, stage); // the final repairs may fold
  return { inBlocks, repairWhole(t, sizes, widestRepair(t)) };
}

/// Single vertices that repairs have left off the boundary are bumps in flat walls; vertices nearer than the thresholds
/// are where motion has put them. Vertices that can return on their own do so first, then those that need their
/// neighbours to move along.
Sweep finishingSweep(const MeshTargets& targets, const MeshSizes& sizes)
{
  constexpr double farShare = 0.04; // share of L
  const double off = 0.12 * sizes.voxel, farOff = 0.18 * sizes.voxel, robust = 0.1 * sizes.voxel;
  const Polish back{
    { .goodAngle = targets.keptAngle, .fit = 10, .robust = robust, .leastWay = off, .climbs = false }
  };
  const ReturnVertices together{ { .goodAngle = targets.keptAngle,
                                   .leastWay = farOff,
                                   .leastShare = farShare,
                                   .robust = robust,
                                   .foldsFrom = 2 * sizes.voxel } };
  const Stage even = keepingFolds(targets, evenLengths(targets, sizes, targets.keptAngle));
  const std::vector<Pass> alone(targets.repairsThoroughly ? 2 : 1, back);
  std::vector<Stage> stages{ keepingFolds(targets, { bounds(targets, 1), alone }) };
  if (targets.holdsVertices) stages.push_back({ bounds(targets, 1), { together } });
  stages.push_back(even);
  if (targets.opensFolds) stages.insert(stages.end(), { openFolds(targets, sizes, targets.keptAngle), even });
  return { "improvement", stages };
}

Sweep offsetSweep(const MeshTargets& targets, TissueOffsets offsets)
{
  return { "volumes",
           { { bounds(targets, 1, volumeTolerance),
               { OffsetTissues{ { std::move(offsets), targets.keptAngle } } } } } };
}

std::size_t surfaceSweepCount(const MeshSizes& sizes)
{
  const MeshTargets& t = usualTargets;
  return sizeLevels(sizes).size() + 1 + improvementSweeps(t, sizes).size() + repairSweeps(noisyTargets, sizes).size() +
         1 + motionSweeps(t, sizes, Continuity::C2).size() + proximitySweeps(t, sizes).size() +
         secondRepairSweeps(t, sizes).size() + 1 + offsetRounds;
}

// --- tetrahedral stage ----------------------------------------------------------------------------------------------

namespace
{

/// One row of the tables below.
struct VolumeRow
{
  bool held = false; ///< see EnvelopeBounds::interfaceHeld
  double rmsLimit = 1;
  double tolerance = 1;    ///< factor on the samples' tolerances
  bool keepsFolds = false; ///< see EnvelopeBounds
  std::size_t polishes = 0;
  bool swaps = true; ///< whether edges are swapped before each polish
  PolishingOptions polishing = {};
  double angle = 0;     ///< target angle; 0: no improvement
  int trials = 0;       ///< see ImprovementOptions
  int passes = 2;       ///< likewise
  double splitEdge = 0; ///< 0: no splits
  double crowd = 1;     ///< see ImprovementOptions
  bool whole = false;
  bool softens = false;  ///< whether stiff pairs are softened first, with tolerance factor 1
  double height = 0;     ///< mm, see HeightOptions; if positive, the row only softens and raises heights
  bool balanced = false; ///< see TetrahedralSweep
};

/// Raises heights first with tolerance factor 1, which leaves no dents in the surface. Then with the wider bounds
/// `beyond`, but to a lower height: a small deficit is not worth a dent.
std::vector<Stage> raisedHeights(const EnvelopeBounds& beyond, double height)
{
  constexpr double dentingShare = 0.95;
  EnvelopeBounds within = beyond;
  within.toleranceFactor = 1;
  return { { within, { RaiseHeights{ { .height = height } } } },
           { beyond, { RaiseHeights{ { .height = dentingShare * height } } } } };
}

TetrahedralSweep sweepOf(const VolumeRow& row)
{
  Stage stage{ { .rmsLimit = row.rmsLimit,
                 .toleranceFactor = row.tolerance,
                 .keepsFolds = row.keepsFolds,
                 .interfaceHeld = row.held },
               {} };
  for (std::size_t n = 0; n < row.polishes; ++n)
  {
    if (row.swaps) stage.passes.push_back(SwapEdges{ { .sparesWhole = true } });
    stage.passes.push_back(Polish{ row.polishing });
  }
  if (row.angle > 0)
    stage.passes.push_back(Improve{ { .targetAngle = row.angle,
                                      .split = row.splitEdge > 0,
                                      .splitEdge = row.splitEdge,
                                      .trials = row.trials,
                                      // Where many tetrahedra are bad, group moves cost more than all the rest.
                                      .together = row.splitEdge > 0 ? 20 : 0,
                                      .patience = 20, // no later operation would improve what splits leave
                                      .passes = row.passes,
                                      .crowd = row.crowd } });
  Sweep sweep{ "improvement", { stage }, row.whole };
  if (row.height > 0) sweep.stages = raisedHeights(stage.bounds, row.height);
  if (row.softens) sweep.stages.insert(sweep.stages.begin(), { { .rmsLimit = 1 }, { SoftenPairs{} } });
  return { std::move(sweep), row.balanced };
}

/// Merges consecutive rows over the whole mesh into one sweep: to set up the complex and to write it back costs more
/// than most of these rows.
std::vector<TetrahedralSweep> sweepsOf(const std::vector<VolumeRow>& rows)
{
  std::vector<TetrahedralSweep> sweeps;
  for (const VolumeRow& row : rows)
  {
    TetrahedralSweep next = sweepOf(row);
    if (sweeps.empty() || !sweeps.back().sweep.whole || !next.sweep.whole)
    {
      sweeps.push_back(std::move(next));
      continue;
    }
    std::vector<Stage>& stages = sweeps.back().sweep.stages;
    stages.insert(stages.end(), next.sweep.stages.begin(), next.sweep.stages.end());
  }
  return sweeps;
}

/// Repairs of tetrahedra that are still below the target angle, with ever larger distances from the surface's samples
/// and finally with splits. Splits come late because they make edge lengths less regular.
std::vector<VolumeRow> repairRows(double t)
{
  // clang-format off
  return {
    { .tolerance = 2, .keepsFolds = true, .angle = t, .trials = 20, .passes = 3, .crowd = wholeCrowd, .whole = true },
    { .tolerance = 3, .keepsFolds = true, .angle = t, .trials = 20, .passes = 3, .crowd = wholeCrowd, .whole = true },
    { .tolerance = 4, .angle = t, .trials = 20, .passes = 3, .whole = true },
    { .tolerance = 4, .angle = t, .trials = 20, .passes = 3, .splitEdge = 0.6, .whole = true },
    { .tolerance = 4, .angle = t, .trials = 30, .passes = 4, .splitEdge = 0.4, .whole = true },
  };
  // clang-format on
}

/// Improves what solvers depend on: stiff pairs, then heights. Comes last, when the angles are final. Works on the
/// whole mesh, since the worst element counts, wherever it is. Allows smaller distances from the samples than repairs
/// do: a height that needs more would leave a dent or a bump in a smooth wall.
VolumeRow lastRow(double smallestLength)
{
  constexpr double share = 0.4; // the lattice has 0.82; a larger share costs angles in lattices of uniform length
  return { .tolerance = 1.5, .whole = true, .softens = true, .height = share * smallestLength };
}

} // namespace

/// No relaxation and no collapses: the lattice has the right edge lengths, and both would destroy it. For the same
/// reason polishing leaves the lattice's vertices alone. In the end the surface returns to its samples as far as angles
/// allow, and the tissues to their volumes.
std::vector<TetrahedralSweep> sweepsForRawMesh(double t, double smallestLength)
{
  const PolishingOptions polishing{ .sparesWhole = true };
  const PolishingOptions back{ .goodAngle = 28.4, .fit = 3, .sparesWhole = true };
  std::vector<VolumeRow> rows = repairRows(t);
  // clang-format off
  rows.insert(rows.begin(), {
    { .rmsLimit = 0.3, .polishes = 2, .polishing = polishing, .angle = t, .trials = 8 },
    { .rmsLimit = 0.5, .polishes = 2, .polishing = polishing, .angle = t, .trials = 12 },
    { .rmsLimit = 0.8, .tolerance = 1.5, .polishes = 3, .polishing = polishing, .angle = t, .trials = 16 },
  });
  constexpr std::size_t balancingRounds = 3;
  rows.insert(rows.end(), balancingRounds,
              { .rmsLimit = 0.4, .polishes = 2, .polishing = back, .balanced = true });
  // clang-format on
  rows.push_back(lastRow(smallestLength));
  return sweepsOf(rows);
}

namespace
{

/// Holds the surface first, then lets it move by ever larger tolerances where angles are still below the target.
std::vector<TetrahedralSweep> repairsOfImprovedMesh(double t, double smallestLength, bool swaps)
{
  const PolishingOptions polishing{ .sparesWhole = true };
  std::vector<VolumeRow> rows = repairRows(t);
  // clang-format off
  rows.insert(rows.begin(), {
    { .held = true, .polishes = 2, .swaps = swaps, .polishing = polishing, .angle = t, .trials = 12 },
    { .held = true, .polishes = 2, .swaps = swaps, .polishing = polishing, .angle = t, .trials = 16 },
    { .rmsLimit = 0.8, .tolerance = 0.5, .keepsFolds = true, .angle = t, .trials = 20, .passes = 3,
      .crowd = wholeCrowd, .whole = true },
    { .rmsLimit = 0.8, .tolerance = 1.5, .keepsFolds = true, .angle = t, .trials = 20, .passes = 3,
      .crowd = wholeCrowd, .whole = true },
  });
  // clang-format on
  const VolumeRow last{ .tolerance = 4, .angle = t, .trials = 40, .passes = 6, .splitEdge = 0.2, .whole = true };
  rows.insert(rows.end(), 2, last); // the second uses the room that the first has made
  rows.push_back(lastRow(smallestLength));
  return sweepsOf(rows);
}

} // namespace

std::vector<TetrahedralSweep> sweepsForImprovedMesh(double t, double smallestLength)
{
  return repairsOfImprovedMesh(t, smallestLength, true);
}

Stage restoringStage(double targetAngle, VolumeBalance wanted)
{
  constexpr double tolerance = 4; // the largest that repairs have used
  return { { .rmsLimit = 1, .toleranceFactor = tolerance },
           { RestoreVolumes{ { .wanted = std::move(wanted), .goodAngle = targetAngle } } } };
}

/// Only edges that tracing has cut are short, so collapses leave the rest of the lattice alone. For the same reason,
/// edges are not swapped.
std::vector<TetrahedralSweep> sweepsForCurves(double t, double smallestLength)
{
  constexpr double shortEdge = 0.6, anyLevel = 1e9;
  std::vector<TetrahedralSweep> sweeps;
  for (const double leastAngle : { 1.0, 5.0, 12.0, 18.0 })
  {
    const Coarsen coarsen{ anyLevel, { .shortEdge = shortEdge, .minimumAngle = leastAngle } };
    const Stage stage{ { .rmsLimit = 1 }, { coarsen, improve(t, 12, 2) } };
    sweeps.push_back({ { "curves", { stage } } });
  }
  const std::vector<TetrahedralSweep> repairs = repairsOfImprovedMesh(t, smallestLength, false);
  sweeps.insert(sweeps.end(), repairs.begin(), repairs.end());
  return sweeps;
}

} // namespace surgicalmesher
