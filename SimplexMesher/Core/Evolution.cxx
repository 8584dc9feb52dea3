// SPDX-License-Identifier: Apache-2.0
#include "Evolution.h"

#include "Parallel.h"
#include "Triangle.h"

#include <algorithm>

namespace surgicalmesher
{

namespace
{

/// Returns the sum of of(from, to) over parts of a fixed size, which does not depend on the number of threads.
template <class F>
auto sumOfParts(std::size_t count, F&& of)
{
  constexpr std::size_t part = 4096;
  std::vector<decltype(of(0, 0))> parts((count + part - 1) / part);
  parallelFor(parts.size(), [&](std::size_t p) { parts[p] = of(p * part, std::min(count, (p + 1) * part)); });
  decltype(of(0, 0)) result{};
  for (const auto& each : parts) result += each;
  return result;
}

struct Distances
{
  double sum = 0, maximum = 0; ///< mm
  std::size_t beyond = 0;      ///< samples beyond their tolerances

  void operator+=(const Distances& other)
  {
    sum += other.sum;
    maximum = std::max(maximum, other.maximum);
    beyond += other.beyond;
  }
};

/// Returns the distances of samples `from` to `to` from their faces.
Distances distancesOf(const BackgroundMesh& background, std::size_t from, std::size_t to)
{
  Distances result;
  for (std::size_t i = from; i < to; ++i)
  {
    const auto& sample = background.samples[i];
    const auto& t = background.mesh.tetrahedra[sample.tetrahedron];
    const auto corner = [&](int k) { return background.mesh.points[t[(sample.face + k) & 3]]; };
    const double d = std::sqrt(squaredDistanceToTriangle(sample.position, corner(1), corner(2), corner(3)));
    result += { d, d, d > double(sample.tolerance) * (1 + 1e-6) };
  }
  return result;
}

/// Returns the number of faces between two labels of tetrahedra `from` to `to`; each face counts at its lower
/// tetrahedron.
std::size_t facesOf(const BackgroundMesh& background, std::size_t from, std::size_t to)
{
  const auto& labels = background.mesh.labels;
  std::size_t count = 0;
  for (std::size_t t = from; t < to; ++t)
    for (const std::int32_t n : background.neighbours[t]) count += n > std::int32_t(t) && labels[n] != labels[t];
  return count;
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
  step.faces = sumOfParts(background.neighbours.size(), // 0 before the first sweep
                          [&](std::size_t from, std::size_t to) { return facesOf(background, from, to); });
  const Distances distances = sumOfParts(background.samples.size(), [&](std::size_t from, std::size_t to)
                                         { return distancesOf(background, from, to); });
  step.maximumDistance = distances.maximum;
  step.beyond = distances.beyond;
  if (!background.samples.empty()) step.meanDistance = distances.sum / double(background.samples.size());
  return step;
}

} // namespace surgicalmesher
