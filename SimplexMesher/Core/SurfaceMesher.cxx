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

} // namespace

SurfaceMesh meshTissues(const TissueMap& map, const ScaleField& scale, const SurfaceMesherOptions& options,
                        const Progress& progress)
{
  SurfaceMesh result;
  AmbientMesh& ambient = result.ambient;
  const ScaleFunction lengthAt = [&](const Vec3& p) { return float(scale(map.grid.gridToWorld(p))); };
  {
    AmbientLattice lattice = ambientLattice(map, scale, {}, subProgress(progress, 0, 0.04));
    smoothInterface(lattice, map.grid.spacing);
    ambient = std::move(lattice.ambient);
  }
  setTolerances(ambient, map.grid.spacing, lengthAt, options.maximumDistance);

  Evolution evolution(ambient, result.evolution);
  evolution.record("lattice");
  int round = 0;
  const auto sweep = [&](const std::string& stage, double from, double to, double rmsLimit,
                         const std::function<void(GuardedOperations&)>& work)
  {
    const Progress part = subProgress(progress, from, to);
    const Progress named = [&](double fraction, const std::string&) { report(part, fraction, stage); };
    sweepBlocks(
      ambient, round++, blockSize,
      [&](TetComplex& block)
      {
        GuardedOperations operations(block, lengthAt, rmsLimit);
        work(operations);
        evolution.count(operations.counts);
      },
      named);
    evolution.record(stage);
  };

  CoarseningOptions coarsening;
  coarsening.minimumAngle = 5;
  ImprovementOptions repair;
  repair.targetAngle = 15;
  repair.split = false;
  repair.passes = 1;
  const auto coarsen = [&](double level)
  {
    return [&, level](GuardedOperations& operations)
    {
      coarsenBlock(operations, level, coarsening);
      relaxBlock(operations);
      improveBlock(operations, repair);
      coarsenBlock(operations, level, coarsening);
      relaxBlock(operations);
    };
  };
  // Levels of size, each about 1.5 times the one before: a single pass to the final lengths would leave a ragged mesh.
  const double longest = *std::max_element(scale.lengths.begin(), scale.lengths.end());
  const double least = std::min({ map.grid.spacing.x, map.grid.spacing.y, map.grid.spacing.z });
  std::vector<double> levels;
  for (double level = 1.6 * least; level < longest; level *= 1.48) levels.push_back(level);
  levels.insert(levels.end(), 3, longest);
  for (std::size_t i = 0; i < levels.size(); ++i)
    sweep("coarsening", 0.1 + 0.4 * double(i) / double(levels.size()), 0.1 + 0.4 * double(i + 1) / double(levels.size()), 0.45,
          coarsen(levels[i]));

  ImprovementOptions improvement;
  improvement.splitEdge = 1.2;
  for (int i = 0; i < 4; ++i)
    sweep("improvement", 0.5 + 0.12 * i, 0.62 + 0.12 * i, 0.3, [&](GuardedOperations& operations) {
      coarsenBlock(operations, longest, coarsening);
      relaxBlock(operations);
      improveBlock(operations, improvement);
    });
  return result;
}

} // namespace surgicalmesher
