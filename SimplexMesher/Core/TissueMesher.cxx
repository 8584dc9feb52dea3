#include "TissueMesher.h"

#include "KuhnLattice.h"
#include "Coarsening.h"
#include "EvenLengths.h"
#include "Improvement.h"
#include "MeshQuality.h"
#include "InterfaceSmoothing.h"
#include "Relabelling.h"
#include "TetQuality.h"
#include "TissueScale.h"

#include <vtkSMPTools.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>

namespace surgicalmesher
{

namespace
{

constexpr double earTolerance = 1.1;                      // beyond that the surface withdraws where it is to be finest
constexpr double lengthsRms = 0.5, lengthsTolerance = 1.1; // what even lengths are worth; see Envelope
constexpr double relabelTolerance = 1.6, spikeTolerance = 2.1;
constexpr double usualVertexDistance = 1.4; // likewise times the tolerance; see Envelope
constexpr double usualSeparatedFactor = 2;   // see Envelope
constexpr double triangleWeightAtSpikes = 1.6;
constexpr double clearly = 0.9, byFar = 0.7; // see relabelBlock: the latter pays for a worse triangle
constexpr double mostBalance = 0.5;          // voxels
constexpr double balanceGain = 1.5;          // angles hold vertices back from where the samples goes

class Evolution
{
public:
  Evolution(BackgroundMesh& ambient, std::vector<EvolutionStep>& steps) : m_Ambient(ambient), m_Steps(steps) {}

  void count(const OperationCounts& c)
  {
    const std::lock_guard<std::mutex> lock(m_Mutex);
    m_Counts.collapses += c.collapses;
    m_Counts.moves += c.moves;
    m_Counts.flips += c.flips;
    m_Counts.splits += c.splits;
    m_Counts.relabels += c.relabels;
  }

