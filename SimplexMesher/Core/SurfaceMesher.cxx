#include "SurfaceMesher.h"

#include "AmbientLattice.h"
#include "Coarsening.h"
#include "Improvement.h"
#include "ReferenceSurface.h"

#include <algorithm>
#include <cmath>
#include <mutex>

namespace surgicalmesher
{

namespace
{

constexpr std::size_t blockSize = 40000; // tetrahedra: a few megabytes, and enough blocks for the threads

class Evolution
{
public:
  Evolution(AmbientMesh& ambient, std::vector<EvolutionStep>& steps) : m_Ambient(ambient), m_Steps(steps) {}

  void count(const OperationCounts& c)
  {
    const std::lock_guard<std::mutex> lock(m_Mutex);
    m_Counts.collapses += c.collapses;
    m_Counts.moves += c.moves;
    m_Counts.flips += c.flips;
    m_Counts.splits += c.splits;
  }

  void record(const std::string& stage)
  {
    EvolutionStep step;
    step.stage = stage;
    step.operations = m_Counts;
    m_Counts = {};
    const TetraMesh& mesh = m_Ambient.mesh;
    step.tetrahedra = std::size_t(std::count_if(mesh.labels.begin(), mesh.labels.end(), [](Label l) { return l != 0; }));
    double sum = 0;
    for (const auto& e : m_Ambient.evidence)
    {
      const auto& t = mesh.tetrahedra[e.tetrahedron];
      const auto corner = [&](int k) { return mesh.points[t[(e.face + k) & 3]]; };
      const double d = std::sqrt(squaredDistanceToTriangle(e.position, corner(1), corner(2), corner(3)));
      sum += d;
      step.maximumDistance = std::max(step.maximumDistance, d);
    }
    if (!m_Ambient.evidence.empty()) step.meanDistance = sum / double(m_Ambient.evidence.size());
    m_Steps.push_back(step);
  }

private:
  AmbientMesh& m_Ambient;
  std::vector<EvolutionStep>& m_Steps;
  std::mutex m_Mutex;
  OperationCounts m_Counts;
};

void setTolerances(AmbientMesh& ambient, const Vec3& spacing, const ScaleFunction& scale, double bound)
{
  const double voxel = std::max({ spacing.x, spacing.y, spacing.z });
  for (auto& e : ambient.evidence)
  {
    e.tolerance = float(0.45 * voxel + 0.11 * scale(e.position));
    if (bound > 0) e.tolerance = std::min(e.tolerance, float(bound));
  }
}

/// What one sweep over the blocks does.
struct Step
{
  std::string name;
  double rmsLimit = 0.45; ///< see GuardedOperations
  double level = 0;       ///< mm, size that short edges are collapsed to; 0: none
  bool again = false;     ///< collapses once more after relaxation and repair have made room
  bool relax = true;
  ImprovementOptions improvement;
};

ImprovementOptions improvementTo(double angle, double splitEdge, int trials, int passes)
{
  ImprovementOptions o;
  o.targetAngle = angle;
  o.split = splitEdge > 0;
  o.splitEdge = splitEdge;
  o.trials = trials;
  o.passes = passes;
  return o;
}

/// Levels of size, each about 1.5 times the one before: a single pass to the final lengths would leave a ragged mesh.
std::vector<Step> coarseningSteps(const Grid& grid, double longest)
{
  const double least = std::min({ grid.spacing.x, grid.spacing.y, grid.spacing.z });
  Step step;
  step.name = "coarsening";
  step.again = true;
  std::vector<Step> steps;
  for (double level = 1.6 * least; level < longest; level *= 1.48)
  {
    step.level = level;
    // The first levels hold most of the tetrahedra, in a lattice that is still regular: repair pays later.
    step.improvement = improvementTo(level < 3 * least ? 0 : 15, 0, 8, 1);
    steps.push_back(step);
  }
  step.level = longest;
  step.improvement = improvementTo(15, 0, 8, 1);
  steps.insert(steps.end(), 3, step);
  return steps;
}

/// The angle aimed at rises from step to step: sizes suffer less than from one step straight to the end. Only what is still
/// bad afterwards may stray farther from the evidence, or be split.
std::vector<Step> improvementSteps(double longest)
{
  std::vector<Step> steps;
  const auto add = [&](double rmsLimit, double level, bool relax, const ImprovementOptions& improvement)
  { steps.push_back({ "improvement", rmsLimit, level, false, relax, improvement }); };
  add(0.3, longest, true, improvementTo(20, 0, 8, 2));
  add(0.25, longest, true, improvementTo(28, 0, 8, 2));
  add(0.25, longest, true, improvementTo(34, 0, 8, 1));
  add(0.25, longest, true, improvementTo(34, 0, 8, 1));
  add(0.5, 0, false, improvementTo(29, 1, 16, 3));
  add(0.25, 0, true, improvementTo(34, 0, 12, 2));
  add(0.6, 0, false, improvementTo(30, 0.8, 20, 3));
  return steps;
}

void work(GuardedOperations& operations, const Step& step)
{
  CoarseningOptions coarsening;
  coarsening.minimumAngle = 5;
  if (step.level > 0) coarsenBlock(operations, step.level, coarsening);
  if (step.relax) relaxBlock(operations);
  if (step.improvement.targetAngle > 0) improveBlock(operations, step.improvement);
  if (step.again) coarsenBlock(operations, step.level, coarsening);
}

} // namespace

SurfaceMesh meshTissues(const TissueMap& map, const ScaleField& scale, const SurfaceMesherOptions& options,
                        const Progress& progress)
{
  SurfaceMesh result;
  const ScaleFunction lengthAt = [&](const Vec3& p) { return float(scale(map.grid.gridToWorld(p))); };
  AmbientLattice lattice = ambientLattice(map, scale, {}, subProgress(progress, 0, 0.06));
  smoothInterface(lattice, map.grid.spacing);
  result.ambient = std::move(lattice.ambient);
  setTolerances(result.ambient, map.grid.spacing, lengthAt, options.maximumDistance);

  Evolution evolution(result.ambient, result.evolution);
  evolution.record("lattice");
  std::vector<Step> steps = coarseningSteps(map.grid, *std::max_element(scale.lengths.begin(), scale.lengths.end()));
  const std::vector<Step> improving = improvementSteps(steps.back().level);
  steps.insert(steps.end(), improving.begin(), improving.end());
  for (std::size_t i = 0; i < steps.size(); ++i)
  {
    const Step& step = steps[i];
    const Progress part = subProgress(progress, 0.1 + 0.9 * double(i) / double(steps.size()),
                                      0.1 + 0.9 * double(i + 1) / double(steps.size()));
    sweepBlocks(
      result.ambient, int(i), blockSize,
      [&](TetComplex& block)
      {
        GuardedOperations operations(block, lengthAt, step.rmsLimit);
        work(operations, step);
        evolution.count(operations.counts);
      },
      [&](double fraction, const std::string&) { report(part, fraction, step.name); });
    evolution.record(step.name);
  }
  return result;
}

} // namespace surgicalmesher
