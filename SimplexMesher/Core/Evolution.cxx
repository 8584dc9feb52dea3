// SPDX-License-Identifier: Apache-2.0
#include "Evolution.h"

#include "Parallel.h"
#include "Triangle.h"

#include <algorithm>

namespace surgicalmesher
{

namespace
{

struct Distances
{
  double sum = 0, maximum = 0; ///< mm
  std::size_t beyond = 0;      ///< the samples' tolerances
};

/// Of samples `from` to `to` to their faces.
Distances distancesOf(const BackgroundMesh& background, std::size_t from, std::size_t to)
{
  Distances result;
  for (std::size_t i = from; i < to; ++i)
  {
    const auto& sample = background.samples[i];
    const auto& t = background.mesh.tetrahedra[sample.tetrahedron];
    const auto corner = [&](int k) { return background.mesh.points[t[(sample.face + k) & 3]]; };
    const double d = std::sqrt(squaredDistanceToTriangle(sample.position, corner(1), corner(2), corner(3)));
    result.sum += d;
    result.maximum = std::max(result.maximum, d);
    result.beyond += d > double(sample.tolerance) * (1 + 1e-6);
  }
  return result;
}

/// In parts of a fixed size: their sum does not depend on the threads.
Distances distancesOf(const BackgroundMesh& background)
{
  constexpr std::size_t part = 4096;
  const std::size_t count = background.samples.size();
  std::vector<Distances> parts((count + part - 1) / part);
  parallelFor(parts.size(),
              [&](std::size_t p) { parts[p] = distancesOf(background, p * part, std::min(count, (p + 1) * part)); });
  Distances result;
  for (const Distances& d : parts)
  {
    result.sum += d.sum;
    result.maximum = std::max(result.maximum, d.maximum);
    result.beyond += d.beyond;
  }
  return result;
}

} // namespace

EvolutionStep evolutionStep(const BackgroundMesh& background, const std::string& stage,
                            const OperationCounts& operations)
{
  EvolutionStep step;
  step.stage = stage;
  step.operations = operations;
  const auto& labels = background.mesh.labels;
  step.tetrahedra = std::size_t(std::count_if(labels.begin(), labels.end(), [](Label l) { return l != 0; }));
  const auto& neighbours = background.neighbours; // none before the first sweep
  for (std::size_t t = 0; t < neighbours.size(); ++t)
    for (const std::int32_t n : neighbours[t]) step.faces += n > std::int32_t(t) && labels[n] != labels[t];
  const Distances distances = distancesOf(background);
  step.maximumDistance = distances.maximum;
  step.beyond = distances.beyond;
  if (!background.samples.empty()) step.meanDistance = distances.sum / double(background.samples.size());
  return step;
}

} // namespace surgicalmesher