  void record(const std::string& stage)
  {
    EvolutionStep step;
    step.stage = stage;
    step.operations = m_Counts;
    m_Counts = {};
    const TetMesh& mesh = m_Ambient.mesh;
    step.tetrahedra =
      std::size_t(std::count_if(mesh.labels.begin(), mesh.labels.end(), [](Label l) { return l != 0; }));
    const auto& neighbours = m_Ambient.neighbours; // none before the first sweep
    for (std::size_t t = 0; t < neighbours.size(); ++t)
      for (const std::int32_t n : neighbours[t]) step.faces += n > std::int32_t(t) && mesh.labels[n] != mesh.labels[t];
    // In parts of a fixed size: their sum does not depend on the threads.
    constexpr std::size_t part = 4096;
    const auto& samples = m_Ambient.samples;
    std::vector<std::pair<double, double>> sumAndMaximum((samples.size() + part - 1) / part);
    vtkSMPTools::For(
      0, vtkIdType(sumAndMaximum.size()),
      [&](vtkIdType begin, vtkIdType end)
      {
        for (vtkIdType p = begin; p < end; ++p)
          for (std::size_t i = std::size_t(p) * part; i < std::min(samples.size(), (std::size_t(p) + 1) * part); ++i)
          {
            const auto& t = mesh.tetrahedra[samples[i].tetrahedron];
            const auto corner = [&](int k) { return mesh.points[t[(samples[i].face + k) & 3]]; };
            const double d =
              std::sqrt(squaredDistanceToTriangle(samples[i].position, corner(1), corner(2), corner(3)));
            sumAndMaximum[p].first += d;
            sumAndMaximum[p].second = std::max(sumAndMaximum[p].second, d);
          }
      });
    double sum = 0;
    for (const auto& [ofPart, maximum] : sumAndMaximum)
    {
      sum += ofPart;
      step.maximumDistance = std::max(step.maximumDistance, maximum);
    }
    if (!m_Ambient.samples.empty()) step.meanDistance = sum / double(m_Ambient.samples.size());
    m_Steps.push_back(step);
  }

private:
  BackgroundMesh& m_Ambient;
  std::vector<EvolutionStep>& m_Steps;
  std::mutex m_Mutex;
  OperationCounts m_Counts;
};

double shortestSpacing(const Grid& grid) { return std::min({ grid.spacing.x, grid.spacing.y, grid.spacing.z }); }

/// The two voxels whose common face has its centre at p.
std::array<Label, 2> labelsBeside(const TissueMap& map, const Vec3& p)
{
  std::array<std::array<int, 3>, 2> voxels;
  for (int a = 0; a < 3; ++a)
  {
    const double at = p[a] / map.grid.spacing[a];
    voxels[0][a] = int(std::lround(at - 0.01));
    voxels[1][a] = int(std::lround(at + 0.01));
  }
  return { labelAt(map, voxels[0]), labelAt(map, voxels[1]) };
}

/// What share of the usual tolerance a map allows: the voxels that a drift of the surfaces puts into wrong tissues are as many
/// as their area times the drift, so that a large map whose surfaces lie close together must have less of it. In a small one
/// they lie close because its bodies are small.
double roomFor(const BackgroundMesh& ambient, const TissueMap& map)
{
  constexpr std::size_t large = 600000; // faces between tissues
  constexpr double usual = 3.0;         // voxels of tissue for each
  if (ambient.samples.size() < large) return 1;
  const auto tissue = std::count_if(map.labels.begin(), map.labels.end(), [](Label l) { return l != 0; });
  const double ratio = double(tissue) / (usual * double(ambient.samples.size()));
  return std::clamp(ratio * ratio, 0.5, 1.0);
}

/// How far the boundary of each tissue may drift, mm: what nobody sees on a thick tissue takes a third of a thin one's
/// volume. A thin tissue that simplification has left is held the less closely, as what is of its size elsewhere has gone.
std::map<Label, double> mostDrifts(const std::map<Label, double>& thickness, double voxel,
                                   const FeatureOptions& features)
{
  constexpr double share = 0.28, perScale = 0.08, most = 0.4; // of the thickness
  std::map<Label, double> result;
  for (const auto& [label, mm] : thickness)
  {
    const double scale = features.protectedLabels.count(label) ? 0 : features.featureScale;
    result[label] = std::max(0.6 * voxel, std::min(share + perScale * scale, most) * mm);
  }
  return result;
}

/// `ambient` as the lattice made it: with its samples at the centres of voxel faces.
void setTolerances(BackgroundMesh& ambient, const TissueMap& map, const std::map<Label, double>& thickness,
                   const SizingFunction& scale, const TissueMesherOptions& options)
{
  const double voxel = std::max({ map.grid.spacing.x, map.grid.spacing.y, map.grid.spacing.z });
  const double room = roomFor(ambient, map), bound = options.maximumDistance;
  const std::map<Label, double> drifts = mostDrifts(thickness, voxel, options.features);
  for (auto& e : ambient.samples)
  {
    double tolerance = room * (0.42 * voxel + 0.095 * scale(e.position));
    for (const Label label : labelsBeside(map, e.position))
      if (label != 0) tolerance = std::min(tolerance, drifts.at(label));
    e.tolerance = float(bound > 0 ? std::min(tolerance, bound) : tolerance);
  }
}

/// Moves the samples of every tissue that has gained or lost volume along its boundary's normals: smoothing and least
/// squares cut corners, which takes from whatever is convex.
class VolumeBalance
{
public:
  explicit VolumeBalance(const TissueMap& map) : m_Most(mostBalance * shortestSpacing(map.grid))
  {
    const Vec3 h = map.grid.spacing;
    for (const auto& [label, voxels] : countVoxels(map)) m_Volumes[label] = double(voxels) * h.x * h.y * h.z;
  }

  /// By what would make up for the volume and half as much again; half a voxel in all at most, a voxel between two tissues.
  void apply(BackgroundMesh& ambient)
  {
    const TetMesh& mesh = ambient.mesh;
    const auto& neighbours = ambient.neighbours;
    const auto corner = [&](std::int32_t t, int i, int k) { return mesh.points[mesh.tetrahedra[t][(i + k) & 3]]; };
    const auto normal = [&](std::int32_t t, int i)
    { return cross(corner(t, i, 2) - corner(t, i, 1), corner(t, i, 3) - corner(t, i, 1)); };
    std::vector<double> missing(labelCount), area(labelCount);
    for (const auto& [label, volume] : m_Volumes) missing[label] = volume;
    for (std::int32_t t = 0; t < std::int32_t(mesh.tetrahedra.size()); ++t)
    {
      const Label label = mesh.labels[t];
      missing[label] -= orient(corner(t, 0, 0), corner(t, 0, 1), corner(t, 0, 2), corner(t, 0, 3)) / 6;
      for (int i = 0; i < 4; ++i)
        if (const std::int32_t n = neighbours[t][i]; n >= 0 && mesh.labels[n] != label)
          area[label] += 0.5 * norm(normal(t, i));
    }
    std::vector<double> steps(labelCount);
    for (const auto& [label, volume] : m_Volumes)
      if (label != 0 && area[label] > 0) steps[label] = stepOf(label, missing[label] / area[label]);
    for (auto& e : ambient.samples)
    {
      Vec3 outward = normal(e.tetrahedron, e.face);
      if (dot(outward, corner(e.tetrahedron, e.face, 0) - corner(e.tetrahedron, e.face, 1)) > 0)
        outward = -1.0 * outward;
      const Label inside = mesh.labels[e.tetrahedron], beyond = mesh.labels[neighbours[e.tetrahedron][e.face]];
      e.position += (steps[inside] - steps[beyond]) / norm(outward) * outward;
    }
  }

private:
  double stepOf(Label label, double lacking)
  {
    double& moved = m_Moved[label];
    const double before = moved;
    moved = std::clamp(moved + balanceGain * lacking, -m_Most, m_Most);
    return moved - before;
  }

  double m_Most;
  std::map<Label, double> m_Volumes, m_Moved;
};

/// What one sweep over the blocks does, in this order.
struct Step
{
  std::string name;
  double rmsLimit = 0.45;    ///< see Envelope
  double toleranceFactor = 1;          ///< see Envelope
  double triangleWeight = 0; ///< see Envelope
  double vertexDistance = usualVertexDistance; ///< see Envelope
  double level = 0;          ///< mm, size that short edges are collapsed to; 0: none
  double shortEdge = 0.75;   ///< see CoarseningOptions
  bool fitCollapses = true;
  bool thoroughCollapses = true;
  bool quarterCollapses = true; ///< see CoarseningOptions
  double collapseAngle = 5;     ///< degrees, least that a collapse leaves
  int relaxations = 0;
  RelaxationOptions relaxation;
  int polishes = 0;
  PolishOptions polishing;
  std::size_t trim = 0;   ///< see removeEarsOfBlock
  double spikes = 0;      ///< degrees; see SpikeOptions::keptAngle; 0: none are cut
  double pullAngle = 0;   ///< degrees; see SpikeOptions
  double relabelling = 0; ///< degrees; see relabelBlock; 0: none
  ImprovementOptions improvement = improvementTo(0, 0, 0);
  int lengthRounds = 0; ///< of evenLengthsOfBlock
  EdgeLengthOptions lengths;
  bool balance = false; ///< tissues' volumes first; not under a bound on the distance to the boundary as it is
  bool whole = false;   ///< in one block: borders are locked, and what is still bad lies at them

  static ImprovementOptions improvementTo(double angle, int trials, int passes, double splitEdge = 0)
  {
    ImprovementOptions o;
    o.targetAngle = angle;
    o.trials = trials;
    o.passes = passes;
    o.split = splitEdge > 0;
    o.splitEdge = splitEdge;
    return o;
  }
};

/// Levels of size, each about 1.5 times the one before: a single pass to the final lengths would leave a ragged mesh. The
/// first levels hold most of the tetrahedra, in a lattice that is still regular: fitting, thoroughness and repair pay later,
/// and relaxation there costs regular sizes in the end.
std::vector<Step> coarseningSteps(const Grid& grid, double longest)
{
  const double least = shortestSpacing(grid);
  Step step;
  step.name = "coarsening";
  step.level = 1.6 * least;
  step.fitCollapses = step.thoroughCollapses = false;
  std::vector<Step> steps{ step };
  step.fitCollapses = true;
  for (step.level *= 1.48; step.level < longest; step.level *= 1.48)
  {
    if (step.level > 3 * least) step.improvement = Step::improvementTo(15, 8, 1);
    if (step.level > 5 * least) step.relaxations = 1;
    step.thoroughCollapses = step.level > 7 * least;
    steps.push_back(step);
  }
  step.level = longest;
  step.relaxations = 1;
  step.thoroughCollapses = true;
  step.improvement = Step::improvementTo(15, 8, 1);
  steps.push_back(step);
  return steps;
}

constexpr double as28Degrees = 1.033; // of a triangle, beside 28.5 between faces

/// What is tried for, and how hard.
struct Effort
{
  double first = 25;                   ///< degrees, dihedral: aimed at before the final angle is
  double aim = 28.8;                   ///< degrees, dihedral: aimed at in the end
  double kept = usualAngle;            ///< degrees, dihedral: not to be lost again
  double widestTolerance = 2.1;              ///< times the tolerance, where an angle can't be mended otherwise
  double shortEdge = 0.82;             ///< see CoarseningOptions
  double triangleWeight = as28Degrees; ///< see Envelope; 0: neither triangles, spikes nor lengths are worked on
  int trials = 10;                     ///< see ImprovementOptions, once sizes no longer change
  int coarsenings = 3;                 ///< sweeps that still coarsen
  int rounds = 2;                      ///< of balance after the repairs
};

/// Where features are of the map's own size, as noise makes them: see hasUnresolvedFeatures.
Effort modestEffort()
{
  Effort effort;
  effort.first = 22;
  effort.aim = 23.5;
  effort.kept = modestAngle;
  effort.widestTolerance = 2.4;
  effort.shortEdge = 0.75;
  effort.triangleWeight = 0;
  effort.trials = 12;
  effort.coarsenings = effort.rounds = 1;
  return effort;
}

/// Whether coarsening has left so many bad tetrahedra that features of the map's own size, as noise makes them, have no room
/// for good ones: to try for them all would take most of the time and be in vain.
bool hasUnresolvedFeatures(const TetMesh& mesh)
{
  constexpr std::size_t many = 20000;
  constexpr double share = 0.07;
  const std::size_t bad = countBelow(mesh, 20);
  return bad > many && double(bad) > share * double(mesh.tetrahedra.size());
}

/// What crowds a mesh also holds most of its vertices: to try them at every level and place costs much and gains little.
void goStraightToLastLevel(std::vector<Step>& coarsening, std::size_t from)
{
  if (from + 1 == coarsening.size()) return;
  coarsening.erase(coarsening.begin() + std::ptrdiff_t(from) + 1, coarsening.end() - 1);
  coarsening.back().quarterCollapses = false;
}

/// The angle aimed at rises from step to step: sizes suffer less than from one step straight to the end. Only what is still
/// bad afterwards may stray farther from the samples, or be split; and in the end all go back towards it as far as the
/// angles allow.
std::vector<Step> improvementSteps(double voxel, double longest, const Effort& effort)
{
  const double aim = effort.aim, kept = effort.kept, between = 0.5 * (effort.first + aim);
  const bool evens = effort.triangleWeight > 0;
  std::vector<Step> steps;
  const auto add = [&](double rmsLimit, double level, int polishes, const ImprovementOptions& improvement)
  {
    Step step;
    step.name = "improvement";
    step.rmsLimit = rmsLimit;
    step.level = level;
    step.polishes = polishes;
    step.improvement = improvement;
    step.shortEdge = effort.shortEdge;
    step.triangleWeight = effort.triangleWeight;
    step.vertexDistance = evens ? usualVertexDistance : 0;
    step.quarterCollapses = evens;
    steps.push_back(step);
  };
  const auto evenLengths = [&](int rounds, double goodAngle)
  {
    steps.back().lengthRounds = rounds;
    steps.back().lengths = { goodAngle, 2 * voxel, 0.1 * voxel }; // not where surface and map are to lie closest
  };
  add(0.4, longest, 1, Step::improvementTo(effort.first, 8, 1));
  for (int sweep = 1; sweep < effort.coarsenings; ++sweep)
  {
    add(0.35, longest, 1, Step::improvementTo(sweep == 1 ? between : aim, 8, 1));
    steps.back().balance = true;
    steps.back().relabelling = evens ? kept : 0;
    if (evens) evenLengths(2, 20); // sizes still change
  }
  add(0.5, 0, 1, Step::improvementTo(aim, effort.trials, 2));
  add(0.8, 0, 0, Step::improvementTo(aim, 16, 2));
  steps.back().toleranceFactor = 1.3;
  const auto repair = [&](double angle, double toleranceFactor, double splitEdge, double ease, int together, bool whole)
  {
    add(1, 0, 0, Step::improvementTo(angle, 20, 3, splitEdge));
    Step& step = steps.back();
    step.improvement.ease = ease;
    step.toleranceFactor = toleranceFactor;
    step.improvement.together = together;
    step.whole = whole;
    if (!whole) return;
    step.spikes = evens ? kept : 0;
    step.improvement.worstShare = 0.002; // on one thread
  };
  repair(aim, 1.6, 0, 0.02, 0, false);
  repair(kept, 1.6, 0, 0.02, 20, false);
  repair(kept, effort.widestTolerance, 0.3, 1, 20, false);
  repair(kept, effort.widestTolerance, 0.3, 1, 20, true);
  steps.back().trim = 4; // before the last rounds of balance
  for (int round = 0; round < effort.rounds; ++round)
  {
    add(round == 0 ? 0.3 : 0.25, longest, 1, Step::improvementTo(0, 0, 0));
    Step& step = steps.back();
    step.balance = true;
    step.collapseAngle = kept;
    step.relabelling = step.spikes = evens ? kept : 0;
    step.pullAngle = 20; // what is lost, the repairs after the rounds bring back
    step.relaxations = 1;
    step.relaxation.goodAngle = step.polishing.goodAngle = kept;
    step.relaxation.fit = 2;
    step.relaxation.spread = 0.9;
    step.polishing.fit = 10;
    step.relaxation.robust = step.polishing.robust = 0.1 * voxel;
    if (evens) evenLengths(2, kept);
  }
  repair(kept, effort.widestTolerance, 0.4, 0.1, 20, false); // what resisted may have got room
  repair(kept, effort.widestTolerance, 0.3, 1, 20, true);
  steps.back().trim = 4; // relabelling leaves tips
  if (!evens) return steps;
  add(0.25, 0, 0, Step::improvementTo(0, 0, 0));
  steps.back().balance = true; // repairs cost volume
  evenLengths(1, kept);
  return steps;
}

void coarsenAndImprove(GuardedOperations& operations, const Step& step)
{
  CoarseningOptions coarsening;
  coarsening.minimumAngle = step.collapseAngle;
  coarsening.shortEdge = step.shortEdge;
  coarsening.fit = step.fitCollapses;
  coarsening.thorough = step.thoroughCollapses;
  coarsening.quarters = step.quarterCollapses;
  if (step.level > 0) coarsenBlock(operations, step.level, coarsening);
  for (int i = 0; i < step.relaxations; ++i) relaxBlock(operations, step.relaxation);
  for (int i = 0; i < step.polishes; ++i) polishBlock(operations, step.polishing);
  if (step.improvement.targetAngle > 0) improveBlock(operations, step.improvement);
}

/// `guarded` does a change to a block under guards; `maximumDistance` bounds what they don't.
template <class Guarded>
void work(const Guarded& guarded, const Step& step, double maximumDistance)
{
  if (step.trim > 0)
    guarded({ 1, earTolerance, 0, usualVertexDistance }, [&](auto& operations) { removeEarsOfBlock(operations, step.trim); });
  if (step.spikes > 0)
  {
    SpikeOptions spikes;
    spikes.vertexDistance = usualVertexDistance;
    spikes.keptAngle = step.spikes;
    spikes.pullAngle = step.pullAngle;
    spikes.maximumDistance = maximumDistance;
    guarded({ 1, spikeTolerance, triangleWeightAtSpikes },
            [&](auto& operations)
            {
              relabelBlock(operations, step.spikes, byFar);
              cutSpikesOfBlock(operations, spikes);
            });
  }
  guarded({ step.rmsLimit, step.toleranceFactor, step.triangleWeight, step.vertexDistance },
          [&](auto& operations) { coarsenAndImprove(operations, step); });
  if (step.lengthRounds > 0)
    guarded({ lengthsRms, lengthsTolerance, step.triangleWeight, step.vertexDistance },
            [&](auto& operations)
            {
              for (int i = 0; i < step.lengthRounds; ++i) evenLengthsOfBlock(operations, step.lengths);
            });
  if (step.relabelling > 0)
    guarded({ 1, relabelTolerance, step.triangleWeight },
            [&](auto& operations) { relabelBlock(operations, step.relabelling, clearly); });
}

} // namespace

SurfaceMesh meshTissues(const TissueMap& map, const ScaleField& wanted, const TissueMesherOptions& options,
                        const Progress& progress)
{
  SurfaceMesh result;
  const std::map<Label, double> thickness = meanThickness(map);
  const ScaleField scale = followFlatTissues(wanted, map, thickness);
  const SizingFunction lengthAt = [&](const Vec3& p) { return float(scale(map.grid.gridToWorld(p))); };
  KuhnLattice lattice = kuhnLattice(map, scale, {}, subProgress(progress, 0, 0.06));
  setTolerances(lattice.ambient, map, thickness, lengthAt, options);
  smoothInterface(lattice, map.grid.spacing);
  result.ambient = std::move(lattice.ambient);

  VolumeBalance balance(map);
  Evolution evolution(result.ambient, result.evolution);
  evolution.record("lattice");
  std::vector<Step> steps = coarseningSteps(map.grid, *std::max_element(scale.lengths.begin(), scale.lengths.end()));
  const double voxel = shortestSpacing(map.grid), longest = steps.back().level;
  const double most = double(steps.size() + improvementSteps(voxel, longest, {}).size());
  std::size_t coarsenings = steps.size();
  bool unresolved = false;
  for (std::size_t i = 0; i < steps.size(); ++i)
  {
    const Step step = steps[i]; // steps grows
    if (step.balance && options.maximumDistance == 0) balance.apply(result.ambient);
    const Progress part = subProgress(progress, 0.1 + 0.9 * double(i) / most, 0.1 + 0.9 * double(i + 1) / most);
    sweepBlocks(
      result.ambient, int(i), step.whole ? oneBlock : fairBlock(result.ambient.mesh),
      [&](TetComplex& block)
      {
        const auto guarded = [&](Envelope guards, const auto& change)
        {
          if (options.maximumDistance > 0) guards.toleranceFactor = 1;
          else guards.separatedFactor = usualSeparatedFactor;
          GuardedOperations operations(block, lengthAt, guards);
          change(operations);
          evolution.count(operations.counts);
        };
        work(guarded, step, options.maximumDistance > 0 ? options.maximumDistance : HUGE_VAL);
      },
      [&](double fraction, const std::string&) { report(part, fraction, step.name); });
    evolution.record(step.name);
    if (!unresolved && i < coarsenings && (i + 1 == coarsenings || step.level > 5 * voxel))
    {
      unresolved = hasUnresolvedFeatures(result.ambient.mesh);
      if (unresolved) goStraightToLastLevel(steps, i);
      coarsenings = steps.size();
    }
    if (i + 1 != coarsenings) continue;
    const std::vector<Step> improving = improvementSteps(voxel, longest, unresolved ? modestEffort() : Effort());
    steps.insert(steps.end(), improving.begin(), improving.end());
  }
  return result;
}

} // namespace surgicalmesher
